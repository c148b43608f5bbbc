"""The paper's two invasions, Figures 15 and 16 of Jain & Juanes (2008), over five seeds (long: see `--validation`).

The bounds for the coarse sediment are the project's acceptance range around the paper's two pressures (partial invasion
at 0.17 kPa, almost all pores at 0.20 kPa) and an independent rigid-packing estimate (150-165 Pa and 169-186 Pa).
For the fine sediment the paper gives 150 and 160 kPa for one sample with an inlet that it does not state; what is
asserted there is the mode and the order of magnitude, and the table of doc/validation.md reports the numbers.
"""

import pytest

from runs import FOLDER, SEEDS, execute, figureRuns, row, writeTable

pytestmark = pytest.mark.validation


@pytest.fixture(scope="module")
def coarse():
    summaries = execute(figureRuns("figure15"))
    writeTable(FOLDER / "figure15.csv", summaries)
    return [row(summary) for summary in summaries.values()]


@pytest.fixture(scope="module")
def fine():
    summaries = execute(figureRuns("figure16"))
    writeTable(FOLDER / "figure16.csv", summaries)
    return [row(summary) for summary in summaries.values()]


def test_coarseBreaksThroughNearThePapersPressure(coarse):
    assert len(coarse) == len(SEEDS)
    for run in coarse:
        assert 145 <= run["breakthrough [Pa]"] <= 190, run


def test_coarseIsNearlyFullNearThePapersPressure(coarse):
    for run in coarse:
        # Never above the range; seeds below 170 Pa are in the table (the paper reports two pressures of one sample).
        assert run["breakthrough [Pa]"] <= run["P97 [Pa]"] <= 215, run


def test_coarseIsRigid(coarse):
    for run in coarse:
        # 1 % of the radius at the breakthrough; what single column grains do later is in the table.
        assert run["displacement [r]"] < 0.01, run
        assert run["mode"] == "capillary", run
        # The contact forces stay what they were: gas at 0.2 kPa against 8-10 kPa changes each by a few per cent at most.
        assert run["forceCorrelation"] > 0.99, run


def test_fineOpens(fine):
    for run in fine:
        assert run["initiation [Pa]"] is not None, run
        # Between half of the rigid threshold 4.65 gamma/r = 155 kPa and the closing of its distribution.
        assert 75e3 < run["initiation [Pa]"] < 200e3, run
    # One rigid sample in five would be chance; two would say that the model does not fracture.
    assert sum(run["mode"] in ("fracture", "mixed") for run in fine) >= 4, fine
