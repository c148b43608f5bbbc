# SPDX-License-Identifier: GPL-2.0-or-later
"""The supply of gas of GasInvasionEngine: equations of state, prescribed pressures, rates and reservoirs, and the mass
of the gas.
"""

import math

import numpy as np
import pytest
from yade import O
from yade.wrapper import (
    GasInvasionEngine,
    GasLaw,
    GasSupply,
    IdealGas,
    IncompressibleGas,
    PressureSupply,
    RateSupply,
    ReservoirSupply,
    TabulatedGas,
)

from capfrac import injection
from capfrac.errors import CaseError

#: Entry pressures of the settled sample of 1-2 mm are 121-241 Pa. With this absolute pressure of the water its pores
#: are filled under changes of pressure that show, from a reservoir of some ten of them.
DATUM, RESERVOIR = 1000.0, 1e-4
IDEAL = dict(gasLaw="ideal", gasMolarMass=0.02, gasTemperature=300.0, gasDeviation=0.9, pressureDatum=DATUM)
DENSITY_PER_PRESSURE = 0.02 / (0.9 * 8.31446261815324 * 300.0)
#: Volumes and masses are sums over some hundred cells, each to a few eps of the largest.
ROUND_OFF = 1e-12


def massIn(gas):
    ledger = gas.gasLedger()
    assert ledger["sample"] + ledger["reservoir"] == pytest.approx(ledger["injected"], rel=ROUND_OFF)
    return ledger["injected"]


def idealPressure(mass, volume):
    return mass / volume / DENSITY_PER_PRESSURE - DATUM


# --- the pressure is prescribed -------------------------------------------------------------------


TABLE = [(1e4, 0.1), (2e5, 1.4), (1e6, 9.0)]


@pytest.mark.parametrize("attributes", [dict(), dict(poreMode="triangle", trapping=True, invasionInterval=20)])
def test_underPrescribedPressureTheLawDoesNotMatter(loadSample, attributes):
    def run(**law):
        loadSample(1e-6)
        gas = injection.startInjection(
            130e3, 5e3, 250e3, pores=3, checkInvariants=True, minLevelSteps=20, maxLevelSteps=300, **attributes, **law
        )
        O.run(2000, True)
        cells = gas.cells()
        return (
            {
                "events": gas.events(),
                "levels": gas.levels(),
                "phase": cells["phase"],
                "pressure": cells["pressure"],
                "places": [tuple(b.state.pos) for b in O.bodies],
            },
            gas.gasLedger(),
            gas,
        )

    plain, ledger, gas = run()
    assert gas.nEvents and gas.nRemeshes and gas.brokenBonds()  # else it was not torn, and nothing is shown
    for law in (
        dict(gasLaw="ideal"),
        dict(gasLaw="ideal", reservoirVolume=1e-9),
        dict(gasLaw="tabulated", gasTable=TABLE),
    ):
        other, counted, gas = run(**law)
        assert counted["error"] < 1e-10 and counted["supplied"] > 0
        for name in plain:
            assert other[name] == plain[name], (law, name)


def test_programGoesUpAndDown(rigid):
    gas = rigid("settled", gasPressure=100, pressureIncrement=30, pressureProgram=[190, 130, 130, 160])
    O.run(600, True)
    # Levels: each turning point is met exactly; a point that is there already is none of its own.
    assert gas.levels()["pressure"] == [100, 130, 160, 190, 160, 130, 160] and gas.rampDone and gas.programPosition == 4
    saturations = gas.levels()["gasSaturation"]
    # no imbibition: what is filled stays filled
    assert saturations == sorted(saturations) and saturations[3] == saturations[-1]
    gas.supply.program = [220]
    assert not gas.rampDone and gas.programPosition == 0
    O.run(200, True)
    assert gas.levels()["pressure"][7:] == [160, 190, 220] and gas.rampDone


def test_stepsAreProgramsWithALargeIncrement(rigid):
    gas = rigid("settled", gasPressure=100, pressureIncrement=1e6, pressureProgram=[150, 110, 200])
    O.run(300, True)
    assert gas.levels()["pressure"] == [100, 150, 110, 200] and gas.rampDone


