# SPDX-License-Identifier: GPL-2.0-or-later
"""What a save forgets: runs with every supply and option, saved and loaded on the way, against those that never were.

Grains are driven along given paths, without contacts: no order of contacts and no chaos comes in, and all numbers must
be the same to the bit, those that only carry the state into the file included.
"""

import math
import re

import numpy as np
import pytest
from yade import O, utils
from yade.wrapper import (
    ForceResetter,
    GasInvasionEngine,
    MeniscusCohesionEngine,
    NewtonIntegrator,
    PoreNetworkEngine,
    SinglePhaseFlowEngine,
    TabulatedGas,
    ViscousInvasionEngine,
    WallServoEngine,
)

from capfrac.scene.gasobjects import gasObjects

STEPS = 160
#: Steps before which the scene is saved and loaded, or only saved.
LOADS, SAVES = (0, 1, 2, 37, 38, 75, 112, 151), (20, 90)
PRESSURES = dict(gasPressure=60, pressureIncrement=10, maxPressure=200, minLevelSteps=1, maxLevelSteps=1)
IDEAL = dict(gasLaw="ideal", pressureDatum=300)
SOLVED = dict(bulkModulus=1e5, viscosity=1e-3, **IDEAL)
WEIGHT = dict(fluidDensity=1000, gasDensity=80, gravity=(1, -9.81))
RATE = dict(gasControl="rate", gasRate=2e-5, **IDEAL)


def gas(**attributes):
    return GasInvasionEngine(
        label="it", invasionInterval=2, checkInvariants=True, **gasObjects({**PRESSURES, **attributes})
    )


def viscous(**attributes):
    return ViscousInvasionEngine(label="it", checkInvariants=True, **gasObjects({**PRESSURES, **SOLVED, **attributes}))


def water(**attributes):
    held = [math.nan, math.nan, 50, math.nan]
    return SinglePhaseFlowEngine(label="it", **{"bulkModulus": 1e5, "wallPressures": held, **attributes})


def at(step, **attributes):
    """What the user assigns before a step; ``supply__rate`` to the object that is there."""
    return {step: attributes}


