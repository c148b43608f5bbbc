"""Contacts: stiffnesses, Eq. 1, bonds after Eq. 5 and how they break, walls as mirrors.

Two grains (or one and a wall) are held or moved by hand and the contact's forces compared with the formula. What the
contact law computes is a handful of sums and products of doubles: relative differences of some 1e-16 each, and of
1e-16 r/u where an overlap u is the difference of positions of size r. 1e-9 covers u = 1e-5 r with room.
"""

import math

import pytest
from yade import O
from yade.wrapper import DiskMat, Ip2_DiskMat_DiskMat_CohFrictPhys, WallMat

from capfrac import sediment

GAMMA, CHI = 0.05, 10
EXACT = 1e-9


@pytest.fixture
def pair(handScene):
    """A function (overlap, r1, r2, **Sediment) -> (left grain, right grain), the line of centres along x, walls far off."""

    def make(overlap, r1=1e-3, r2=1e-3, **attributes):
        far = 10 * (r1 + r2)
        return handScene([(-r1, 0, r1), (r2 - overlap, 0, r2)], (-far, far, -far, far), **attributes)

    return make


@pytest.fixture
def onFloor(handScene):
    """A function (overlap, r, **Sediment) -> the grain that rests on the bottom wall, other walls far off."""

    def make(overlap, r=1e-3, **attributes):
        return handScene([(0, r - overlap, r)], (-9 * r, 9 * r, 0, 9 * r), **attributes)[0]

    return make


def contact():
    """The scene's only contact, after the contact law has seen it."""
    O.step()
    real = [i for i in O.interactions if i.isReal]
    return real[0] if real else None


@pytest.mark.parametrize("r1, r2", [(1e-6, 1e-6), (1e-3, 1e-3), (1e-3, 2e-3), (0.5, 0.3)])
def test_stiffnessesDoNotDependOnRadius(pair, r1, r2):
    pair(1e-4 * r1, r1, r2, normalStiffness=3e7, shearStiffness=2e7)
    phys = contact().phys
    assert (phys.kn, phys.ks) == (3e7, 2e7)
    assert phys.tangensOfFrictionAngle == pytest.approx(0.5, rel=1e-15)
    assert phys.cohesionBroken


def test_differentMaterialsGiveMeanStiffnessAndSmallerFriction(pair):
    first, _ = pair(1e-6)
    O.bodies[first].material = DiskMat(normalStiffness=1e7, shearStiffness=2e6, frictionAngle=0.1)
    other = O.bodies[first + 1].material
    other.normalStiffness, other.shearStiffness, other.frictionAngle = 3e7, 4e6, 0.7
    phys = contact().phys
    assert (phys.kn, phys.ks) == (2e7, 3e6)
    assert phys.tangensOfFrictionAngle == pytest.approx(math.tan(0.1), rel=1e-15)


@pytest.mark.parametrize("r1, r2", [(1e-6, 2e-6), (1e-3, 1e-3)])
@pytest.mark.parametrize("overlap", [1e-5, 1e-3, 0.1])
def test_normalForceIsEquation1(pair, r1, r2, overlap):
    left, right = pair(overlap * r1, r1, r2)
    contact()
    force = 1e7 * overlap * r1
    assert O.forces.f(right)[0] == pytest.approx(force, rel=EXACT)
    assert O.forces.f(left)[0] == pytest.approx(-force, rel=EXACT)
    assert O.forces.f(left)[1] == O.forces.f(right)[1] == 0


def test_shearForceIsEquation1(pair):
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


def test_unbondedContactSlidesAtFriction(pair):
    left, right = pair(1e-5, friction=0.3)
    contact()
    O.bodies[left].state.angVel = (0, 0, 1e-5 / (1e-3 * O.dt))  # a slip of k_s 1e-5 m = F_n in one step
    for _ in range(2):
        contact()
        assert O.forces.f(right)[1] == pytest.approx(0.3 * 1e7 * 1e-5, rel=EXACT)


def test_unbondedContactBearsNoTension(pair):
    left, right = pair(1e-6)
    contact()
    O.bodies[right].state.pos += (2e-6, 0, 0)
    O.step()
    assert tuple(O.forces.f(left)) == (0, 0, 0)


