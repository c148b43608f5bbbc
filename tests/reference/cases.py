# SPDX-License-Identifier: GPL-2.0-or-later
"""Small runs that together use every option of the fluid engines, and the tables of numbers they leave.

``STILL``: the grains do not move, so a result is a matter of the model alone. ``MOVING``: 300 steps with the grains
free or driven. No more: between grains in contact a difference grows tenfold in some 70 steps, 1e-15 of a radius at
the start is 1e-9 of it after 300 steps and 1e-7 after 500. Each case is a function (build) -> dict of
table name -> dict of column -> list of numbers; ``build(rMin)`` puts the stored settled sample into the scene
(tests/settled.py). Columns have the names that ``tolerances.py`` knows.
"""

import numpy as np
from yade import O
from yade.wrapper import ForceResetter, SinglePhaseFlowEngine

from capfrac import injection, sediment
from capfrac.scene.gasengine import engineOfGas
from capfrac.scene.gasobjects import gasObjects

NAN = float("nan")
#: Entry pressures of the sample of 1-2 mm are 121-241 Pa; with this absolute pressure of the
#: water a gas is felt to be compressible.
IDEAL = dict(gasLaw="ideal", gasMolarMass=0.02, gasTemperature=300.0, gasDeviation=0.9, pressureDatum=1000.0)
TABLE = [(1e3, 0.01), (2e3, 0.021), (1e5, 1.3)]
STEPS = 300


# --- what is kept of a run ------------------------------------------------------------------------


def rowsOf(log, names):
    """The chosen columns of a log; pairs and triples of body ids become a column each."""
    table = {}
    for name in names:
        values = log[name]
        if values and isinstance(values[0], (tuple, list)):
            for k in range(len(values[0])):
                table[f"{name}{k}"] = [value[k] for value in values]
        else:
            table[name] = [float(value) for value in values]
    return table


def gasTables(gas):
    """Events, levels, cells and ledgers of a gas engine."""
    cells = gas.cells()
    events = (
        "time",
        "iteration",
        "level",
        "gasPressure",
        "throat",
        "pore",
        "x",
        "y",
        "entryPressure",
        "gap",
        "gapGrowth",
        "opened",
        "cells",
        "volume",
    )
    levels = ("pressure", "gasSaturation", "brokenBonds", "displacement", "gasVolume", "atRest", "iteration")
    returns = ("time", "iteration", "gasPressure", "threshold", "x", "y", "cells", "volume")
    history = ("time", "iteration", "gasPressure", "connectedVolume", "mass", "gasSaturation")
    ledger = {
        **{f"volume.{name}": [value] for name, value in gas.volumes().items() if name != "error"},
        **{f"mass.{name}": [value] for name, value in gas.gasLedger().items() if name != "error"},
    }
    return {
        "events": rowsOf(gas.events(), events),
        "levels": rowsOf(gas.levels(), levels),
        "returns": rowsOf(gas.imbibitionEvents(), returns),
        "history": rowsOf(gas.history(), history),
        "cells": rowsOf(cells, ("phase", "pressure", "void", "gas")),
        "ledger": ledger,
    }


def flowTables(flow):
    """Pores, fluxes through the walls and the ledger of one fluid."""
    pores = flow.pores()
    return {
        "pores": {name: list(pores[name]) for name in ("x", "y", "pressure", "volume")},
        "walls": {f"inflow.{name}": [value] for name, value in flow.inflow().items()},
        "ledger": {f"volume.{name}": [value] for name, value in flow.volumes().items() if name != "error"},
    }


def grainTable():
    """Where the grains and walls are."""
    bodies = sorted(O.bodies, key=lambda body: body.id)
    return {"positionX": [b.state.pos[0] for b in bodies], "positionY": [b.state.pos[1] for b in bodies]}


# --- grains that stand still ----------------------------------------------------------------------


def rigidGas(build, steps=400, waterFlow="drained", **attributes):
    build(1e-3)
    gas = engineOfGas(waterFlow)(
        label="gas", checkInvariants=True, minLevelSteps=1, maxLevelSteps=1, historyInterval=7, **gasObjects(attributes)
    )
    left, right = O.bodies[0].state.pos[0], O.bodies[1].state.pos[0]
    if "inletPoints" not in attributes:
        gas.inletFrom, gas.inletTo = gas.inletStretch(2, 0.5 * (left + right))
    O.engines = [ForceResetter(), gas]
    for _ in range(steps):
        O.step()
    return gasTables(O.engines[1])


def rigidFlow(build, scheme, **attributes):
    build(1e-3)
    flow = SinglePhaseFlowEngine(
        label="flow",
        timeIntegration=scheme,
        bulkModulus=1e7,
        viscosity=1.0,
        fluidDensity=1000,
        gravity=(3.0, -9.81),
        wallPressures=[NAN, NAN, 2e3, 0.0],
        **attributes,
    )
    O.engines = [flow]
    O.dt = 0.5 * flow.explicitTimeStepLimit()
    for _ in range(50):
        O.step()
    return flowTables(O.engines[0])


