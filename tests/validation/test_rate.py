"""Gas at a rate in the paper's two samples: what the ramp gave, and what the step of time has to do with it (long)."""

import numpy as np
import pytest

from rate import COARSE, LARGE, RUNS, highest, one, opening

pytestmark = pytest.mark.validation

#: Step of the ramp in the cases [Pa]: no two ways of raising the pressure can agree better than that.
INCREMENT = {"figure15": 1.0, "figure16": 1e3}


@pytest.fixture(scope="module")
def runs():
    return {name: one(name, **values) for name, values in {**RUNS, **COARSE}.items()}


def test_massCloses(runs):
    assert max(run["error"] for run in runs.values()) < 1e-10


@pytest.mark.parametrize("prefix", ["", "coarse-"])
def test_underPressureTheLawDoesNotMatter(runs, prefix):
    plain, ideal = runs[prefix + "ramp"], runs[prefix + "ramp-ideal"]
    assert plain["breakthrough"] == ideal["breakthrough"]
    if ideal["ledger"]["cutOff"] == 0:
        assert plain["events"] == ideal["events"] and plain["levels"]["pressure"] == ideal["levels"]["pressure"]


@pytest.mark.parametrize("prefix, case", [("", "figure16"), ("coarse-", "figure15")])
def test_slowRateFromALargeVolumeIsARamp(runs, prefix, case):
    ramp, rate = runs[prefix + "ramp"], runs[prefix + "large"]
    # The pores that the gas enters take p_0 V_pores/V_reservoir from its pressure, with V_reservoir = LARGE times all pores, a
    # third of them filled at the breakthrough at most.
    drop = (101325 + ramp["breakthrough"]) / LARGE / 3
    assert abs(highest(rate) - ramp["breakthrough"]) <= INCREMENT[case] + drop


@pytest.mark.parametrize("volume", ["small", "large"])
@pytest.mark.parametrize("refined", ["half-rate", "half-step"])
def test_halvingTheStepHardlyChangesTheBreakthrough(runs, volume, refined):
    plain, half = runs[volume], runs[f"{volume}-{refined}"]
    assert half["breakthrough"] == pytest.approx(plain["breakthrough"], rel=0.02)
    assert opening(half) == pytest.approx(opening(plain), rel=0.02)


def test_pressureFallsWhereTheSampleOpens(runs):
    history = runs["small"]["history"]
    pressure, iteration = np.array(history["gasPressure"]), np.array(history["iteration"])
    peak = int(np.argmax(pressure))
    assert pressure[peak:].min() < 0.9 * pressure[peak]
    # At the peak or before it the first throat opened; the supply went on all the time.
    first = next(i for i, opened in zip(runs["small"]["events"]["iteration"], runs["small"]["events"]["opened"]) if opened)
    assert first <= iteration[-1] and np.all(np.diff(history["mass"]) > 0)