@pytest.mark.parametrize("r1, r2", [(1e-6, 1e-6), (1e-3, 2e-3)])
@pytest.mark.parametrize("thickness", [1, 0.25])
def test_bondStrengthIsEquation5(pair, r1, r2, thickness):
    # sigma_c = tensileStrength + chi gamma / r_mean; phi = sigma_c 2 r_mean w: the capillary part is 2 chi gamma w
    # whatever the size.
    pair(1e-3 * r1, r1, r2)
    contact()
    sediment.engine("bonds").thickness = thickness
    assert sediment.bond(capillaryStrength=CHI * GAMMA, tensileStrength=3e3, shearStrength=5e3) == 1
    phys = contact().phys
    assert phys.normalAdhesion == pytest.approx(thickness * (3e3 * (r1 + r2) + 2 * CHI * GAMMA), rel=1e-14)
    assert phys.shearAdhesion == pytest.approx(thickness * (5e3 * (r1 + r2) + 2 * CHI * GAMMA), rel=1e-14)
    assert not phys.cohesionBroken


@pytest.mark.parametrize("factor", [None, 1, 7.5])
def test_wallIsAMirror(onFloor, factor):
    # Behind a smooth wall stands the grain's own image: mean radius r, the grain's own material twice; times bondFactor.
    onFloor(1e-6, 2e-3)
    contact()
    if factor is not None:
        O.materials["walls"].bondFactor = factor
    assert sediment.bond(capillaryStrength=CHI * GAMMA, tensileStrength=3e3, shearStrength=5e3) == 1
    phys = contact().phys
    factor = 100 if factor is None else factor
    assert phys.normalAdhesion == pytest.approx(factor * (3e3 * 4e-3 + 2 * CHI * GAMMA), rel=1e-14)
    assert phys.shearAdhesion == pytest.approx(factor * (5e3 * 4e-3 + 2 * CHI * GAMMA), rel=1e-14)


def test_wallWithoutBondsStaysSo(onFloor):
    onFloor(1e-6)
    contact()
    O.materials["walls"].bondFactor = 0
    assert sediment.bond(capillaryStrength=CHI * GAMMA) == 0
    assert contact().phys.cohesionBroken


def test_contactUnderMoreShearThanItsBondIsLeftFrictional(pair):
    left, right = pair(1e-5, friction=0.5)  # F_n = 100 N, so friction holds 50 N; the bond would hold 1 N
    contact()
    O.bodies[left].state.angVel = (0, 0, 2e-7 / (1e-3 * O.dt))
    contact()
    assert O.forces.f(right)[1] == pytest.approx(2, rel=EXACT)
    assert sediment.bond(capillaryStrength=CHI * GAMMA) == 0
    assert sediment.bond(capillaryStrength=3 * CHI * GAMMA) == 1


def test_bondBreaksJustAboveItsTensileStrength(pair):
    left, right = pair(1e-6)
    contact()
    sediment.bond(capillaryStrength=CHI * GAMMA)  # phi_n = 1 N, reached at a stretch of 1e-7 m
    O.bodies[right].state.pos = (1e-3 + 1e-7 * (1 - 1e-6), 0, 0)
    bonded = contact()
    assert not bonded.phys.cohesionBroken
    # The stretch is a difference of millimetres: 2e-19 m of round-off in 1e-7.
    assert O.forces.f(left)[0] == pytest.approx(1 - 1e-6, rel=1e-10)
    O.bodies[right].state.pos = (1e-3 + 1e-7 * (1 + 1e-6), 0, 0)
    broken = contact()
    assert broken is None or broken.phys.cohesionBroken
    assert tuple(O.forces.f(left)) == (0, 0, 0)


def test_brokenBondIsFrictionalForGood(pair):
    left, right = pair(1e-6, friction=0.5)
    contact()
    sediment.bond(capillaryStrength=CHI * GAMMA)
    O.bodies[right].state.pos = (1e-3 + 2e-7, 0, 0)
    O.step()
    O.bodies[right].state.pos = (1e-3 - 1e-6, 0, 0)
    O.bodies[left].state.angVel = (0, 0, 1e-6 / (1e-3 * O.dt))
    O.step()
    again = contact()
    assert again.phys.cohesionBroken
    assert again.phys.shearForce.norm() == pytest.approx(0.5 * 10, rel=EXACT)


