# SPDX-License-Identifier: GPL-2.0-or-later
"""Saving and loading: nothing is lost, and a run that is taken up again goes on as if it had not been interrupted.

Everything is compared to the last bit, the run after loading, too. A tolerance would hide what a fracturing sample
amplifies anyway.
"""

import math

import numpy as np
import pytest
from yade import O
from yade.wrapper import (
    DiskMat,
    GasInvasionEngine,
    IdealGas,
    Ig2_Wall_Sphere_ScGeom6D,
    InteractionLoop,
    Ip2_DiskMat_DiskMat_CohFrictPhys,
    Ip2_WallMat_DiskMat_CohFrictPhys,
    Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
    PoreNetworkEngine,
    PressureSupply,
    RateSupply,
    ReservoirSupply,
    TabulatedGas,
    ViscousInvasionEngine,
    WallMat,
    WallServoEngine,
)

import restart
from capfrac import injection, sediment
from restart import reload

STARTED = dict(
    start=130e3, increment=5e3, max=200e3, pores=3, minLevelSteps=20, maxLevelSteps=200, checkInvariants=True
)


def same(a, b):
    """Equality to the bit of nested lists and dicts; NaN equals NaN."""
    if hasattr(a, "dict"):  # an object of YADE
        return type(a) is type(b) and same(a.dict(), b.dict())
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(same, a, b))
    return a == b or (isinstance(a, float) and math.isnan(a) and math.isnan(b))


def attributesOf(thing):
    """All that has a name and a value: attributes, and what is told of the state."""
    kinds = {name: kind for base in reversed(type(thing).__mro__) for name, kind in vars(base).items()}
    return {name: getattr(thing, name) for name, kind in kinds.items() if isinstance(kind, property) and name[0] != "_"}


def reports(gas):
    return {
        "cells": gas.cells(),
        "throats": gas.throats(),
        "volumes": gas.volumes(),
        "events": gas.events(),
        "levels": gas.levels(),
        "forces": gas.fluidForces(),
        "broken": gas.brokenBonds(),
        "next": gas.nextEntryPressure(),
        "ledger": gas.gasLedger(),
        "history": gas.history(),
    }


#: The same sample under a rate, torn within the 2000 steps, too.
SUPPLIED = dict(
    gasLaw="ideal", gasControl="rate", gasRate=3e-5, reservoirVolume=3e-10, invasionInterval=20, historyInterval=10
)


@pytest.mark.parametrize("supply", [{}, SUPPLIED], ids=["ramp", "rate"])
@pytest.mark.parametrize("steps", [0, 10, 1200, 2000])
def test_stateIsTheSameToTheBit(loadSample, tmp_path, steps, supply):
    # Before the first step, in the intact sample, and torn (levels, events, broken bonds, remeshings).
    loadSample(1e-6)
    gas = injection.startInjection(**STARTED, poreMode="domain", trapping=True, **supply)
    O.run(steps, True) if steps else None
    before, attributes, servo = reports(gas), attributesOf(gas), attributesOf(sediment.engine("servo"))
    if steps >= 1200:
        assert before["events"]["throat"] and gas.nRemeshes > 0
    reload(tmp_path)
    gas = sediment.engine("gas")
    assert same(attributesOf(gas), attributes)
    assert same(attributesOf(sediment.engine("servo")), servo)
    after = reports(gas)
    for name in before:
        assert same(after[name], before[name]), name


# In the intact sample, while it is torn, and when it has been.
@pytest.mark.parametrize("steps", [300, 600, 1200, 1600])
@pytest.mark.parametrize("supply", [{}, SUPPLIED], ids=["ramp", "rate"])
def test_continuedRunIsTheUninterruptedOne(loadSample, tmp_path, steps, supply):
    def run(interrupt):
        loadSample(1e-6)
        injection.startInjection(**STARTED, **supply)
        sediment.advance(steps)
        restart.cut(tmp_path, interrupt)
        sediment.advance(2000 - steps)
        gas = sediment.engine("gas")
        return reports(gas), attributesOf(gas), [(tuple(b.state.pos), tuple(b.state.vel)) for b in O.bodies]

    whole, continued = run(False), run(True)
    # Grains of 1-2 um under 8 kPa cannot bear what the ramp has come to, nor what the rate has, by far.
    assert whole[0]["events"]["throat"] and whole[1]["nRemeshes"] > 0
    assert same(continued, whole)


def test_continuedImbibitionIsTheUninterruptedOne(loadSample, tmp_path):
    """Trapped gas, its pressure and the throats that are snapped off survive: the rest of the cycle has the
    same bits.
    """

    def run(interrupt):
        loadSample(1e-3)
        injection.startInjection(
            start=250,
            increment=0,
            max=251,
            pores=2,
            imbibition=True,
            snapOff=True,
            fluidDensity=1000,
            gravity=(0, -1.0),
            checkInvariants=True,
        )
        sediment.advance(300)
        sediment.engine("gas").gasPressure = 60
        sediment.advance(300)
        gas = sediment.engine("gas")
        assert gas.nReturns > 0 and any(gas.cells()["cutOff"]) and "snapOff" in gas.imbibitionEvents()["kind"]
        before = reports(gas), gas.imbibitionEvents()
        restart.cut(tmp_path, interrupt)
        gas = sediment.engine("gas")
        assert same((reports(gas), gas.imbibitionEvents()), before)
        for pressure in (30, 250):
            gas.gasPressure = pressure
            sediment.advance(300)
        assert "reopening" in gas.imbibitionEvents()["kind"]
        return reports(gas), gas.imbibitionEvents(), attributesOf(gas)

    whole, continued = run(False), run(True)
    assert same(continued, whole)


