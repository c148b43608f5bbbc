# SPDX-License-Identifier: GPL-2.0-or-later
"""ViscousInvasionEngine: amounts, agreement with drained water in the slow limit, supplies,
restart, errors.
"""

import math

import numpy as np
import pytest
from yade import O
from yade.wrapper import ViscousInvasionEngine

import restart
from capfrac import injection, sediment

STARTED = dict(start=140, increment=1, max=215, pores=3, minLevelSteps=50, waterFlow="solved", gasLaw="ideal")


def ledgers(gas):
    """The larger of the relative errors of the books: by volume at pressure zero, and by mass of the gas."""
    return max(gas.volumes()["error"], gas.gasLedger()["error"])


def test_amountsAreKeptWhileGasEnters(loadSample):
    loadSample(1e-3)
    gas = injection.startInjection(**STARTED)
    atFirst = gas.gasSaturation
    for _ in range(20):
        O.run(200, True)
        # Each step rounds the amounts of about 100 pores once or twice: 4000 steps of 1e-16, that add up like a walk.
        assert ledgers(gas) < 1e-12
    assert gas.nEvents > 0 and gas.gasSaturation > atFirst
    events = gas.events()
    # Gas came in where it exceeded the entry pressure: where the water was not under tension, its own pressure did.
    assert np.median(np.array(events["gasPressure"]) - np.array(events["entryPressure"])) > 0


@pytest.mark.parametrize(
    "attributes",
    [
        dict(fluidDensity=1000, gasDensity=80, gravity=(0, -9.81)),
        dict(grainBulkModulus=1e8),
        dict(gasControl="rate", gasRate=2e-7, increment=0, grainBulkModulus=1e7, wallFluxes=[0, 0, 0, 1e-30]),
    ],
)
def test_amountsAreKeptWithWeightAndInSoftGrains(loadSample, attributes):
    """In the last case the box is closed: an outlet with a prescribed flux has no pressure."""
    loadSample(1e-3)
    gas = injection.startInjection(**{**STARTED, "start": 160, **attributes})
    O.run(1500, True)
    assert ledgers(gas) < 1e-12 and abs(gas.massDefect) < 1e-12 * gas.initialVoid  # as above
    if "gasRate" in attributes:
        assert gas.volumes()["water"] == pytest.approx(gas.volumes()["initialWater"], rel=1e-12)  # nothing left
    else:
        assert gas.nEvents > 0


def test_grainsFollowThePressureRoundThem(loadSample):
    """Gas and water of one pressure compress all grains alike, by Eq. 10, and back."""

    def radii():
        return np.array([body.shape.radius for body in sediment.grainBodies()])

    loadSample(1e-3)
    before, K = radii(), 1e9
    gas = injection.startInjection(**{**STARTED, "start": 0, "max": 0, "increment": 0}, grainBulkModulus=K)
    for pressure in (1e4, 0.0):
        gas.gasPressure = pressure
        gas.wallPressures = [math.nan, math.nan, math.nan, pressure]
        O.run(3000, True)
        pressures, around = np.array(gas.pores()["pressure"]), 3 * K * (1 - radii() / before)
        assert np.ptp(pressures) < 1e-3 * 1e4  # what is left of the motion
        # The mean round a grain lies between those of its pores. Pressures are reported as means over a step, in which
        # they move by 1e-3 of that at most; and radii round to 1e-16 of 3 K.
        assert np.all((around > pressures.min() - 1e-2) & (around < pressures.max() + 1e-2))
    assert gas.volumes()["error"] < 1e-12


def test_slowGasBreaksThroughAsInDrainedWater(loadSample):
    """At every level both reach rest, so the first level that reaches the outlet is the same, to the increment: water
    that is still
    on its way when the level ends keeps the gas back, and pressures on the way move the grains a little."""
    found = {}
    for water in ("drained", "solved"):
        loadSample(1e-3)
        thin = {"viscosity": 1e-4} if water == "solved" else {}
        gas = injection.startInjection(**{**STARTED, "start": 145, "waterFlow": water, **thin})
        for _ in range(100):
            O.run(500, True)
            if gas.breakthroughIter >= 0 or gas.rampDone:
                break
        found[water] = gas.breakthroughPressure
    assert math.isfinite(found["drained"])
    assert found["solved"] == pytest.approx(found["drained"], abs=1.001)