def test_massUnderPressureIsDensityTimesVolume(rigid):
    gas = rigid(
        "settled", gasPressure=100, pressureIncrement=30, pressureProgram=[190, 130], reservoirVolume=RESERVOIR, **IDEAL
    )
    while not gas.rampDone:
        pressure = gas.gasPressure  # that of the coming step; at its end it may change for the next
        O.step()
        assert massIn(gas) == pytest.approx(
            DENSITY_PER_PRESSURE * (pressure + DATUM) * (RESERVOIR + gas.volumes()["gas"]), rel=ROUND_OFF
        )
    # some went back
    assert pressure == 130 and massIn(gas) < DENSITY_PER_PRESSURE * (190 + DATUM) * (RESERVOIR + gas.volumes()["gas"])


def test_massOfAnIncompressibleGasIsThatOfTheIdealOneAtTheDatum(rigid):
    law = IncompressibleGas(molarMass=0.02, temperature=300.0, deviation=0.9)
    gas = rigid("settled", gasPressure=200, gasLaw=law, pressureDatum=DATUM)
    O.run(3, True)
    assert massIn(gas) == pytest.approx(DENSITY_PER_PRESSURE * DATUM * gas.gasIn, rel=ROUND_OFF)


# --- the pressure follows -------------------------------------------------------------------------


def test_reservoirExpandsIntoThePores(rigid):
    gas = rigid("settled", gasPressure=230, gasControl="reservoir", reservoirVolume=RESERVOIR, **IDEAL)
    inlet = gas.volumes()["gas"]
    constant = (230 + DATUM) * (RESERVOIR + inlet)  # p V of an ideal gas
    while not gas.rampDone:
        O.run(1, True)
        assert (gas.gasPressure + DATUM) * (RESERVOIR + gas.volumes()["gas"]) == pytest.approx(constant, rel=ROUND_OFF)
    assert gas.nEvents > 3 and 0 < gas.gasPressure < 200
    assert gas.nextEntryPressure() > gas.gasPressure
    assert gas.gasLedger()["supplied"] == 0
    # Every pore was entered at the pressure that those before had left.
    events, volume = gas.events(), RESERVOIR + inlet
    for pressure, entry, pore in zip(events["gasPressure"], events["entryPressure"], events["volume"]):
        assert pressure + DATUM == pytest.approx(constant / volume, rel=ROUND_OFF) and pressure >= entry
        volume += pore


def fullOfGas(rigid, **attributes):
    """All pores of the settled sample filled under a pressure, then shut in."""
    gas = rigid("settled", gasPressure=1000, **{**IDEAL, **attributes})
    O.run(5, True)
    assert all(gas.cells()["phase"])
    gas.supply = RateSupply(reservoirVolume=gas.supply.reservoirVolume)
    return gas


@pytest.mark.parametrize("reservoir", [0.0, RESERVOIR])
def test_pistonCompressesTheGas(rigid, reservoir):
    gas = fullOfGas(rigid, reservoirVolume=reservoir)
    O.step()
    # the same gas: nothing jumps where the control changes
    assert gas.gasPressure == pytest.approx(1000, rel=ROUND_OFF)
    constant = (1000 + DATUM) * (reservoir + gas.volumes()["void"])
    mass = massIn(gas)
    top = O.bodies[3]
    for _ in range(10):
        top.state.pos += (0, -1e-5, 0)
        O.step()
        assert (gas.gasPressure + DATUM) * (reservoir + gas.volumes()["void"]) == pytest.approx(constant, rel=ROUND_OFF)
        assert massIn(gas) == pytest.approx(mass, rel=ROUND_OFF)
    assert gas.gasPressure > 1000.5


def test_gasDoesNotGetThinnerThanTheWater(rigid):
    gas = fullOfGas(rigid)
    O.step()
    top, mass = O.bodies[3], massIn(gas)
    before = gas.volumes()["gas"]
    top.state.pos += (0, 0.04, 0)  # room for several times the gas
    O.step()
    volumes = gas.volumes()
    assert gas.gasPressure == 0 == gas.waterPressure
    # p V = const down to the water's pressure
    assert volumes["gas"] == pytest.approx(mass / (DENSITY_PER_PRESSURE * DATUM), rel=ROUND_OFF)
    # the rest is water that came in
    assert before < volumes["gas"] < 0.9 * volumes["void"] and volumes["error"] < 1e-12
    top.state.pos -= (0, 0.04, 0)
    O.step()
    assert gas.gasPressure == pytest.approx(1000, rel=1e-11) and massIn(gas) == pytest.approx(mass, rel=ROUND_OFF)