@pytest.mark.parametrize(
    "name, value",
    [("maxPressure", 300e3), ("checkInvariants", False), ("openingThreshold", 0.02), ("poreMode", "domain")],
)
def test_assignmentAfterSavingDoesNotRewind(loadSample, tmp_path, name, value):
    # YADE calls the same hook after loading and after an assignment; what was saved long ago must not come back.
    loadSample(1e-6)
    gas = injection.startInjection(**STARTED)
    O.run(300, True)
    O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
    O.run(1200, True)
    before = reports(gas)
    assert len(before["events"]["throat"]) > 3
    setattr(gas, name, value)
    assert same(reports(gas), before)
    O.run(100, True)
    assert gas.volumes()["error"] < 1e-10


def test_pressuresThatWereSetAreKept(handScene, looseDisks, tmp_path):
    handScene(*looseDisks())
    O.engines = [PoreNetworkEngine(label="network", thickness=0.5)]
    network = O.engines[0]
    network.setCellPressures(list(np.random.default_rng(2).uniform(0, 1e3, len(network.cells()["void"]))))
    before = network.fluidForces()
    reload(tmp_path)
    assert O.engines[0].fluidForces() == before


ENGINES = [
    (
        PoreNetworkEngine,
        dict(
            poreMode="triangle",
            mergeTolerance=2e-3,
            mergeHysteresis=0.25,
            remeshDisplacement=2e-3,
            maxSizeRatio=7,
            thickness=0.3,
            waterPressure=12.5,
        ),
    ),
    (
        GasInvasionEngine,
        dict(
            interfacialTension=0.07,
            contactAngle=0.3,
            gasPressure=11,
            pressureIncrement=2,
            maxPressure=33,
            unbalancedTolerance=2e-3,
            minLevelSteps=7,
            maxLevelSteps=70,
            inletWall="left",
            inletFrom=0.1,
            inletTo=0.2,
            inletPoints=[(0.5, 0.25), (1, 2)],
            outletWall="right",
            trapping=True,
            openingThreshold=0.03,
            checkInvariants=True,
            restDisplacement=0.02,
        ),
    ),
    (
        GasInvasionEngine,
        dict(
            gasLaw=IdealGas(molarMass=0.02, temperature=280, deviation=0.8),
            pressureDatum=2e5,
            supply=RateSupply(rate=3e-6, reservoirVolume=1e-9),
            historyInterval=5,
        ),
    ),
    (
        ViscousInvasionEngine,
        dict(
            gasLaw=TabulatedGas(table=[(1, 0.1), (2e5, 1.4)]),
            supply=PressureSupply(program=[3, 1 / 3], reservoirVolume=1e-9),
        ),
    ),
    (GasInvasionEngine, dict(gasLaw=IdealGas(), supply=ReservoirSupply(volume=0.1))),
    (GasInvasionEngine, dict(entryLaw="mayerStowePrincen")),
    (
        GasInvasionEngine,
        dict(
            imbibition=True,
            snapOff=True,
            trapping=True,
            filmConductance=1e-12,
            fluidDensity=1024,
            gasDensity=80,
            gravity=(1, -9.5),
        ),
    ),
    (WallServoEngine, dict(stressX=5, stressY=6, fixedWalls=["left", "top"], gain=0.5, maxVelocity=0.2, thickness=0.3)),
]


@pytest.mark.parametrize("cls, values", ENGINES)
def test_enginesKeepTheirAttributes(cls, values, tmp_path):
    O.engines = [cls(label="it", **values)]
    before = attributesOf(O.engines[0])
    assert all(before[name] == values[name] or name == "inletPoints" for name in values)
    reload(tmp_path)
    assert type(O.engines[0]) is cls and same(attributesOf(O.engines[0]), before)
    assert set(values) <= set(before)


@pytest.mark.parametrize(
    "cls, values",
    [
        (
            DiskMat,
            dict(
                normalStiffness=2e7,
                shearStiffness=3e6,
                tensileStrength=4.0,
                shearStrength=5.0,
                capillaryStrength=0.6,
                density=2600.0,
                frictionAngle=0.4,
            ),
        ),
        (WallMat, dict(normalStiffness=2e7, shearStiffness=3e6, bondFactor=7.0, frictionAngle=0.4)),
    ],
)
def test_materialsKeepTheirAttributes(cls, values, tmp_path):
    O.materials.append(cls(label="it", **values))
    reload(tmp_path)
    assert type(O.materials["it"]) is cls
    assert {name: getattr(O.materials["it"], name) for name in values} == values


def test_functorsAndBondsAreKept(loadSample, tmp_path):
    loadSample()
    sediment.engine("bonds").thickness = 0.5

    def contacts():
        return sorted(
            (
                i.id1,
                i.id2,
                i.phys.kn,
                i.phys.ks,
                i.phys.normalAdhesion,
                i.phys.shearAdhesion,
                i.phys.cohesionBroken,
                tuple(i.phys.normalForce),
                tuple(i.phys.shearForce),
            )
            for i in O.interactions
            if i.isReal
        )

    before = contacts()
    assert 20 < sum(not c[6] for c in before) < len(before)  # some were under more shear than a bond holds
    reload(tmp_path)
    assert contacts() == before
    loop = next(e for e in O.engines if isinstance(e, InteractionLoop))
    assert {type(f) for f in loop.physDispatcher.functors} == {
        Ip2_DiskMat_DiskMat_CohFrictPhys,
        Ip2_WallMat_DiskMat_CohFrictPhys,
    }
    assert Ig2_Wall_Sphere_ScGeom6D in {type(f) for f in loop.geomDispatcher.functors}
    assert {type(f) for f in loop.lawDispatcher.functors} == {Law2_ScGeom6D_CohFrictPhys_CohesionMoment}
    assert sediment.engine("bonds").thickness == 0.5
