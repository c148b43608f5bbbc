"""Saving and loading: nothing is lost, and a run that is taken up again goes on as if it had not been interrupted.

Everything is compared to the last bit, the run after loading, too: YADE keeps the order of contacts in the file, so forces
are summed in the same order (with one thread). A tolerance would hide what a fracturing sample amplifies anyway.
"""

import math

import numpy as np
import pytest
from yade import O, config
from yade.wrapper import (DiskMat, GasInvasionEngine, Ig2_Wall_Sphere_ScGeom6D, InteractionLoop, Ip2_DiskMat_DiskMat_CohFrictPhys,
                          Ip2_WallMat_DiskMat_CohFrictPhys, Law2_ScGeom6D_CohFrictPhys_CohesionMoment, PoreNetworkEngine, WallMat, WallServoEngine)

from capfrac import injection, sediment

STARTED = dict(start=130e3, increment=5e3, max=200e3, pores=3, minLevelSteps=20, maxLevelSteps=200, checkInvariants=True)


def same(a, b):
    """Equality to the bit of nested lists and dicts; NaN equals NaN."""
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(same, a, b))
    return a == b or (isinstance(a, float) and math.isnan(a) and math.isnan(b))


def attributesOf(thing):
    """All attributes but those that only carry the network into the file."""
    return {name: value for name, value in thing.dict().items() if not name.startswith("saved")}


def reports(gas):
    return {"cells": gas.cells(), "throats": gas.throats(), "volumes": gas.volumes(), "events": gas.events(), "levels": gas.levels(),
            "forces": gas.fluidForces(), "broken": gas.brokenBonds(), "next": gas.nextEntryPressure(), "ledger": gas.gasLedger(), "history": gas.history()}


def reload(tmp_path):
    O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
    O.reset()
    O.load(str(tmp_path / "scene.yade.gz"), quiet=True)


#: The same sample under a rate, torn within the 2000 steps, too.
SUPPLIED = dict(gasLaw="ideal", gasControl="rate", gasRate=3e-5, reservoirVolume=3e-10, invasionInterval=20, historyInterval=10)


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


#: Debian's YADE is built with high-precision types; the one that scripts/bootstrap builds is not.
PACKAGED = "COMPLEX_MP" in config.features


def stepsWith(steps):
    """Runs so many steps; after each: the contacts in the order in which YADE sums their forces, the grains, the gas engine's numbers."""
    rows = []
    for _ in range(steps):
        O.step()
        gas = sediment.engine("gas")
        contacts = [(i.id1, i.id2) for i in O.interactions if i.isReal]
        rows.append((contacts, [(tuple(b.state.pos), tuple(b.state.vel)) for b in O.bodies],
                     (gas.gasPressure, gas.gasSaturation, gas.nEvents, gas.nRemeshes, gas.level, gas.rampDone, gas.reservoirMass)))
    return rows


@pytest.mark.parametrize("supply, cut", [({}, 300), ({}, 1100), (SUPPLIED, 300), (SUPPLIED, 600)],
                         ids=["ramp-300", "ramp-1100", "rate-300", "rate-600"])
def test_continuedRunIsTheUninterruptedOne(loadSample, tmp_path, cut, supply):
    # YADE's collider starts anew with a loaded scene. The next contacts that it finds stand in another order in its
    # list, in which forces are summed, and a sample that fractures amplifies the last digit: so the runs are compared
    # for as long as that order is the same.
    def run(interrupt):
        loadSample(1e-6)
        injection.startInjection(**STARTED, **supply)
        sediment.advance(cut)
        if interrupt:
            before = reports(sediment.engine("gas"))
            reload(tmp_path)
            assert same(reports(sediment.engine("gas")), before)
        return stepsWith(300)

    whole, continued = run(False), run(True)
    shared = next((k for k, (a, b) in enumerate(zip(whole, continued)) if a[0] != b[0]), len(whole))
    assert shared >= 5
    for k, (a, b) in enumerate(zip(whole[:shared], continued)):
        if PACKAGED:  # Debian's YADE (other optimisation, assertions) differs in the last digits after loading
            assert np.array(a[1]) == pytest.approx(np.array(b[1]), rel=1e-9, abs=1e-15) and a[2] == pytest.approx(b[2], rel=1e-9), k
        else:
            assert a == b, k