def test_tableFollowsToo(rigid):
    table = [(900.0, 2.0), (1100.0, 3.0), (1400.0, 3.5)]
    gas = rigid(
        "settled",
        gasPressure=100,
        gasControl="rate",
        gasRate=0.02,
        reservoirVolume=RESERVOIR,
        gasLaw="tabulated",
        gasTable=table,
        pressureDatum=DATUM,
    )
    O.dt = 1e-5
    for _ in range(100):
        O.step()
        density = massIn(gas) / (RESERVOIR + gas.volumes()["gas"])
        assert gas.gasPressure + DATUM == pytest.approx(
            np.interp(density, *zip(*[(rho, p) for p, rho in table])), rel=ROUND_OFF
        )
    assert gas.nEvents > 0


def test_endOfTheTableIsNamed(rigid):
    rigid(
        "settled",
        gasPressure=10,
        gasControl="rate",
        gasRate=0.02,
        gasLaw="tabulated",
        gasTable=[(900.0, 2.0), (1100.0, 3.0)],
        pressureDatum=DATUM,
        reservoirVolume=RESERVOIR,
    )
    O.dt = 1e-5
    with pytest.raises(
        RuntimeError,
        match=(
            r"at time t = .* s, iteration \d+: gasLaw = TabulatedGas: density of the gas .* allowed: up to the last of"
            r" the table, 3"
        ),
    ):
        for _ in range(5000):
            O.step()
    with pytest.raises(RuntimeError, match="absolute pressure of the gas .* = 1150"):
        rigid(
            "settled", gasPressure=150, gasLaw="tabulated", gasTable=[(900.0, 2.0), (1100.0, 3.0)], pressureDatum=DATUM
        ).prepare()


# --- gas that is cut off ----------------------------------------------------------------------------


def clustersOf(gas):
    """Sets of cells of gas that share edges, each with whether a cell of the inlet is in it."""
    cells, throats = gas.cells(), gas.throats()
    group = {c: {c} for c, phase in enumerate(cells["phase"]) if phase}
    for left, right in throats["cells"]:
        if left in group and right in group and group[left] is not group[right]:
            group[left] |= group[right]
            for c in group[right]:
                group[c] = group[left]
    sets = {min(members): members for members in group.values()}
    return cells, [(members, any(cells["inlet"][c] for c in members)) for _, members in sorted(sets.items())]


def stirUntilCutOff(rigid, seed, **attributes):
    """Loose grains, a third filled with gas, moved at random until a cluster without inlet is there; None where none
    comes.
    """
    gas = rigid("loose", poreMode="triangle", remeshDisplacement=1e-6, invasionInterval=1, **{**IDEAL, **attributes})
    gas.gasPressure = 1e6
    O.run(16, True)  # a pore a step
    random = np.random.default_rng(seed)
    gas.gasPressure = 1  # no pore is entered any more
    start = [b.state.pos for b in O.bodies]
    for _ in range(60):
        for body, place in zip(list(O.bodies)[4:], start[4:]):
            body.state.pos = place + 0.5e-3 * np.append(random.uniform(-1, 1, 2), 0)
        O.step()
        assert gas.gasLedger()["error"] < 1e-10 and gas.volumes()["error"] < 1e-10
        cells, clusters = clustersOf(gas)
        if any(not inlet and sum(cells["gas"][c] for c in members) > 0 for members, inlet in clusters):
            return gas
    return None


