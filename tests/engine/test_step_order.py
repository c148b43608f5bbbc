# SPDX-License-Identifier: GPL-2.0-or-later
"""Engines in a place of the step where they would do something else than what is meant: a named error with the cure."""

import pytest
from yade import O
from yade.wrapper import (
    CentralConstantAccelerationEngine,
    ForceEngine,
    GasInvasionEngine,
    GravityEngine,
    InteractionLoop,
    MeniscusCohesionEngine,
    NewtonIntegrator,
    ParallelEngine,
    PoreNetworkEngine,
    PyRunner,
    SinglePhaseFlowEngine,
    WallServoEngine,
)

from capfrac import injection, sediment

R = 1e-3
ORDER = "allowed in O.engines, in this order: ForceResetter, collider, InteractionLoop"


@pytest.fixture
def scene(handScene):
    """A function () -> (engines that are right without a fluid, by name); four grains that touch in a box."""

    def make():
        handScene([(x, y, R) for x in (R, 2.99 * R) for y in (R, 2.99 * R)], (0, 4 * R, 0, 4 * R), fixed=False)
        reset, collider, loop, servo, newton = O.engines
        servo.stressX = servo.stressY = 1e3
        servo.dead = False
        return dict(reset=reset, collider=collider, loop=loop, servo=servo, newton=newton)

    return make


def gas(**attributes):
    return GasInvasionEngine(label="gas", gasPressure=1, inletFrom=0, inletTo=4 * R, **attributes)


FLUIDS = {"gas": gas, "water": lambda: SinglePhaseFlowEngine(wallPressures=[0, 0, 0, 0]), "network": PoreNetworkEngine}


def refused(match):
    """The step ends with that error, which tells the right order."""
    with pytest.raises(RuntimeError, match=match) as problem:
        O.step()
    assert ORDER in str(problem.value)


@pytest.mark.parametrize("fluid", FLUIDS)
@pytest.mark.parametrize(
    "order, message",
    [
        ("fluid reset collider loop servo newton", "stands before ForceResetter: .* wiped out"),
        ("reset fluid collider loop servo newton", "stands before InteractionLoop: .* not there yet"),
        ("reset collider fluid loop servo newton", "stands before InteractionLoop"),
        ("reset collider loop newton fluid", "stands after NewtonIntegrator: .* never reach"),
        ("collider loop fluid newton", "meets no ForceResetter"),
        ("reset collider loop fluid", "meets contacts, but no NewtonIntegrator: nothing would ever move"),
        ("reset collider loop loop2 fluid newton", r"meets 2 engines where one is allowed \(InteractionLoop, Interac"),
        ("reset collider loop fluid newton newton2", "meets 2 engines where one is allowed"),
        ("reset collider loop fluid fluid2 newton", "meets 2 engines where one is allowed .*; take one out of O.eng"),
        ("reset collider loop fluid field newton", "stands before CentralConstantAccelerationEngine"),
        ("reset collider loop fluid push newton", "stands before ForceEngine: the forces of that are not there yet"),
    ],
)
def test_fluidEngineInTheWrongPlace(scene, fluid, order, message):
    here = scene()
    here["collider"].verletDist = 0  # with another, the collider itself asks for an integrator
    engine = FLUIDS[fluid]()
    here.update(
        fluid=engine,
        fluid2=PoreNetworkEngine(),
        newton2=NewtonIntegrator(),
        push=ForceEngine(force=(0, 0, 0)),
        loop2=InteractionLoop([], [], []),
        field=CentralConstantAccelerationEngine(centralBody=4),
    )
    O.engines = [here[name] for name in order.split()]
    named = f"{type(engine).__name__} {message}"
    if "fluid2" not in order:
        with pytest.raises(RuntimeError, match="^" + named):
            engine.prepare()
    refused(named)
    assert engine.nCells == 0
    with pytest.raises(RuntimeError, match=named):
        O.run(10, True)


def test_servoBeforeTheFluid(scene):
    # Whichever of the two comes to it first says so.
    here, engine = scene(), gas()
    O.engines = [here["reset"], here["collider"], here["loop"], here["servo"], engine, here["newton"]]
    refused("^WallServoEngine stands before GasInvasionEngine: the walls would answer to a part of the forces only")
    with pytest.raises(RuntimeError, match="^GasInvasionEngine stands after WallServoEngine: the walls would not answ"):
        engine.prepare()


