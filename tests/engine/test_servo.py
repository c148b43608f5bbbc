# SPDX-License-Identifier: GPL-2.0-or-later
"""WallServoEngine: walls come to the requested stresses, the fixed ones stay, what cannot be reached is said."""

import math
import re

import numpy as np
import pytest
from yade import O
from yade.wrapper import WallServoEngine

from capfrac import sediment
from capfrac.errors import CaseError, SampleError

WALLS = ("left", "right", "bottom", "top")


def stressFromContacts():
    """Stress on each wall from its contact forces alone, thickness 1 m [Pa]."""
    box = [b.state.pos[b.shape.axis] for b in list(O.bodies)[:4]]
    lengths = [box[3] - box[2]] * 2 + [box[1] - box[0]] * 2
    force = [0.0] * 4
    for i in O.interactions:
        if i.isReal and min(i.id1, i.id2) < 4:
            # YADE orders a contact wall first, its normal from wall to grain: along it is compression, against it a
            # bond.
            force[min(i.id1, i.id2)] += i.phys.normalForce.dot(i.geom.normal)
    return [f / length for f, length in zip(force, lengths)]


def sample():
    """Sediment as the loaded one was made from."""
    return sediment.Sediment(grainCount=60, rMin=1e-3, rMax=2e-3, seed=1)


@pytest.mark.parametrize("stressV, stressH", [(16e3, 8e3), (5e3, 10e3)])
def test_wallsReachTheirTargets(loadSample, stressV, stressH):
    loadSample()
    floor = O.bodies[2].state.pos[1]
    sediment.compress(sample(), stressV, stressH)
    servo = sediment.engine("servo")
    # compress() stops at 0.5 % of the larger stress; the bottom is fixed, its load is the top's when all is at rest:
    # mean unbalanced force 1e-3 of a contact force, over some eight contacts along a wall.
    for name, stress, target in zip(WALLS, servo.stress, (stressH, stressH, stressV, stressV)):
        assert stress == pytest.approx(target, abs=(0.005 if name != "bottom" else 0.01) * max(stressV, stressH)), name
    assert servo.error == max(abs(servo.stress[w] - (stressH if w < 2 else stressV)) for w in (0, 1, 3)) / max(
        stressV, stressH
    )
    assert O.bodies[2].state.pos[1] == floor
    # The walls moved once more after the forces were read, by some 1e-6 of the box.
    np.testing.assert_allclose(servo.stress, stressFromContacts(), rtol=1e-5)


@pytest.mark.parametrize("fixed", [["left"], ["left", "top"], [], list(WALLS)])
def test_fixedWallsStay(loadSample, fixed):
    loadSample()
    servo = sediment.engine("servo")
    servo.fixedWalls, servo.stressX, servo.stressY = fixed, 16e3, 20e3
    before = [tuple(b.state.pos) for b in list(O.bodies)[:4]]
    O.run(500, True)
    for name, body, place in zip(WALLS, list(O.bodies)[:4], before):
        moved = np.subtract(body.state.pos, place)
        assert np.all(moved == 0) if name in fixed else moved[body.shape.axis] != 0, name
        assert np.count_nonzero(moved) <= 1  # along its normal only


def test_wallThatTouchesNothingMovesInAtItsTopSpeed(handScene):
    handScene([(0, 0, 1e-3)], (-1, 1, -1, 1))
    servo = sediment.engine("servo")
    servo.dead, servo.stressX, servo.stressY, servo.maxVelocity = False, 0, 10, 0.25
    O.step()
    assert O.bodies[3].state.vel[1] == -0.25
    assert O.bodies[0].state.vel.norm() == O.bodies[1].state.vel.norm() == O.bodies[2].state.vel.norm() == 0


def test_measureReadsWithoutMoving(loadSample):
    loadSample()
    servo = sediment.engine("servo")
    O.step()
    stress, places = list(servo.stress), [tuple(b.state.pos) for b in O.bodies]
    servo.thickness = 0.5
    servo.measure()
    # The forces of the step, over the box after it.
    np.testing.assert_allclose(servo.stress, [2 * s for s in stress], rtol=1e-5)
    assert [tuple(b.state.pos) for b in O.bodies] == places