def test_gasThatIsCutOffKeepsItsMass(rigid):
    found = 0
    for seed in range(4):
        gas = stirUntilCutOff(rigid, seed)
        if gas is None:
            continue
        found += 1
        before, mass = clustersOf(gas), massIn(gas)
        product = {
            frozenset(m): sum(before[0]["gas"][c] for c in m) * (before[0]["pressure"][min(m)] + DATUM)
            for m, inlet in before[1]
            if not inlet
        }
        gas.remeshDisplacement = 1.0  # the same cells, squeezed
        gas.supply = RateSupply()
        for body in O.bodies:
            body.state.pos = (0.999 * body.state.pos[0], body.state.pos[1], 0)
        O.step()
        cells, clusters = clustersOf(gas)
        for members, inlet in clusters:
            pressures = {cells["pressure"][c] for c in members}
            assert len(pressures) == 1  # one cluster, one pressure
            volume, pressure = sum(cells["gas"][c] for c in members), pressures.pop()
            if not inlet and pressure > 0:
                assert (pressure + DATUM) * volume == pytest.approx(product[frozenset(members)], rel=1e-11)
        assert massIn(gas) == pytest.approx(mass, rel=ROUND_OFF)
        # Met again: one pressure for all, and the mass of all.
        gas.supply, gas.gasPressure = PressureSupply(), 1e6
        gas.invasionInterval = 0
        O.run(2, True)
        assert all(gas.cells()["phase"]) and gas.gasLedger()["cutOff"] == 0
        gas.supply = RateSupply()
        O.step()
        assert gas.gasPressure == pytest.approx(1e6, rel=1e-11)
    assert found > 1


# --- moving grains ---------------------------------------------------------------------------------


def supplied(loadSample, **attributes):
    """The 60 fine grains under a rate that tears them open within 3000 steps."""
    loadSample(1e-6)
    values = dict(
        gasControl="rate",
        gasRate=3e-5,
        reservoirVolume=3e-10,
        gasLaw="ideal",
        invasionInterval=20,
        minLevelSteps=20,
        maxLevelSteps=300,
        checkInvariants=True,
        historyInterval=10,
    )
    return injection.startInjection(120e3, 2e3, 250e3, pores=3, **{**values, **attributes})


def test_massIsKeptWhereASampleIsTornOpen(loadSample):
    gas = supplied(loadSample)
    start = O.time
    for _ in range(60):
        O.run(50, True)
        ledger = gas.gasLedger()
        assert ledger["error"] < 1e-10 and gas.volumes()["error"] < 1e-10
        assert ledger["supplied"] == pytest.approx(3e-5 * (O.time - start), rel=1e-10)
        assert ledger["injected"] == pytest.approx(ledger["initial"] + ledger["supplied"], rel=ROUND_OFF)
    history = gas.history()
    assert gas.nRemeshes and gas.nEvents and gas.brokenBonds()
    # In a rigid, sealed box the pressure would only rise; here it falls where pores fill and the sample opens.
    assert np.diff(history["gasPressure"]).min() < 0 < np.diff(history["gasPressure"]).max()
    for column in ("time", "iteration", "mass"):
        assert np.all(np.diff(history[column]) > 0), column
    # The law holds row by row; the row is written after the step, the volume in it is that of the step.
    density = 0.016043 / (8.31446261815324 * 293.15) * (np.array(history["gasPressure"]) + 101325)
    masses = density * (np.array(history["connectedVolume"]) + 3e-10)
    assert np.all(masses <= np.array(history["mass"]) * (1 + 1e-10))
    if gas.gasLedger()["cutOff"] == 0:
        np.testing.assert_allclose(masses, history["mass"], rtol=1e-10)


def test_historyThinsItself(rigid):
    gas = rigid("settled", gasPressure=50, historyInterval=1)
    O.run(9000, True)
    rows = gas.history()["iteration"]
    assert 4000 < len(rows) < 8192 and set(np.diff(rows)) == {2} and rows[-1] >= 8997


def test_levelsOfARateAreAnIncrementApart(rigid):
    gas = rigid(
        "settled",
        gasPressure=100,
        pressureIncrement=5,
        gasControl="rate",
        gasRate=2e-3,
        reservoirVolume=RESERVOIR,
        **IDEAL,
    )
    O.dt = 1e-5
    O.run(3000, True)
    pressures = gas.levels()["pressure"]
    assert len(pressures) > 5 and min(abs(np.diff(pressures))) >= 5 and not gas.rampDone


def test_askingDoesNotChangeARunUnderARate(loadSample):
    def positions(ask):
        gas = supplied(loadSample)
        for _ in range(30):
            O.run(50, True)
            if ask:
                for question in ("volumes", "cells", "throats", "fluidForces", "gasLedger", "history", "risePerPeriod"):
                    getattr(gas, question)()
        return [tuple(b.state.pos) for b in O.bodies], gas.events(), gas.gasPressure

    assert positions(True) == positions(False)