def test_bondBreaksInShearAboveItsStrengthNotAtFriction(pair):
    # Hardly pressed together, F_n = 0.1 N: friction alone would slide at 0.05 N, the bond holds up to 1 N (Eq. 2).
    left, right = pair(1e-8, friction=0.5)
    contact()
    sediment.bond(capillaryStrength=CHI * GAMMA)
    slip = 0.999e-7
    O.bodies[left].state.angVel = (0, 0, slip / (1e-3 * O.dt))
    bonded = contact()
    assert not bonded.phys.cohesionBroken
    assert O.forces.f(right)[1] == pytest.approx(1e7 * slip, rel=EXACT)
    O.bodies[left].state.angVel = (0, 0, 2e-10 / (1e-3 * O.dt))
    broken = contact()
    assert broken.phys.cohesionBroken
    # F_n = k_n 1e-8 m; the overlap is known to 2e-19 m in 1e-8.
    assert O.forces.f(right)[1] == pytest.approx(0.5 * 0.1, rel=1e-8)


@pytest.mark.parametrize("bonded", [False, True])
def test_smoothWallCarriesNoShear(onFloor, bonded):
    grain = onFloor(1e-5)
    contact()
    assert sediment.bond(capillaryStrength=CHI * GAMMA if bonded else 0) == (1 if bonded else 0)
    O.bodies[grain].state.angVel = (0, 0, 1e-6 / (1e-3 * O.dt))
    phys = contact().phys
    assert phys.ks == 0 and phys.shearForce.norm() == 0
    assert O.forces.f(grain)[0] == 0
    assert O.forces.f(grain)[1] == pytest.approx(1e7 * 1e-5, rel=EXACT)


def test_roughWallCarriesShear(onFloor):
    grain = onFloor(1e-5, wallFriction=0.5, shearStiffness=4e6)
    contact()
    O.bodies[grain].state.angVel = (0, 0, 1e-8 / (1e-3 * O.dt))
    contact()
    # The grain turns counter-clockwise on the floor: its lowest point moves right and is held back.
    assert O.forces.f(grain)[0] == pytest.approx(-4e6 * 1e-8, rel=EXACT)


def test_bondContactsCountsNewBondsOnly(handScene):
    r, u = 1e-3, 1e-6
    d = 2 * r - u
    grains = handScene([(0, 0, r), (d, 0, r), (2 * d, 0, r), (3 * d + 2 * u, 0, r)], (-r + u, 20 * r, -9 * r, 9 * r))
    O.step()
    assert sediment.bond(capillaryStrength=CHI * GAMMA) == 3  # left wall, two pairs; the fourth grain stands off
    assert sediment.bond(capillaryStrength=CHI * GAMMA) == 0
    O.bodies[grains[3]].state.pos = (3 * d, 0, 0)
    O.step()
    assert sediment.bond(capillaryStrength=CHI * GAMMA) == 1


@pytest.mark.parametrize("cls, name, bad", [
    (DiskMat, "normalStiffness", 0), (DiskMat, "normalStiffness", math.nan), (DiskMat, "normalStiffness", math.inf),
    (DiskMat, "shearStiffness", -1), (DiskMat, "tensileStrength", -1), (DiskMat, "shearStrength", math.nan), (DiskMat, "capillaryStrength", -1),
    (WallMat, "normalStiffness", -1), (WallMat, "shearStiffness", math.inf), (WallMat, "bondFactor", -1)])
def test_impossibleValuesAreRefusedByName(cls, name, bad):
    with pytest.raises(ValueError, match=rf"{cls.__name__}\.{name} \[.*\] = .*allowed: finite and >"):
        cls(**{name: bad})
    with pytest.raises(ValueError, match=rf"{cls.__name__}\.{name} "):
        setattr(cls(), name, bad)


def test_impossibleThicknessIsRefusedWhenBonding(pair):
    pair(1e-6)
    contact()
    sediment.engine("bonds").thickness = 0
    with pytest.raises(ValueError, match=r"thickness \[m\] = 0, allowed: finite and > 0"):
        sediment.bond(capillaryStrength=1)
    assert Ip2_DiskMat_DiskMat_CohFrictPhys().thickness == 1