def test_continuedImbibitionIsTheUninterruptedOne(loadSample, tmp_path):
    """Trapped gas, its pressure and the throats that are snapped off survive: the rest of the cycle has the same bits."""

    def run(interrupt):
        loadSample(1e-3)
        injection.startInjection(start=250, increment=0, max=251, pores=2, imbibition=True, snapOff=True, fluidDensity=1000, gravity=(0, -1.0), checkInvariants=True)
        O.run(300, True)
        sediment.engine("gas").gasPressure = 60
        O.run(300, True)
        gas = sediment.engine("gas")
        assert gas.nReturns > 5 and any(gas.cells()["cutOff"]) and "snapOff" in gas.imbibitionEvents()["kind"]
        if interrupt:
            before = reports(gas), gas.imbibitionEvents()
            reload(tmp_path)
            gas = sediment.engine("gas")
            assert same((reports(gas), gas.imbibitionEvents()), before)
        for pressure in (30, 250):
            gas.gasPressure = pressure
            O.run(300, True)
        assert "reopening" in gas.imbibitionEvents()["kind"]
        return reports(gas), gas.imbibitionEvents(), attributesOf(gas)

    whole, continued = run(False), run(True)
    if not PACKAGED:
        assert same(continued, whole)


@pytest.mark.parametrize("name, value", [("maxPressure", 300e3), ("checkInvariants", False), ("openingThreshold", 0.02), ("poreMode", "domain")])
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
    (PoreNetworkEngine, dict(poreMode="triangle", mergeTolerance=2e-3, mergeHysteresis=0.25, remeshDisplacement=2e-3, maxSizeRatio=7, thickness=0.3,
                             waterPressure=12.5)),
    (GasInvasionEngine, dict(interfacialTension=0.07, contactAngle=0.3, gasPressure=11, pressureIncrement=2, maxPressure=33, unbalancedTolerance=2e-3,
                             minLevelSteps=7, maxLevelSteps=70, inletWall="left", inletFrom=0.1, inletTo=0.2, inletPoints=[(0.5, 0.25), (1, 2)],
                             outletWall="right", trapping=True, openingThreshold=0.03, checkInvariants=True, restDisplacement=0.02)),
    (GasInvasionEngine, dict(gasLaw="ideal", gasMolarMass=0.02, gasTemperature=280, gasDeviation=0.8, pressureDatum=2e5, gasControl="rate", gasRate=3e-6,
                             reservoirVolume=1e-9, historyInterval=5, pressureProgram=[3, 1])),
    (GasInvasionEngine, dict(entryLaw="mayerStowePrincen")),
    (GasInvasionEngine, dict(imbibition=True, snapOff=True, trapping=True, filmConductance=1e-12, fluidDensity=1024, gasDensity=80, gravity=(1, -9.5))),
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


@pytest.mark.parametrize("cls, values", [
    (DiskMat, dict(normalStiffness=2e7, shearStiffness=3e6, tensileStrength=4.0, shearStrength=5.0, capillaryStrength=0.6, density=2600.0, frictionAngle=0.4)),
    (WallMat, dict(normalStiffness=2e7, shearStiffness=3e6, bondFactor=7.0, frictionAngle=0.4))])
def test_materialsKeepTheirAttributes(cls, values, tmp_path):
    O.materials.append(cls(label="it", **values))
    reload(tmp_path)
    assert type(O.materials["it"]) is cls
    assert {name: getattr(O.materials["it"], name) for name in values} == values


def test_functorsAndBondsAreKept(loadSample, tmp_path):
    loadSample()
    sediment.engine("bonds").thickness = 0.5

    def contacts():
        return sorted((i.id1, i.id2, i.phys.kn, i.phys.ks, i.phys.normalAdhesion, i.phys.shearAdhesion, i.phys.cohesionBroken,
                       tuple(i.phys.normalForce), tuple(i.phys.shearForce)) for i in O.interactions if i.isReal)

    before = contacts()
    assert 20 < sum(not c[6] for c in before) < len(before)  # some were under more shear than a bond holds
    reload(tmp_path)
    assert contacts() == before
    loop = next(e for e in O.engines if isinstance(e, InteractionLoop))
    assert {type(f) for f in loop.physDispatcher.functors} == {Ip2_DiskMat_DiskMat_CohFrictPhys, Ip2_WallMat_DiskMat_CohFrictPhys}
    assert Ig2_Wall_Sphere_ScGeom6D in {type(f) for f in loop.geomDispatcher.functors}
    assert {type(f) for f in loop.lawDispatcher.functors} == {Law2_ScGeom6D_CohFrictPhys_CohesionMoment}
    assert sediment.engine("bonds").thickness == 0.5
