# SPDX-License-Identifier: GPL-2.0-or-later
"""The servo-controlled box against a lattice whose stiffness is known, and against what it is asked to keep."""

import math

import numpy as np
import pytest
from yade import O

from capfrac import sediment
from capfrac.errors import CaseError, SampleError
from capfrac.lab.box import MODES, SERVO_TOLERANCE, Box

R, K = 1e-3, 1e7


def lattice(columns=6, rows=8, friction=0.0):
    """A square lattice of equal disks, touching each other and the walls; returns its Sediment.

    Without friction a column of n disks between two walls is n + 1 equal springs in series.
    """
    x, y = (a.ravel() for a in np.meshgrid((2 * np.arange(columns) + 1) * R, (2 * np.arange(rows) + 1) * R))
    sample = sediment.Sediment(grainCount=len(x), rMin=R, rMax=R, normalStiffness=K, friction=friction)
    sediment.buildScene(sample, x, y, np.full(len(x), R), (0, 2 * columns * R, 0, 2 * rows * R))
    return sample


def confined(stress=10e3, **shape):
    sample = lattice(**shape)
    box = Box(sample)
    box.confine(stress, stress)
    box.setReference()
    return box


def slope(x, y):
    return np.polyfit(x, y, 1)[0]


def test_uniaxialModulusOfALattice():
    box = confined()
    box.mode("uniaxial")
    box.record("virgin")
    box.strainTo(0.01)
    rows = box.rows
    # F = K d in each of n + 1 contacts, strain = (n + 1) d / H: M = K H / ((n + 1) 2 r), the columns W/(2 r) side by
    # side on a box a little narrower than they were. Waves of the drive at an inertial number of 5e-4 are of the order
    # of I sqrt(M/sigma) = 1.5 % of the preload at first, 1.5e-3 of the stress at the end.
    height = O.bodies[3].state.pos[1] / (1 - rows["strain [-]"][-1])
    narrowed = 6 * 2 * R / box.lengths()[0]
    assert slope(rows["strain [-]"], rows["stressV [Pa]"]) == pytest.approx(
        narrowed * K * height / (9 * 2 * R), rel=2e-3
    )
    # A square lattice without friction does not spread: its rows press on the side walls as before, and the walls are
    # less high.
    np.testing.assert_allclose(
        np.array(rows["stressH [Pa]"]) * (1 - np.array(rows["strain [-]"])), rows["stressH [Pa]"][0], rtol=1e-3
    )
    assert rows["lateralStrain [-]"] == [0.0] * len(rows["strain [-]"])


def test_drivenThereAndBackIsElastic():
    box = confined()
    box.mode("uniaxial")
    box.record("virgin")
    box.strainTo(0.005)
    box.strainTo(0.0, branch="unload 1")
    assert box.strain() == pytest.approx(0, abs=1e-9)  # strainTo() ends within 1e-9
    # Elastic: what is left of the wave of the drive, see above.
    assert box.rows["stressV [Pa]"][-1] == pytest.approx(10e3, rel=0.03)
    assert box.rows["voidRatio [-]"][-1] == pytest.approx(box.rows["voidRatio [-]"][0], abs=1e-8)


def test_biaxialKeepsTheSideStress(loadSample):
    loadSample()
    box = Box(sediment.Sediment(grainCount=60, rMin=1e-3, rMax=2e-3))
    box.setReference()
    box.mode("biaxial", stressH=8e3)
    box.strainTo(0.02)
    # 0.5 % of the larger request, stressV = 10 kPa, on each wall when a row is taken; the column is their mean.
    assert np.max(np.abs(np.array(box.rows["stressH [Pa]"]) - 8e3)) <= SERVO_TOLERANCE * 10e3 * 1.001
    assert max(box.rows["servoError [-]"]) < SERVO_TOLERANCE
    assert box.rows["stressV [Pa]"][-1] > 10e3
    assert box.rows["lateralStrain [-]"][-1] < 0  # it bulges