STILL = {
    "ramp": lambda build: rigidGas(build, gasPressure=100, pressureIncrement=5, maxPressure=300),
    "triangles": lambda build: rigidGas(
        build,
        gasPressure=100,
        pressureIncrement=5,
        maxPressure=300,
        poreMode="triangle",
        trapping=True,
        entryLaw="mayerStowePrincen",
        invasionInterval=3,
    ),
    "imbibition": lambda build: rigidGas(
        build,
        steps=900,
        gasPressure=100,
        pressureIncrement=10,
        pressureProgram=[220, 10, 200, 60],
        imbibition=True,
        snapOff=True,
        trapping=True,
    ),
    "films": lambda build: rigidGas(
        build,
        gasPressure=120,
        pressureIncrement=5,
        maxPressure=260,
        trapping=True,
        filmConductance=1e-7,
        contactAngle=0.3,
    ),
    "buoyancy": lambda build: rigidGas(
        build,
        gasPressure=100,
        pressureIncrement=5,
        maxPressure=300,
        fluidDensity=1000,
        gasDensity=50,
        gravity=(1.0, -9.81),
    ),
    "reservoir": lambda build: rigidGas(build, gasPressure=230, gasControl="reservoir", reservoirVolume=1e-4, **IDEAL),
    "rate": lambda build: rigidGas(
        build,
        gasPressure=100,
        gasControl="rate",
        gasRate=1e-6,
        reservoirVolume=3e-6,
        pressureIncrement=3,
        imbibition=True,
        gasLaw="tabulated",
        gasTable=TABLE,
        pressureDatum=1000.0,
    ),
    "points": lambda build: rigidGas(
        build,
        gasPressure=100,
        pressureIncrement=5,
        maxPressure=300,
        outletWall="any",
        inletPoints=[(12.9e-3, 12.7e-3), (12e-3, 8.8e-3)],
    ),
    "solved": lambda build: rigidGas(
        build,
        steps=600,
        gasPressure=180,
        pressureIncrement=5,
        maxPressure=300,
        waterFlow="solved",
        viscosity=1e-3,
        bulkModulus=2.2e9,
        **IDEAL,
    ),
    "solvedWeight": lambda build: rigidGas(
        build,
        steps=600,
        gasPressure=200,
        pressureIncrement=5,
        maxPressure=300,
        waterFlow="solved",
        poreMode="triangle",
        fluidDensity=1000,
        gasDensity=50,
        gravity=(0.0, -9.81),
        filmConductance=1e-9,
        gasLaw="ideal",
    ),
    **{
        f"flow-{scheme}": lambda build, scheme=scheme: rigidFlow(build, scheme)
        for scheme in ("explicit", "implicit", "undrainedStable")
    },
}


# --- grains that move -----------------------------------------------------------------------------


def movingGas(build, rMin, menisci=None, **attributes):
    build(rMin)
    gas = injection.startInjection(
        pores=3, checkInvariants=True, minLevelSteps=20, maxLevelSteps=100, historyInterval=11, **attributes
    )
    if menisci:
        injection.addMenisci(**menisci)
    sediment.advance(STEPS)
    return {**gasTables(sediment.engine("gas") or gas), "grains": grainTable()}


def movingFlow(build, drive, **attributes):
    build(1e-3)
    sediment.insertFluid(SinglePhaseFlowEngine(label="flow", bulkModulus=1e7, **attributes))
    drive()
    sediment.advance(STEPS)
    return {**flowTables(sediment.engine("flow")), "grains": grainTable()}


def piston():
    """The lid comes down by half a grain: contacts open and close, the mesh is made anew on the way."""
    servo = sediment.engine("servo")
    servo.drivenWalls, servo.driveVelocity = ["top"], 0.5e-3 / (STEPS * O.dt)


def shear():
    """Grains keep the speed of a simple shear flow; the network follows them through its flips."""
    height = sediment.boxSize()[1]
    for body in sediment.grainBodies():
        body.state.blockedDOFs = "xyzXYZ"
        body.state.vel = (1e-3 / (STEPS * O.dt) * (body.state.pos[1] / height - 0.5), 0, 0)


FINE = dict(start=130e3, increment=5e3, max=250e3)
COARSE = dict(start=160, increment=5, max=300)
MOVING = {
    "fracture": lambda build: movingGas(build, 1e-6, **FINE),
    "fracture-rate": lambda build: movingGas(
        build,
        1e-6,
        **FINE,
        poreMode="triangle",
        invasionInterval=20,
        gasControl="rate",
        gasRate=4e-6,
        reservoirVolume=2e-10,
        gasLaw="ideal",
    ),
    "fracture-cycle": lambda build: movingGas(
        build, 1e-6, **FINE, imbibition=True, trapping=True, pressureProgram=[150e3, 20e3, 160e3]
    ),
    "menisci": lambda build: movingGas(build, 1e-3, menisci=dict(law="bridge"), **COARSE),
    "menisci-constant": lambda build: movingGas(build, 1e-6, menisci=dict(law="constant", chi=5), **FINE),
    "solved-moving": lambda build: movingGas(build, 1e-3, **COARSE, waterFlow="solved", gasLaw="ideal"),
    "solved-soft": lambda build: movingGas(
        build, 1e-3, **COARSE, waterFlow="solved", gasLaw="ideal", grainBulkModulus=1e8
    ),
    "piston": lambda build: movingFlow(build, piston, wallPressures=[NAN, NAN, 0.0, NAN]),
    "piston-soft": lambda build: movingFlow(
        build, piston, wallPressures=[NAN, NAN, 0.0, NAN], grainBulkModulus=1e9, fluidDensity=1000, gravity=(0, -9.81)
    ),
    "shear": lambda build: movingFlow(build, shear, wallPressures=[0.0, 0.0, NAN, NAN], poreMode="triangle"),
}


def finite(table):
    """A table as arrays of floats, for comparing."""
    return {name: np.array(values, dtype=float) for name, values in table.items()}