@pytest.mark.parametrize("control", ["rate", "reservoir"])
def test_suppliesAreKeptByMass(loadSample, control):
    loadSample(1e-3)
    supply = dict(gasRate=2e-7) if control == "rate" else {}
    gas = injection.startInjection(
        **{**STARTED, "increment": 0, "start": 170}, gasControl=control, reservoirVolume=1e-5, **supply
    )
    before = gas.gasLedger()["injected"]
    O.run(2000, True)
    ledger = gas.gasLedger()
    assert ledger["injected"] - before == pytest.approx(
        supply.get("gasRate", 0.0) * 2000 * O.dt, rel=1e-9, abs=1e-12 * before
    )
    assert ledger["error"] < 1e-12 and gas.nEvents > 0
    if control == "reservoir":
        assert gas.gasPressure < 170  # what left it filled pores


def test_continuedRunIsTheUninterruptedOne(loadSample, tmp_path):
    def run(interrupt):
        loadSample(1e-3)
        injection.startInjection(**{**STARTED, "start": 150})
        sediment.advance(600)
        restart.cut(tmp_path, interrupt)
        sediment.advance(600)
        gas = sediment.engine("gas")
        return gas.pores()["pressure"], gas.cells()["gas"], gas.events()["time"], gas.gasLedger()["injected"]

    whole, continued = run(False), run(True)
    assert continued == whole  # to the last bit


@pytest.mark.parametrize("viscosity, rests", [(1e-4, True), (1e3, False)])
def test_levelsWaitForTheWater(loadSample, viscosity, rests):
    """Grains that come to rest squeeze the water: thin water leaves within a level, thick water keeps its pressure.

    Its pressure is that of the squeezing, some 10 Pa here, or where it leaves as fast as it is squeezed in
    proportion to the viscosity (at 1e-3 Pa s 0.02 Pa): the level ends at 1 Pa, far from both.
    """
    loadSample(1e-3)
    gas = injection.startInjection(**{**STARTED, "start": 100, "viscosity": viscosity, "maxLevelSteps": 500})
    while not gas.levels()["pressure"]:
        O.step()
    assert gas.levels()["atRest"] == [rests]
    assert (gas.waterExcess <= 1) == rests  # the increment, and a hundredth of 100 Pa


def test_pressuresOnTheWayLoadTheGrains(loadSample):
    """Forces are those of the reported pressures on grains and walls, and sum to zero."""
    loadSample(1e-3)
    gas = injection.startInjection(**{**STARTED, "start": 160})
    O.run(300, True)
    forces = np.array(list(gas.fluidForces().values()))
    pressures = np.array(gas.cells()["pressure"])
    assert pressures.max() - pressures.min() > 100  # gas here, water there
    assert np.abs(forces.sum(axis=0)).max() < 1e-9 * np.abs(forces).sum()


@pytest.mark.parametrize(
    "attributes, message",
    [
        (dict(gasLaw="incompressible"), "gasLaw = 'incompressible', allowed: 'ideal', 'tabulated'.* in Viscous"),
        (dict(bulkModulus=math.inf), r"bulkModulus \[Pa\] = inf, allowed: finite in ViscousInvasionEngine"),
        (dict(timeIntegration="explicit"), "ViscousInvasionEngine has no attribute 'timeIntegration'"),
        (dict(imbibition=True), "ViscousInvasionEngine has no attribute 'imbibition'"),
        (dict(waterFlow="frozen"), "waterFlow = 'frozen', allowed: 'drained', 'solved'"),
        (dict(waterFlow="drained", viscosity=1.0), "GasInvasionEngine has no attribute 'viscosity'"),
    ],
)
def test_whatDoesNotGoTogetherIsRefused(loadSample, attributes, message):
    loadSample(1e-3)
    engines = len(O.engines)
    with pytest.raises(Exception, match=message):
        injection.startInjection(**{**STARTED, **attributes})
    assert len(O.engines) == engines


@pytest.mark.parametrize(
    "name, value, message",
    [
        ("gasViscosity", 0.0, r"gasViscosity \[Pa·s\] = 0, allowed"),
        ("maxFilling", -1.0, r"maxFilling \[-\] = -1, allowed"),
    ],
)
def test_badValuesAreRefusedAtAssignment(name, value, message):
    gas = ViscousInvasionEngine()
    before = getattr(gas, name)
    with pytest.raises(ValueError, match=message):
        setattr(gas, name, value)
    assert getattr(gas, name) == before