def test_stressOutOfReachOfTheContacts(loadSample, sceneState):
    loadSample()
    before = sceneState()
    # sigma 2 r_max / k_n > 0.1 r_min: 0.05 k_n r_min / r_max = 250 kPa is the limit.
    with pytest.raises(
        CaseError,
        match=(
            r"stressV = 300000 Pa is out of reach: .* overlap by 0.12 of the smallest radius; allowed: up to 250000 Pa"
        ),
    ):
        sediment.compress(sample(), 300e3, 8e3)
    with pytest.raises(CaseError, match="stressH = nan Pa, allowed: > 0"):
        sediment.compress(sample(), 10e3, math.nan)
    assert sceneState() == before


def test_stressThatIsNotReachedIsSaidWithWhatWas(loadSample):
    loadSample()
    with pytest.raises(
        SampleError,
        match=(
            r"sigma_V = 10000 Pa, sigma_H = 200000 Pa within 1000 steps: left .*, right .*, bottom .*, top .* Pa,"
            r" unbalanced"
        ),
    ) as caught:
        sediment.compress(sample(), 10e3, 200e3, maxSteps=1000)
    shown = [float(v) for v in re.findall(r"(?:left|right|bottom|top) ([\d.e+]+)", str(caught.value))]
    np.testing.assert_allclose(shown, sediment.engine("servo").stress, rtol=1e-3)


@pytest.mark.parametrize(
    "name, bad, message",
    [
        ("stressX", -1, r"stressX \[Pa\] = -1, allowed: finite and >= 0"),
        ("stressY", math.nan, r"stressY \[Pa\] = nan"),
        ("gain", 0, r"gain \[-\] = 0, allowed: 0 < gain <= 1"),
        ("gain", 1.5, r"gain \[-\] = 1.5"),
        ("maxVelocity", 0, r"maxVelocity \[m/s\] = 0, allowed: finite and > 0"),
        ("thickness", -1, r"thickness \[m\] = -1"),
        ("fixedWalls", ["floor"], "fixedWalls = 'floor', allowed: 'left', 'right', 'bottom', 'top'"),
    ],
)
def test_impossibleValuesAreRefusedByName(name, bad, message):
    with pytest.raises(ValueError, match=f"WallServoEngine.{message}"):
        WallServoEngine(**{name: bad})
    with pytest.raises(ValueError, match=message):
        setattr(WallServoEngine(), name, bad)


def test_drivenWallsMoveAtTheirVelocity(loadSample):
    loadSample()
    servo = sediment.engine("servo")
    servo.dead, servo.drivenWalls, servo.driveVelocity = False, ["top", "left"], 1e-3
    before = [O.bodies[w].state.pos[O.bodies[w].shape.axis] for w in range(4)]
    O.run(200, True)
    moved = [O.bodies[w].state.pos[O.bodies[w].shape.axis] - before[w] for w in range(4)]
    # Inwards: the left wall to the right, the top one down; a sum of 200 equal steps. The first step's velocity is set
    # before the integrator moves the wall, so all 200 count.
    assert moved[0] == pytest.approx(200 * O.dt * 1e-3, rel=1e-9)
    assert moved[3] == pytest.approx(-200 * O.dt * 1e-3, rel=1e-9)
    assert moved[2] == 0 and moved[1] != 0  # fixed; still under its stress


@pytest.mark.parametrize(
    "name, good, bad",
    [
        ("stressX", 1e3, -1.0),
        ("gain", 0.5, 2.0),
        ("meanStress", 1e3, -5.0),
        ("driveVelocity", -2.0, float("inf")),
        ("drivenWalls", ["top"], ["ceiling"]),
    ],
)
def test_refusedAssignmentsChangeNothing(name, good, bad):
    servo = WallServoEngine()
    setattr(servo, name, good)
    with pytest.raises(ValueError, match="allowed:"):
        setattr(servo, name, bad)
    assert getattr(servo, name) == good