def test_risePerPeriodIsThatOfTheFirstSteps(loadSample):
    gas = supplied(loadSample, gasRate=1e-7)
    rise, pressure = gas.risePerPeriod(), gas.gasPressure
    grains = [b for b in O.bodies if hasattr(b.shape, "radius")]
    stiffness = np.mean([i.phys.kn for i in O.interactions if i.isReal])
    period = 2 * math.pi * math.sqrt(np.mean([b.state.mass for b in grains]) / stiffness)
    volume = 3e-10 + gas.volumes()["gas"]
    assert rise == pytest.approx(1e-7 * period * 8.31446261815324 * 293.15 / 0.016043 / volume, rel=1e-9)
    assert pressure == pytest.approx(120e3, rel=1e-14)
    gas.supply.rate = 2e-7
    assert gas.risePerPeriod() == pytest.approx(2 * rise, rel=1e-12)


# --- what is refused ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "kind, name, good, bad",
    [
        (IdealGas, "molarMass", 0.04, 0.0),
        (IdealGas, "temperature", 280.0, -3.0),
        (IdealGas, "deviation", 0.8, float("nan")),
        (IncompressibleGas, "temperature", 280.0, 0.0),
        (TabulatedGas, "table", [(1.0, 1.0), (2.0, 3.0)], [(1.0, 1.0), (2.0, 0.5)]),
        (TabulatedGas, "table", [(1.0, 1.0), (2.0, 3.0)], [(-1.0, 1.0)]),
        (PressureSupply, "program", [3.0, 1.0], [3.0, float("nan")]),
        (PressureSupply, "reservoirVolume", 1e-9, -1.0),
        (RateSupply, "rate", 1e-6, -1e-9),
        (RateSupply, "reservoirVolume", 1e-9, float("inf")),
        (ReservoirSupply, "volume", 1e-9, -1.0),
        (GasInvasionEngine, "pressureDatum", 2e5, float("inf")),
        (GasInvasionEngine, "historyInterval", 7, -1),
    ],
)
def test_refusedAssignmentsChangeNothing(kind, name, good, bad):
    thing = kind()

    def value():
        found = getattr(thing, name)
        return [tuple(v) if name == "table" else v for v in found] if isinstance(good, list) else found

    first = value()
    named = name if kind is GasInvasionEngine else f"{kind.__name__}.{name}"
    with pytest.raises(ValueError, match=f"{named}.* allowed:"):
        setattr(thing, name, bad)
    assert value() == first
    setattr(thing, name, good)
    with pytest.raises(ValueError, match="allowed:"):
        setattr(thing, name, bad)
    assert value() == good
    setattr(thing, name, good)  # nothing is left of the refused value
    with pytest.raises(ValueError, match=f"{named}.* allowed:"):
        kind(**{name: bad})


@pytest.mark.parametrize("name, bad", [("gasLaw", (None, GasLaw())), ("supply", (None, GasSupply()))])
def test_noLawAndNoSupplyAreRefused(name, bad):
    gas = GasInvasionEngine(gasLaw=IdealGas(deviation=0.7), supply=RateSupply(rate=3.0))
    first = getattr(gas, name)
    for value in bad:
        with pytest.raises(ValueError, match=rf"{name} = .*, allowed: an object such as"):
            setattr(gas, name, value)
        assert getattr(gas, name) is first
        with pytest.raises(ValueError, match=rf"{name} = .*, allowed: an object such as"):
            GasInvasionEngine(**{name: value})
    for value in (3, "ideal", IdealGas() if name == "supply" else RateSupply()):
        with pytest.raises(TypeError):
            setattr(gas, name, value)
    assert (gas.gasLaw.deviation, gas.supply.rate) == (0.7, 3.0)


def test_engineHasObjectsOfItsOwn():
    one, other = GasInvasionEngine(), GasInvasionEngine()
    assert type(one.gasLaw) is IncompressibleGas and type(one.supply) is PressureSupply
    one.supply.program = [3.0]
    assert list(other.supply.program) == [] and list(one.supply.program) == [3.0]