#: Name: (engine, assignments on the way, what must have happened by the end).
RUNS = {
    "ramp": (lambda: gas(trapping=True), {}, lambda e: e.nEvents > 1 and e.level > 5),
    "rampDone": (lambda: gas(maxPressure=80), {}, lambda e: e.rampDone and e.level == 3),
    "rampMovedUp": (lambda: gas(maxPressure=80), at(80, maxPressure=100), lambda e: e.rampDone and e.level == 6),
    "held": (lambda: gas(pressureIncrement=0), {}, lambda e: e.rampDone and e.level == 1),
    "heldByHand": (
        lambda: gas(pressureIncrement=0),
        {**at(40, gasPressure=120), **at(100, openingThreshold=0.02)},
        lambda e: e.rampDone and e.level == 2,
    ),
    "program": (
        lambda: gas(pressureProgram=[150, 70, 90], pressureIncrement=90, imbibition=True, snapOff=True),
        {},
        lambda e: e.rampDone and e.programPosition == 3 and e.level >= 4,
    ),
    "programChanged": (
        lambda: gas(pressureProgram=[150, 70], pressureIncrement=30),
        at(60, supply__program=[70, 130, 60]),
        lambda e: e.rampDone and e.programPosition == 3,
    ),
    "triangles": (lambda: gas(poreMode="triangle", mergeTolerance=0.01, localFlips=False), {}, lambda e: e.nEvents > 5),
    "rate": (lambda: gas(historyInterval=3, reservoirVolume=3e-5, **RATE), {}, lambda e: e.nEvents > 0),
    "ratePoor": (lambda: gas(historyInterval=3, **RATE), {}, lambda e: e.nEvents > 0),
    "shutIn": (lambda: gas(reservoirVolume=3e-5, **RATE), at(60, supply__rate=0), lambda e: e.nEvents > 0),
    "reservoir": (
        lambda: gas(
            gasPressure=190,
            gasControl="reservoir",
            reservoirVolume=3e-4,
            gasLaw="tabulated",
            gasTable=[(100, 0.1), (400, 0.5), (5000, 3)],
            pressureDatum=300,
        ),
        {},
        lambda e: e.rampDone and e.level == 1 and e.nEvents > 0,
    ),
    "lawChanged": (
        lambda: gas(reservoirVolume=3e-5, **RATE),
        {**at(50, gasLaw__deviation=0.8), **at(90, gasLaw=TabulatedGas(table=[(100, 0.1), (400, 0.5), (5000, 3)]))},
        lambda e: e.nEvents > 0,
    ),
    "reservoirAttached": (lambda: gas(**RATE), at(50, supply__reservoirVolume=2e-6), lambda e: e.nEvents > 0),
    "controlChanged": (lambda: gas(maxPressure=80, **IDEAL), at(70, **gasObjects(RATE)), lambda e: e.nEvents > 0),
    "films": (
        lambda: gas(trapping=True, filmConductance=1e-9, outletWall="right", gasPressure=150, **IDEAL),
        {},
        lambda e: e.nEvents > 0 and e.nTrappedWater > 0,
    ),
    "imbibition": (
        lambda: gas(
            gasPressure=190, pressureIncrement=0, imbibition=True, snapOff=True, gasDeviation=0.9, **IDEAL, **WEIGHT
        ),
        {**at(40, gasPressure=30), **at(100, gasPressure=180)},
        lambda e: e.nReturns > 3,
    ),
    "buoyancy": (lambda: gas(**WEIGHT), {}, lambda e: e.nEvents > 0),
    "points": (
        lambda: gas(inletPoints=[(3.17e-3, 3.2e-4)], outletWall="any", entryLaw="mayerStowePrincen"),
        {},
        lambda e: e.nEvents > 0,
    ),
    "solved": (viscous, {}, lambda e: e.nEvents > 0),
    "solvedRate": (
        lambda: viscous(filmConductance=1e-9, reservoirVolume=2e-6, **{**RATE, "gasRate": 3e-6}),
        {},
        lambda e: e.nEvents > 0,
    ),
    "solvedHeavy": (
        lambda: viscous(grainBulkModulus=1e7, conductanceLaw="lubrication", pressureDatum=1e5, **WEIGHT),
        {},
        lambda e: e.nEvents > 0,
    ),
    "water": (water, {}, lambda e: e.nFactorizations > 0),
    "waterImplicit": (
        lambda: water(timeIntegration="implicit", grainBulkModulus=1e7, fluidDensity=1000, gravity=(0, -9.81)),
        {},
        lambda e: e.nFactorizations > 0,
    ),
    "waterExplicit": (
        lambda: water(timeIntegration="explicit", bulkModulus=20, viscosity=1e-2, wallFluxes=[1e-9, 0, 0, 0]),
        {},
        lambda e: e.wallInflow[0] > 0,
    ),
    "incompressible": (
        lambda: water(bulkModulus=math.inf, pointFluxes=[(5e-3, 5e-3, 1e-9)]),
        at(50, wallPressures=[0, 0, 0, 0]),
        lambda e: e.nFactorizations > 0,
    ),
    "network": (lambda: PoreNetworkEngine(label="it", waterPressure=1e3), {}, lambda e: e.nRemeshes > 1),
}
#: What engines tell, by the names of their methods.
REPORTS = (
    "cells",
    "throats",
    "volumes",
    "fluidForces",
    "dict",
    "events",
    "imbibitionEvents",
    "levels",
    "gasLedger",
    "history",
    "brokenBonds",
    "nextEntryPressure",
    "displacements",
    "rattlersNow",
    "pores",
    "inflow",
    "menisci",
)


def it():
    return next(engine for engine in O.engines if engine.label == "it")


def asNow(report):
    """A report with what the objects in it are now: they may change."""
    if not isinstance(report, dict):
        return report
    return {k: (type(v).__name__, v.dict()) if hasattr(v, "dict") else v for k, v in report.items()}


def reports():
    """All that the engines of the scene tell."""
    return {
        (engine.label, name): asNow(getattr(engine, name)())
        for engine in O.engines
        for name in REPORTS
        if hasattr(engine, name)
    }


def same(a, b):
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(same, a, b))
    return a == b or (isinstance(a, float) and math.isnan(a) and math.isnan(b))


def engineText(path):
    """The engines as the file has them, hidden attributes and all."""
    O.save(str(path), quiet=True)
    return re.search(r"<engines.*?</engines>", path.read_text(), re.S).group()


def drive(assignments, path, interrupted, observe):
    """STEPS steps; returns what the engines tell on the way, where ``observe``, and at the end."""
    seen = []
    for step in range(STEPS):
        if interrupted and step in LOADS:
            O.save(path, quiet=True)
            O.reset()
            O.load(path, quiet=True)
        elif interrupted and step in SAVES:
            O.save(path, quiet=True)
        for name, value in assignments.get(step, {}).items():
            *object, name = name.split("__")
            setattr(getattr(it(), object[0]) if object else it(), name, value)
        rng = np.random.default_rng(3)
        for body in O.bodies:
            if hasattr(body.shape, "radius"):
                phase, speed = rng.uniform(0, 2 * math.pi), 0.05 * rng.uniform(0.5, 1.5)
                body.state.vel = (speed * math.cos(phase + step / 11), speed * math.sin(phase + step / 17), 0)
        O.step()
        if observe and step % 3 == 0:
            seen.append(reports())
    return seen, reports()


