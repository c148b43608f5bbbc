# SPDX-License-Identifier: GPL-2.0-or-later
"""Gas at a rate into a rigid, sealed pack of known volumes, against closed forms.

Between two entries the volume of the gas is constant, so p(t) + p_0 = (M_0 + q t) Z R T/(M V) with V the volumes of the
reservoir, the inlet and all pores entered so far. The grains stand still: volumes and entry pressures are those that
the engine lists before the injection. Round-off: a few hundred sums, each to some eps, 1e-12 at most.
"""

import numpy as np
import pytest
from yade import O
from yade.wrapper import ForceResetter, GasInvasionEngine, IdealGas, RateSupply

GAS_CONSTANT = 8.31446261815324  # J/(mol K)
MOLAR_MASS, TEMPERATURE, DEVIATION, DATUM = 0.016043, 290.0, 0.95, 500.0
PER_DENSITY = DEVIATION * GAS_CONSTANT * TEMPERATURE / MOLAR_MASS  # p/rho
RATE, DT, RESERVOIR, START = 2e-3, 1e-5, 3e-4, 50.0


@pytest.fixture
def pack(settledScene):
    """A function (attributes of the supply, **attributes) -> gas engine at a rate in the settled sample of 60 grains.
    They stand still.
    """

    def make(supply={}, **attributes):
        walls = settledScene()
        gas = GasInvasionEngine(
            checkInvariants=True,
            gasPressure=START,
            gasLaw=IdealGas(molarMass=MOLAR_MASS, temperature=TEMPERATURE, deviation=DEVIATION),
            pressureDatum=DATUM,
            supply=RateSupply(**{"rate": RATE, "reservoirVolume": RESERVOIR, **supply}),
            historyInterval=1,
            **attributes,
        )
        gas.inletFrom, gas.inletTo = gas.inletStretch(2, 0.5 * (walls[0] + walls[1]))
        O.engines, O.dt = [ForceResetter(), gas], DT
        O.engines[1].prepare()
        return O.engines[1]

    return make


def closedForm(inlet, supplied, pores):
    """Pressure of the gas [Pa] when `supplied` [kg] came in and `pores` [m^3] were entered."""
    mass = (START + DATUM) / PER_DENSITY * (RESERVOIR + inlet) + supplied
    return mass * PER_DENSITY / (RESERVOIR + inlet + pores) - DATUM


@pytest.mark.parametrize("interval", [0, 5])
def test_pressureBetweenAndAtTheEntries(pack, interval):
    gas = pack(invasionInterval=interval)
    inlet = gas.volumes()["gas"]
    steps = 3000
    O.run(steps, True)
    events, history = gas.events(), gas.history()
    assert len(history["time"]) == steps and gas.nEvents > 20
    # At the end of each step: all that came in so far, in all the pores entered so far.
    iterations = np.array(events["iteration"])
    for step in range(steps):
        entered = float(np.sum(np.array(events["volume"])[iterations <= history["iteration"][step]]))
        expected = closedForm(inlet, RATE * DT * (step + 1), entered)
        assert history["gasPressure"][step] == pytest.approx(expected, rel=1e-12, abs=1e-12 * DATUM)
        assert history["connectedVolume"][step] == pytest.approx(inlet + entered, rel=1e-12)
    # At an entry: before the pore takes its share, after those that came before it, in the same step, too.
    volume = 0.0
    for k in range(gas.nEvents):
        first = history["iteration"][0]
        expected = closedForm(inlet, RATE * DT * (events["iteration"][k] - first + 1), volume)
        assert events["gasPressure"][k] == pytest.approx(expected, rel=1e-12, abs=1e-12 * DATUM)
        volume += events["volume"][k]


def test_poresAreEnteredAtTheirEntryPressures(pack):
    gas = pack()
    O.run(3000, True)
    events = gas.events()
    rise = RATE * DT * PER_DENSITY / RESERVOIR  # of one step, at the smallest volume of the gas
    pressures, entries, iterations = (np.array(events[name]) for name in ("gasPressure", "entryPressure", "iteration"))
    assert np.all(pressures >= entries)
    # The first of a step met a pressure that had not been there before, by no more than the rise of the step; none was
    # open a step ago.
    first = np.concatenate([[True], np.diff(iterations) > 0])
    assert first.sum() > 10 and np.all(pressures[first] <= entries[first] + rise)
    # What follows in the same step was opened by the pore before it: at a pressure that this pore has lowered.
    assert np.all(np.diff(pressures)[~first[1:]] < 0)


def test_halfTheStepGivesTheSamePoresAtTheSamePressures(pack):
    def run(divisor):
        gas = pack()
        O.dt = DT / divisor
        O.run(3000 * divisor, True)
        return gas.events(), gas.gasPressure

    (coarse, last), (fine, lastFine) = run(1), run(4)
    assert coarse["throat"] == fine["throat"]
    rise = RATE * DT * PER_DENSITY / RESERVOIR
    # an entry is late by a step at most
    np.testing.assert_allclose(coarse["gasPressure"], fine["gasPressure"], rtol=0, atol=rise)
    assert last == pytest.approx(lastFine, rel=1e-10)  # the same gas in the same pores


def test_smallVolumesFillAtTheRateOfTheSupply(pack):
    # Without a reservoir the gas of two pores cannot fill a third: its pressure falls to the water's, and the pore
    # fills by and by.
    gas = pack(dict(reservoirVolume=0.0, rate=2e-4))
    inlet = gas.volumes()["gas"]
    mass = (START + DATUM) / PER_DENSITY * inlet
    waited = 0
    for step in range(3000):
        O.step()
        mass += 2e-4 * DT
        volume = gas.history()["connectedVolume"][-1]
        assert mass == pytest.approx((gas.gasPressure + DATUM) / PER_DENSITY * volume, rel=1e-12)
        assert gas.gasPressure >= 0
        waited += gas.gasPressure == 0
    assert gas.nEvents > 5 and 0 < waited < 3000
    assert gas.volumes()["error"] < 1e-12
