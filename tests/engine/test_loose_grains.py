# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains that lost their contacts: they come to rest, unless something drives or holds them, and decide no measure."""

import math

import pytest
from yade import O
from yade.wrapper import IdealGas, PoreNetworkEngine

from capfrac import injection, sediment, snapshot
from capfrac.scene.gasengine import engineOfGas

R = 1e-3
SPEED = 0.01


@pytest.fixture
def cage(handScene):
    """A function (disks, damping, gravity, **attributes of the gas engine) -> their ids: free disks amid eight that
    stand still.

    The box is ten radii wide; the eight touch in pairs along bottom and top, so that there is a mean contact.
    """

    def make(disks, damping=0.4, gravity=(0, 0, 0), waterPressure=0.0, waterFlow="drained", **attributes):
        side = 10 * R
        frame = [(x, y, R) for x in (R, 2.99 * R, side - 2.99 * R, side - R) for y in (R, side - R)]
        free = handScene(frame + disks, (0, side, 0, side))[len(frame) :]
        for body in free:
            O.bodies[body].state.blockedDOFs = "zXY"
        newton = sediment.engine("newton")
        newton.damping, newton.gravity = damping, gravity
        sediment.insertFluid(
            engineOfGas(waterFlow)(
                label="gas",
                waterPressure=waterPressure,
                gasPressure=waterPressure + 1,
                inletFrom=0,
                inletTo=3 * R,
                **attributes,
            )
        )
        sediment.advance(2)  # contacts form
        return free

    return make


def speed(body):
    return O.bodies[body].state.vel.norm()


def throw(bodies, velocity=(SPEED, 0.3 * SPEED, 0)):
    for body in bodies:
        O.bodies[body].state.vel = velocity


def way(body, start):
    return (O.bodies[body].state.pos - start).norm()


@pytest.mark.parametrize("waterPressure", [0, 1e5])
@pytest.mark.parametrize("waterFlow", ["drained", "solved"])
def test_aGrainThatNothingDrivesComesToRest(cage, waterFlow, waterPressure):
    (free,) = cage([(5 * R, 5 * R, R)], waterFlow=waterFlow, gasLaw=IdealGas(), waterPressure=waterPressure)
    start = O.bodies[free].state.pos
    throw([free])
    O.bodies[free].state.angVel = (0, 0, 7)
    # 2 d/T a second, T = 2 pi sqrt(m/k): after 20 periods exp(-40 d) = 1e-7 is left, and the way is at most v T/(2 d).
    grain = O.bodies[free]
    period = 2 * math.pi * math.sqrt(grain.state.mass / grain.material.normalStiffness)
    sediment.advance(math.ceil(20 * period / O.dt))
    assert speed(free) < 1e-6 * SPEED and abs(grain.state.angVel[2]) < 1e-6 * 7
    assert 0 < way(free, start) < 1.1 * math.hypot(1, 0.3) * SPEED * period / (2 * 0.4)


def test_aClusterThatHangsOnNothingComesToRestAsAWhole(cage):
    pair = cage([(5 * R, 5 * R, R), (6.99 * R, 5 * R, R)])
    sediment.advance(2000)  # it swings and comes to rest in itself
    throw(pair, (0.3 * SPEED, SPEED, 0))
    sediment.advance(400)
    assert max(map(speed, pair)) < 1e-3 * SPEED


@pytest.mark.parametrize("what", ["undamped", "isDamped", "blocked", "notDynamic", "force", "gravity"])
def test_whatTheUserHoldsOrDrivesIsLeftAlone(cage, what):
    gravity = (0, -9.81, 0) if what == "gravity" else (0, 0, 0)
    (free,) = cage([(5 * R, 5 * R, R)], damping=0 if what == "undamped" else 0.4, gravity=gravity)
    grain = O.bodies[free]
    throw([free], (0, SPEED, 0) if what != "gravity" else (0, 0, 0))
    if what == "isDamped":
        grain.state.isDamped = False
    elif what == "blocked":
        grain.state.blockedDOFs = "xyzXYZ"  # driven: YADE moves it by its velocity
    elif what == "notDynamic":
        grain.dynamic = False
    elif what == "force":
        O.forces.setPermF(free, (0, grain.state.mass * 9.81, 0))
    steps, before = 100, grain.state.vel[1]
    sediment.advance(steps)
    if what in ("force", "gravity"):  # a steady force less YADE's damping of it, and nothing else
        rise = (1 - 0.4) * (9.81 if what == "force" else -9.81) * steps * O.dt
        assert grain.state.vel[1] - before == pytest.approx(rise, rel=1e-9)
    else:
        assert grain.state.vel[1] == before


def test_aGrainThatBearsNoLoadNowDoesNotDecideTheDisplacement(loadSample):
    loadSample()
    gas = injection.startInjection(start=50, increment=1, max=60, pores=3, minLevelSteps=10, maxLevelSteps=10)
    loaded = next(body for body in sediment.grainBodies() if body.id not in gas.rattlers)
    for contact in list(O.interactions):
        if loaded.id in (contact.id1, contact.id2):
            O.interactions.erase(contact.id1, contact.id2)
    loaded.shape.radius *= 0.9  # it lost its neighbours
    loaded.state.pos = (loaded.state.pos[0] + 0.06 * loaded.shape.radius, loaded.state.pos[1], 0)
    sediment.advance(30)
    assert loaded.id in gas.rattlersNow() and loaded.id not in gas.rattlers
    moved = gas.displacements()
    k = moved["ids"].index(loaded.id)
    assert moved["rattler"][k] and not moved["rattlerAtStart"][k] and moved["displacement"][k] > 0.04
    levels = gas.levels()
    assert levels["displacement"][-1] < 0.04 < levels["displacementWithRattlers"][-1]
    shot = snapshot.takeSnapshot(gas)
    assert shot.rattler[list(shot.ids).index(loaded.id)]
    assert gas.displacements(atBreakthrough=True)["ids"] == []


def test_displacementsAtTheBreakthroughAreKept(loadSample):
    loadSample()
    gas = injection.startInjection(start=400, increment=1, max=400, pores=3)
    sediment.advance(200)
    assert gas.breakthroughIter >= 0
    then = gas.displacements(atBreakthrough=True)
    assert then["ids"] == gas.displacements()["ids"]
    loaded = [m for m, a, b in zip(then["displacement"], then["rattlerAtStart"], then["rattler"]) if not (a or b)]
    assert max(loaded) == gas.breakthroughDisplacement
    assert not hasattr(PoreNetworkEngine(), "rattlersNow")