@pytest.mark.parametrize(
    "order, name, message",
    [
        ("servo reset collider loop newton", "WallServoEngine", "stands before ForceResetter"),
        (
            "reset collider servo loop newton",
            "WallServoEngine",
            "stands before InteractionLoop: the walls would answer",
        ),
        ("reset collider loop newton servo", "WallServoEngine", "stands after NewtonIntegrator"),
        ("reset collider loop servo", "WallServoEngine", "no NewtonIntegrator"),
        ("reset collider loop servo servo2 newton", "WallServoEngine", "2 engines where one is allowed"),
        ("menisci reset collider loop gas newton", "MeniscusCohesionEngine", "stands before ForceResetter"),
        (
            "reset collider loop gas menisci newton",
            "MeniscusCohesionEngine|GasInvasionEngine",
            "MeniscusCohesionEngine",
        ),
        (
            "reset collider loop gas newton menisci",
            "MeniscusCohesionEngine|GasInvasionEngine",
            "MeniscusCohesionEngine",
        ),
    ],
)
def test_servoAndMenisciInTheWrongPlace(scene, order, name, message):
    here = scene()
    here["collider"].verletDist = 0
    here.update(gas=gas(), menisci=MeniscusCohesionEngine(label="menisci"), servo2=WallServoEngine())
    O.engines = [here[engine] for engine in order.split()]
    refused(f"({name}) .*{message}")


def test_enginesWithinAParallelEngine(scene):
    here = scene()
    # An exception within it would end the program: it is raised when the step is over.
    O.engines = [here["reset"], here["collider"], here["loop"], ParallelEngine([gas(), nothing()]), here["newton"]]
    for step in (O.step, lambda: O.run(1000, True)):
        with pytest.raises(RuntimeError, match="^GasInvasionEngine stands within a ParallelEngine") as problem:
            step()
        assert ORDER in str(problem.value)
    assert O.iter < 100


def nothing():
    return PyRunner(command="pass", iterPeriod=10**9)


@pytest.mark.parametrize(
    "order",
    [
        "reset collider loop menisci fluid servo newton",
        "reset menisci collider loop fluid servo newton",  # forces add up in any order
        "reset collider loop weight fluid newton",
        "reset collider loop fluid weight servo newton",  # both are known
        "dead newtonDead loopDead reset collider loop fluid servo newton newtonDead fluidDead",
        "reset parallel fluid servo newton",
        "reset collider loop fluid newtonDead",  # frozen on purpose
        "fluid",
        "reset fluid",
        "fluid reset",  # nothing moves
    ],
)
def test_placesThatAreRight(scene, order):
    here = scene()
    dead = dict(dead=True)
    here.update(
        fluid=gas(),
        menisci=MeniscusCohesionEngine(label="menisci"),
        fluidDead=PoreNetworkEngine(**dead),
        weight=GravityEngine(gravity=(0, -1, 0), warnOnce=False),
        newtonDead=NewtonIntegrator(**dead),
        loopDead=InteractionLoop([], [], [], **dead),
        dead=SinglePhaseFlowEngine(**dead),
    )
    if "parallel" in order:
        here["parallel"] = ParallelEngine([[here["collider"], here["loop"]], nothing()])
    O.engines = [here[name] for name in order.split()]
    for _ in range(3):
        O.step()
    assert here["fluid"].nCells > 0


def test_engineOutsideOfTheLoopIsCalledByHand(scene):
    scene()
    engine = gas()
    engine.prepare()
    engine()
    assert engine.nCells > 0


def test_substepsAreSteps(scene):
    here = scene()
    engine = gas()
    O.engines = [here["reset"], here["collider"], here["loop"], engine, here["servo"], here["newton"]]
    O.subStepping = True
    try:
        for _ in range(2 * (len(O.engines) + 2)):
            O.step()
    finally:
        O.subStepping = False
    assert O.iter >= 2 and engine.nCells > 0


@pytest.mark.parametrize("make", [gas, WallServoEngine])
def test_periodicScene(scene, make):
    here = scene()
    O.periodic = True
    O.cell.setBox(60 * R, 60 * R, 60 * R)
    here["collider"].allowBiggerThanPeriod = True
    engine = make()
    O.engines = [here["reset"], here["collider"], here["loop"], engine, here["newton"]]
    with pytest.raises(RuntimeError, match="the scene is periodic; allowed: .* O.periodic = False"):
        O.step()


def test_shippedScenesAreRight(loadSample):
    loadSample()
    injection.startInjection(start=50, increment=1, max=60, pores=3)
    injection.addMenisci()
    sediment.advance(5)
    assert sediment.engine("menisci").nMenisci > 0