@pytest.fixture
def driven(settledScene):
    """A function (engine, menisci) that puts the engine into a scene of 60 grains that go where they are driven."""

    def make(engine, menisci=False, still=False):
        walls = settledScene()
        if isinstance(engine, (GasInvasionEngine, ViscousInvasionEngine)) and not engine.inletPoints:
            middle = 0.5 * (walls[0] + walls[1])
            engine.inletFrom, engine.inletTo = engine.inletStretch(2, middle)
        O.engines = [
            ForceResetter(),
            *([MeniscusCohesionEngine(label="menisci")] if menisci else []),
            engine,
            *([] if still else [NewtonIntegrator(label="newton")]),
        ]
        O.dt = 1e-4

    return make


@pytest.mark.parametrize("observe", [False, True], ids=["quiet", "observed"])
@pytest.mark.parametrize("name", RUNS)
def test_runThatIsSavedAndLoadedIsTheOneThatIsNot(driven, tmp_path, name, observe):
    # Reports bring the network up to the grains: a run that is looked at is another one, in the last digits of cells.
    make, assignments, happened = RUNS[name]
    found = []
    for interrupted in (False, True):
        driven(make(), menisci=name in ("ramp", "imbibition"))
        seen = drive(assignments, str(tmp_path / "scene.yade.gz"), interrupted, observe)
        found.append(([*seen[0], seen[1]], engineText(tmp_path / "scene.xml")))
    assert happened(it()) and it().nRemeshes > 0
    (whole, textWhole), (continued, text) = found
    for k, (a, b) in enumerate(zip(whole, continued)):
        for what in a:
            assert same(a[what], b[what]), f"report {k}: {what}"
    assert text == textWhole


@pytest.mark.parametrize("name", RUNS)
def test_loadingChangesNothingThatIsSaved(driven, tmp_path, name):
    make, assignments, _ = RUNS[name]
    driven(make(), menisci=name in ("ramp", "imbibition"))
    drive(assignments, "", False, False)
    texts = []
    for _ in range(2):
        texts.append(engineText(tmp_path / "scene.xml"))
        O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
        O.reset()
        O.load(str(tmp_path / "scene.yade.gz"), quiet=True)
    assert texts[0] == texts[1]


def test_whatIsSavedDoesNotComeBackAtAnAssignment(driven, tmp_path):
    # The menisci that hung when the scene was saved are gone when the attribute is set.
    driven(gas(gasPressure=190, maxPressure=190, pressureIncrement=0), menisci=True, still=True)
    menisci = O.engines[1]
    O.step()
    O.step()
    assert menisci.nMenisci > 0
    O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
    it().dead = True
    O.engines = [O.engines[0], menisci, PoreNetworkEngine()]
    menisci.interfacialTension, menisci.contactAngle = 0.05, 0
    O.step()
    assert menisci.nMenisci == 0 and menisci.menisci()["ids"] == []
    menisci.chi = 11
    assert menisci.menisci()["ids"] == []


def test_bodiesThatComeAfterLoadingAreNoticed(driven, tmp_path):
    driven(gas(), still=True)
    O.step()
    O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
    O.reset()
    O.load(str(tmp_path / "scene.yade.gz"), quiet=True)
    O.bodies.append(utils.sphere((0, 0, 0), 1e-3))
    with pytest.raises(RuntimeError, match="bodies cannot be added or removed"):
        O.step()


def test_programThatWasChangedBeforeTheSaveBegins(driven, tmp_path):
    # Nobody has asked the engine in between: the file has the new program and the position in the old one.
    driven(gas(pressureProgram=[60], pressureIncrement=30), still=True)
    O.run(40, True)
    assert it().rampDone and it().programPosition == 1
    it().supply.program = [90, 60]
    O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
    O.reset()
    O.load(str(tmp_path / "scene.yade.gz"), quiet=True)
    assert not it().rampDone and it().programPosition == 0
    O.run(60, True)
    assert it().rampDone and it().levels()["pressure"] == [60, 60, 90, 60]


def test_servoIsTheSameAfterLoading(loadSample, tmp_path):
    # Contacts keep their order in a sample at rest: the collider has nothing to find.
    def run(interrupted):
        loadSample()
        servo = next(engine for engine in O.engines if isinstance(engine, WallServoEngine))
        servo.meanStress, servo.drivenWalls, servo.driveVelocity = 9e3, ["top"], 1e-4
        for step in range(60):
            if interrupted and step in LOADS:
                O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
                O.reset()
                O.load(str(tmp_path / "scene.yade.gz"), quiet=True)
            O.step()
        servo = next(engine for engine in O.engines if isinstance(engine, WallServoEngine))
        return servo.dict(), [(tuple(b.state.pos), tuple(b.state.vel)) for b in O.bodies]

    assert run(False) == run(True)