def test_changedObjectsActAtTheNextStep(rigid):
    gas = fullOfGas(rigid, reservoirVolume=RESERVOIR)
    O.dt = 1e-5
    O.step()
    mass, supply = massIn(gas), gas.supply
    supply.rate = 2e-5
    O.run(10, True)
    assert massIn(gas) - mass == pytest.approx(2e-5 * 10 * O.dt, rel=1e-6)
    pressure = gas.gasPressure
    gas.gasLaw.deviation *= 1.1  # the same gas, at the pressure that it has then
    O.step()
    mass = massIn(gas)
    assert gas.gasPressure == pytest.approx(1.1 * (pressure + DATUM) - DATUM, rel=1e-3)
    with pytest.raises(ValueError, match="RateSupply.rate"):
        supply.rate = -1
    O.step()
    assert massIn(gas) - mass == pytest.approx(2e-5 * O.dt, rel=1e-6)
    gas.supply = ReservoirSupply(volume=RESERVOIR)
    supply.rate = 7.0  # an object that was taken off says nothing any more
    O.run(3, True)
    assert gas.rampDone and gas.gasLedger()["error"] < 1e-12
    gas.supply = RateSupply(reservoirVolume=RESERVOIR)
    assert not gas.rampDone


@pytest.mark.parametrize("ending", ["xml", "xml.gz", "yade", "yade.gz"])
@pytest.mark.parametrize(
    "attributes",
    [
        dict(gasLaw=IdealGas(molarMass=0.1, temperature=1 / 3e-3, deviation=2 / 3), supply=RateSupply(rate=1 / 3)),
        dict(gasLaw=TabulatedGas(table=[(0.1, 1 / 7), (1 / 3, 0.7)]), supply=ReservoirSupply(volume=1e-9 / 3)),
        dict(supply=PressureSupply(program=[1 / 3, 0.1], reservoirVolume=1e-9 / 3)),
    ],
)
def test_objectsAreSavedToTheBit(tmp_path, ending, attributes):
    O.reset()
    O.engines = [GasInvasionEngine(**attributes)]
    before = {name: (type(thing), thing.dict()) for name, thing in O.engines[0].dict().items() if name in attributes}
    assert before["supply"][1] == attributes["supply"].dict()
    O.save(str(tmp_path / f"scene.{ending}"), quiet=True)
    O.reset()
    O.load(str(tmp_path / f"scene.{ending}"), quiet=True)
    loaded = O.engines[0]
    assert {name: (type(getattr(loaded, name)), getattr(loaded, name).dict()) for name in before} == before
    # What was loaded is what a refused assignment goes back to, and the engine follows it.
    name, bad = {RateSupply: ("rate", -1), ReservoirSupply: ("volume", -1), PressureSupply: ("program", [math.nan])}[
        type(loaded.supply)
    ]
    with pytest.raises(ValueError, match=f"{name}.* allowed"):
        setattr(loaded.supply, name, bad)
    assert loaded.supply.dict() == before["supply"][1]


def test_copiesOfAScene():
    O.reset()
    O.engines = [GasInvasionEngine(gasLaw=IdealGas(deviation=1 / 3), supply=RateSupply(rate=1 / 3))]
    O.saveTmp("copy", quiet=True)
    held = O.engines[0].supply
    held.rate = 7.0
    O.loadTmp("copy", quiet=True)
    assert O.engines[0].supply is not held and O.engines[0].supply.rate == 1 / 3
    assert O.engines[0].gasLaw.deviation == 1 / 3


KEYWORDS = [
    (dict(gasLaw="ideal", gasDeviation=0.9), "gasLaw", IdealGas, dict(deviation=0.9, molarMass=0.016043)),
    (dict(gasLaw="tabulated", gasTable=TABLE), "gasLaw", TabulatedGas, {}),
    (dict(gasLaw="incompressible", gasDeviation=0.9), "gasLaw", IncompressibleGas, dict(deviation=0.9)),
    (dict(pressureProgram=[100.0, 50.0]), "supply", PressureSupply, dict(program=[100.0, 50.0])),
    (dict(reservoirVolume=1e-9), "supply", PressureSupply, dict(reservoirVolume=1e-9)),
    (
        dict(gasControl="rate", gasRate=np.float64(1e-9), reservoirVolume=1e-9, gasLaw="ideal"),
        "supply",
        RateSupply,
        dict(rate=1e-9, reservoirVolume=1e-9),
    ),
    (dict(gasControl="reservoir", reservoirVolume=1e-9, gasLaw="ideal"), "supply", ReservoirSupply, dict(volume=1e-9)),
]