def test_meanStressStays(loadSample):
    loadSample()
    box = Box(sediment.Sediment(grainCount=60, rMin=1e-3, rMax=2e-3))
    box.setReference()
    box.mode("meanStress", meanStress=9e3)
    box.strainTo(0.01)
    mean = 0.5 * (np.array(box.rows["stressV [Pa]"]) + np.array(box.rows["stressH [Pa]"]))
    # The side walls are within 0.5 % of the mean stress of 2 p - sigma_y.
    np.testing.assert_allclose(mean, 9e3, rtol=SERVO_TOLERANCE)
    assert box.rows["stressV [Pa]"][-1] > 1.2 * box.rows["stressH [Pa]"][-1]


def test_isotropicAndK0(loadSample):
    loadSample()
    sample = sediment.Sediment(grainCount=60, rMin=1e-3, rMax=2e-3)
    box = Box(sample)
    box.setReference()
    box.mode("isotropic")
    box.stressTo([20e3, 40e3])
    # top 0.5 %, bottom follows at rest
    np.testing.assert_allclose(box.rows["stressV [Pa]"], [20e3, 40e3], rtol=2 * SERVO_TOLERANCE)
    np.testing.assert_allclose(box.rows["stressH [Pa]"], [20e3, 40e3], rtol=SERVO_TOLERANCE)
    width = box.lengths()[0]
    box.mode("k0")
    box.stressTo([80e3])
    assert box.lengths()[0] == width
    assert box.rows["stressV [Pa]"][-1] == pytest.approx(80e3, rel=2 * SERVO_TOLERANCE)
    assert 40e3 < box.rows["stressH [Pa]"][-1] < 80e3  # K0 < 1 in first loading


def test_voidRatios():
    box = confined()
    box.mode("uniaxial")
    row = box.record("virgin")
    # A square lattice of disks, touching: box (2 r)^2 over pi r^2 less 1; overlaps of 2e-3 r at the preload make it
    # smaller, by 4e-3 of the box, and count once in the true void ratio (their area, r^2 (2e-3)^1.5, is 1e-4 of a
    # disk).
    assert row["voidRatio [-]"] == pytest.approx(4 / math.pi - 1, abs=6e-3)
    assert row["trueVoidRatio [-]"] == pytest.approx(row["voidRatio [-]"], abs=1e-3)
    assert row["trueVoidRatio [-]"] >= row["voidRatio [-]"]


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda box: box.mode("triaxial"), f"mode = 'triaxial', allowed: {', '.join(MODES)}"),
        (lambda box: box.mode("biaxial"), "stressH = None Pa with mode 'biaxial', allowed: > 0"),
        (
            lambda box: box.mode("meanStress", meanStress=-1.0),
            "meanStress = -1.0 Pa with mode 'meanStress', allowed: > 0",
        ),
        (
            lambda box: box.strainTo(0.1),
            "the box is in mode None, allowed here: uniaxial, biaxial, meanStress; call mode() first",
        ),
        (lambda box: (box.mode("uniaxial"), box.strainTo(0.9)), "strain = 0.9, allowed: up to 0.4"),
        (lambda box: (box.mode("uniaxial"), box.strainTo(math.nan)), "strain = nan, allowed: up to"),
        (lambda box: (box.mode("k0"), box.stressTo([-5.0])), "target stress = -5.0 Pa, allowed: > 0"),
    ],
)
def test_impossibleRequests(call, message):
    box = confined()
    height = box.lengths()
    with pytest.raises(CaseError) as problem:
        call(box)
    assert message in str(problem.value)
    assert box.lengths() == height


def test_rattlersAreNoSample():
    sample = lattice(3, 3)
    for body in sediment.grainBodies():
        body.shape.radius *= 0.9
    O.run(1, True)
    with pytest.raises(SampleError, match="bears no load: 0 of 9 grains have two contacts or more"):
        Box(sample).setReference()


def test_inertialNumberOutOfRange():
    with pytest.raises(CaseError, match="inertialNumber = 0.1, allowed: 0 < I <= 0.01"):
        Box(lattice(3, 3), inertialNumber=0.1)
