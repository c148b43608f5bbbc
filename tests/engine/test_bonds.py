# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds: strengths after Eq. 5, how they break, walls as mirrors. Tolerances as in test_contacts.py."""

import pytest
from yade import O
from yade.wrapper import Ip2_DiskMat_DiskMat_CohFrictPhys

from capfrac import sediment

GAMMA, CHI = 0.05, 10
EXACT = 1e-9


@pytest.mark.parametrize("r1, r2", [(1e-6, 1e-6), (1e-3, 2e-3)])
@pytest.mark.parametrize("thickness", [1, 0.25])
def test_bondStrengthIsEquation5(pair, r1, r2, thickness, contact):
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
def test_wallIsAMirror(onFloor, factor, contact):
    # Behind a smooth wall stands the grain's own image: mean radius r, the grain's own material twice; times
    # bondFactor.
    onFloor(1e-6, 2e-3)
    contact()
    if factor is not None:
        O.materials["walls"].bondFactor = factor
    assert sediment.bond(capillaryStrength=CHI * GAMMA, tensileStrength=3e3, shearStrength=5e3) == 1
    phys = contact().phys
    factor = 100 if factor is None else factor
    assert phys.normalAdhesion == pytest.approx(factor * (3e3 * 4e-3 + 2 * CHI * GAMMA), rel=1e-14)
    assert phys.shearAdhesion == pytest.approx(factor * (5e3 * 4e-3 + 2 * CHI * GAMMA), rel=1e-14)


def test_wallWithoutBondsStaysSo(onFloor, contact):
    onFloor(1e-6)
    contact()
    O.materials["walls"].bondFactor = 0
    assert sediment.bond(capillaryStrength=CHI * GAMMA) == 0
    assert contact().phys.cohesionBroken


def test_contactUnderMoreShearThanItsBondIsLeftFrictional(pair, contact):
    left, right = pair(1e-5, friction=0.5)  # F_n = 100 N, so friction holds 50 N; the bond would hold 1 N
    contact()
    O.bodies[left].state.angVel = (0, 0, 2e-7 / (1e-3 * O.dt))
    contact()
    assert O.forces.f(right)[1] == pytest.approx(2, rel=EXACT)
    assert sediment.bond(capillaryStrength=CHI * GAMMA) == 0
    assert sediment.bond(capillaryStrength=3 * CHI * GAMMA) == 1


def test_bondBreaksJustAboveItsTensileStrength(pair, contact):
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


def test_brokenBondIsFrictionalForGood(pair, contact):
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


def test_bondBreaksInShearAboveItsStrengthNotAtFriction(pair, contact):
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
def test_smoothWallCarriesNoShear(onFloor, bonded, contact):
    grain = onFloor(1e-5)
    contact()
    assert sediment.bond(capillaryStrength=CHI * GAMMA if bonded else 0) == (1 if bonded else 0)
    O.bodies[grain].state.angVel = (0, 0, 1e-6 / (1e-3 * O.dt))
    phys = contact().phys
    assert phys.ks == 0 and phys.shearForce.norm() == 0
    assert O.forces.f(grain)[0] == 0
    assert O.forces.f(grain)[1] == pytest.approx(1e7 * 1e-5, rel=EXACT)


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


def test_impossibleThicknessIsRefusedWhenBonding(pair, contact):
    pair(1e-6)
    contact()
    sediment.engine("bonds").thickness = 0
    with pytest.raises(ValueError, match=r"thickness \[m\] = 0, allowed: finite and > 0"):
        sediment.bond(capillaryStrength=1)
    assert Ip2_DiskMat_DiskMat_CohFrictPhys().thickness == 1
