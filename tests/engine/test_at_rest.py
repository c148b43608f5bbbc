# SPDX-License-Identifier: GPL-2.0-or-later
"""When the grains count as at rest: by all forces that move them, weight included."""

import pytest
from yade import O, utils
from yade.wrapper import GasInvasionEngine, GravityEngine

from capfrac import sediment

R = 1e-3
G = 9.81


@pytest.fixture
def heap(handScene):
    """A function (rows) -> ids of grains in straight columns on the floor, one above the other, under a gas engine.

    Columns do not touch each other or the side walls, so each floor contact bears the weight of its column.
    """

    def make(rows=3, columns=4, damping=0.4, **attributes):
        step = 2.2 * R
        disks = [((0.6 + k) * step, (2 * row + 1) * R, R) for k in range(columns) for row in range(rows)]
        grains = handScene(disks, (0, (columns + 0.2) * step, 0, (2 * rows + 1) * R), fixed=False)
        sediment.engine("newton").damping = damping
        for body in grains:
            O.bodies[body].state.blockedDOFs = "xzXYZ"  # columns would buckle
        sediment.insertFluid(
            GasInvasionEngine(
                label="gas",
                gasPressure=1,
                pressureIncrement=1,
                maxPressure=1000,
                inletFrom=0,
                inletTo=(columns + 0.2) * step,
                minLevelSteps=100,
                maxLevelSteps=10**6,
                **attributes,
            )
        )
        return grains

    return make


def weight(kind, place="before"):
    """Gravity on the grains, of the integrator or of an engine."""
    if kind == "newton":
        sediment.engine("newton").gravity = (0, -G, 0)
        return
    engines = list(O.engines)
    engine = GravityEngine(gravity=(0, -G, 0), warnOnce=False)
    engines.insert(engines.index(sediment.engine("gas")) + (place == "after"), engine)
    O.engines = engines


@pytest.mark.parametrize("kind, place", [("newton", ""), ("engine", "before"), ("engine", "after")])
def test_weightThatContactsBearIsRest(heap, kind, place):
    heap()
    weight(kind, place)
    gas = sediment.engine("gas")
    sediment.advance(6000)
    assert gas.level >= 2 and all(gas.levels()["atRest"])
    assert max(gas.levels()["unbalanced"]) < gas.unbalancedTolerance


@pytest.mark.parametrize("kind, place", [("newton", ""), ("engine", "before"), ("engine", "after")])
def test_grainsThatFallAreNotAtRest(heap, kind, place):
    # One grain of twelve falls, the others stand: a resultant of m g over 12, and contacts of 1, 2 and 3 m g.
    grains = heap(damping=0.7)
    weight(kind, place)
    sediment.advance(4000)
    gas, top = sediment.engine("gas"), O.bodies[grains[2]]
    level = gas.level
    assert level > 0
    top.state.pos = (top.state.pos[0], top.state.pos[1] + 0.5 * R, 0)
    sediment.advance(200)  # it needs sqrt(2 R/2/g) = 10 ms, some 1100 steps
    assert gas.level == level
    gas.maxLevelSteps = 100
    sediment.advance(10)
    levels = gas.levels()
    assert gas.level == level + 1 and not levels["atRest"][-1]
    assert levels["unbalanced"][-1] == pytest.approx((1 / 12) / ((3 * (1 + 2 + 3) + 1 + 2) / 11), rel=0.02)


def test_measureIsYadesOwn(heap):
    # With all grains free in what counts: YADE's unbalancedForce at the same moment, over the same contacts.
    grains = heap()
    weight("newton")
    gas = sediment.engine("gas")
    gas.minLevelSteps = gas.maxLevelSteps = 10
    for body in grains:
        O.bodies[body].state.blockedDOFs = "zXY"
    seen = 0
    for _ in range(400):
        O.step()
        if gas.level > seen:
            seen = gas.level
            # The engine's forces are those of the step; YADE reads them after it, servo and integrator add none.
            assert gas.levels()["unbalanced"][-1] == pytest.approx(utils.unbalancedForce(), rel=1e-9)
    assert seen >= 5


def test_whatCannotMoveIsAtRest(heap):
    grains = heap()
    for body in grains:
        O.bodies[body].state.blockedDOFs = "xyzXYZ"
        O.forces.setPermF(body, (1, 1, 0))
    sediment.advance(250)
    gas = sediment.engine("gas")
    assert gas.level >= 1 and all(gas.levels()["atRest"]) and max(gas.levels()["unbalanced"]) == 0
    # One that may move counts alone.
    O.bodies[grains[0]].state.blockedDOFs = "zXY"
    level = gas.level
    sediment.advance(30)
    gas.maxLevelSteps = 100
    sediment.advance(200)
    assert gas.level > level and not gas.levels()["atRest"][-1]
