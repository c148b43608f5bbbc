# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts without bonds: stiffnesses, Eq. 1, friction, walls; values that are refused.

Two grains (or one and a wall) are held or moved by hand and the contact's forces compared with the formula. What the
contact law computes is a handful of sums and products of doubles: relative differences of some 1e-16 each, and of
1e-16 r/u where an overlap u is the difference of positions of size r. 1e-9 covers u = 1e-5 r with room.
"""

import math

import pytest
from yade import O
from yade.wrapper import DiskMat, WallMat

EXACT = 1e-9


@pytest.mark.parametrize("r1, r2", [(1e-6, 1e-6), (1e-3, 1e-3), (1e-3, 2e-3), (0.5, 0.3)])
def test_stiffnessesDoNotDependOnRadius(pair, r1, r2, contact):
    pair(1e-4 * r1, r1, r2, normalStiffness=3e7, shearStiffness=2e7)
    phys = contact().phys
    assert (phys.kn, phys.ks) == (3e7, 2e7)
    assert phys.tangensOfFrictionAngle == pytest.approx(0.5, rel=1e-15)
    assert phys.cohesionBroken


def test_differentMaterialsGiveMeanStiffnessAndSmallerFriction(pair, contact):
    first, _ = pair(1e-6)
    O.bodies[first].material = DiskMat(normalStiffness=1e7, shearStiffness=2e6, frictionAngle=0.1)
    other = O.bodies[first + 1].material
    other.normalStiffness, other.shearStiffness, other.frictionAngle = 3e7, 4e6, 0.7
    phys = contact().phys
    assert (phys.kn, phys.ks) == (2e7, 3e6)
    assert phys.tangensOfFrictionAngle == pytest.approx(math.tan(0.1), rel=1e-15)


@pytest.mark.parametrize("r1, r2", [(1e-6, 2e-6), (1e-3, 1e-3)])
@pytest.mark.parametrize("overlap", [1e-5, 1e-3, 0.1])
def test_normalForceIsEquation1(pair, r1, r2, overlap, contact):
    left, right = pair(overlap * r1, r1, r2)
    contact()
    force = 1e7 * overlap * r1
    assert O.forces.f(right)[0] == pytest.approx(force, rel=EXACT)
    assert O.forces.f(left)[0] == pytest.approx(-force, rel=EXACT)
    assert O.forces.f(left)[1] == O.forces.f(right)[1] == 0


def test_shearForceIsEquation1(pair, contact):
    # The left grain turns counter-clockwise: its surface at the contact rises and drags the right grain up. Only a
    # turn keeps the normal where it is, and the slip at r dphi exactly.
    left, right = pair(1e-5, 1e-3, 2e-3, shearStiffness=4e6)
    contact()
    slip = 1e-10
    O.bodies[left].state.angVel = (0, 0, slip / (1e-3 * O.dt))
    for step in range(1, 4):
        contact()
        assert O.forces.f(right)[1] == pytest.approx(4e6 * step * slip, rel=EXACT)
        assert O.forces.f(left)[1] == pytest.approx(-4e6 * step * slip, rel=EXACT)


def test_unbondedContactSlidesAtFriction(pair, contact):
    left, right = pair(1e-5, friction=0.3)
    contact()
    O.bodies[left].state.angVel = (0, 0, 1e-5 / (1e-3 * O.dt))  # a slip of k_s 1e-5 m = F_n in one step
    for _ in range(2):
        contact()
        assert O.forces.f(right)[1] == pytest.approx(0.3 * 1e7 * 1e-5, rel=EXACT)


def test_unbondedContactBearsNoTension(pair, contact):
    left, right = pair(1e-6)
    contact()
    O.bodies[right].state.pos += (2e-6, 0, 0)
    O.step()
    assert tuple(O.forces.f(left)) == (0, 0, 0)


def test_roughWallCarriesShear(onFloor, contact):
    grain = onFloor(1e-5, wallFriction=0.5, shearStiffness=4e6)
    contact()
    O.bodies[grain].state.angVel = (0, 0, 1e-8 / (1e-3 * O.dt))
    contact()
    # The grain turns counter-clockwise on the floor: its lowest point moves right and is held back.
    assert O.forces.f(grain)[0] == pytest.approx(-4e6 * 1e-8, rel=EXACT)


@pytest.mark.parametrize(
    "cls, name, bad",
    [
        (DiskMat, "normalStiffness", 0),
        (DiskMat, "normalStiffness", math.nan),
        (DiskMat, "normalStiffness", math.inf),
        (DiskMat, "shearStiffness", -1),
        (DiskMat, "tensileStrength", -1),
        (DiskMat, "shearStrength", math.nan),
        (DiskMat, "capillaryStrength", -1),
        (WallMat, "normalStiffness", -1),
        (WallMat, "shearStiffness", math.inf),
        (WallMat, "bondFactor", -1),
    ],
)
def test_impossibleValuesAreRefusedByName(cls, name, bad):
    with pytest.raises(ValueError, match=rf"{cls.__name__}\.{name} \[.*\] = .*allowed: finite and >"):
        cls(**{name: bad})
    with pytest.raises(ValueError, match=rf"{cls.__name__}\.{name} "):
        setattr(cls(), name, bad)