@pytest.mark.parametrize("keywords, name, kind, values", KEYWORDS)
def test_keywordsMakeObjects(loadSample, keywords, name, kind, values):
    loadSample()
    gas = injection.startInjection(100, 1, 200, 3, **keywords)
    made = getattr(gas, name)
    assert type(made) is kind and {key: made.dict()[key] for key in values} == values


@pytest.mark.parametrize(
    "keywords, message",
    [
        (dict(gasLaw="vanDerWaals"), "gasLaw = 'vanDerWaals', allowed: 'incompressible', 'ideal', 'tabulated'"),
        (dict(gasControl="volume"), "gasControl = 'volume', allowed: 'pressure', 'rate', 'reservoir'"),
        (dict(gasControl=3), "gasControl = 3, allowed: 'pressure', 'rate', 'reservoir'"),
        (dict(gasLaw=3), r"gasLaw = 3, allowed: something like IncompressibleGas\(\)"),
        (dict(gasLaw=None), "gasLaw = None, allowed: an object such as"),
        (dict(gasTemperature=-3.0), r"IdealGas.temperature \[K\] = -3"),  # though nothing reads it
        (dict(gasRate="fast"), "gasRate = 'fast', allowed: a number"),
        (dict(gasLaw=IdealGas(), gasDeviation=0.9), "gasDeviation = 0.9, allowed: only without an object gasLaw"),
        (dict(supply=RateSupply(), gasControl="rate"), "gasControl = 'rate', allowed: only without an object supply"),
        (
            dict(pressureProgram=[150.0], gasControl="rate", gasLaw="ideal"),
            r"pressureProgram = \[150.0\], allowed: none with gasControl = 'rate'",
        ),
    ],
)
def test_keywordsThatMakeNoObject(loadSample, keywords, message):
    loadSample()
    engines = len(O.engines)
    with pytest.raises(CaseError, match=message):
        injection.startInjection(100, 1, 200, 3, **keywords)
    assert len(O.engines) == engines


@pytest.mark.parametrize(
    "values, message",
    [
        (
            dict(supply=RateSupply(rate=1e-6)),
            (
                "supply = RateSupply, allowed: PressureSupply with gasLaw = IncompressibleGas: no pressure follows .*"
                " set gasLaw = IdealGas or"
            ),
        ),
        (
            dict(supply=ReservoirSupply(volume=1.0)),
            "supply = ReservoirSupply, allowed: PressureSupply with gasLaw = IncompressibleGas",
        ),
        (
            dict(supply=ReservoirSupply(), gasLaw=IdealGas()),
            "ReservoirSupply.volume .* = 0, allowed: > 0 with supply = ReservoirSupply",
        ),
        (dict(gasLaw=TabulatedGas()), "TabulatedGas.table, pairs = 0, allowed: at least two"),
        (dict(gasLaw=IdealGas(), pressureDatum=0.0), "pressureDatum .* = 0, allowed: > -waterPressure"),
        (
            dict(supply=PressureSupply(program=[200.0])),
            "pressureIncrement .* = 0, allowed: > 0 with a PressureSupply.program",
        ),
        (
            dict(supply=PressureSupply(program=[-5.0]), pressureIncrement=1.0),
            "PressureSupply.program .* = -5, allowed: >= waterPressure",
        ),
    ],
)
def test_whatDoesNotGoTogetherIsRefusedAtTheStart(rigid, values, message):
    gas = rigid("settled", gasPressure=100, **values)
    with pytest.raises((ValueError, RuntimeError), match=message):
        gas.prepare()
    # The engine is as before: with the culprits taken back it starts.
    gas.supply, gas.gasLaw = PressureSupply(), IncompressibleGas()
    gas.prepare()
    assert gas.gasIn == pytest.approx(gas.volumes()["gas"], rel=1e-14)
