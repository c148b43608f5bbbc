"""Figure 14 of Jain & Juanes (2008): branched fractures in all directions under equal stresses, upright ones under a larger vertical stress (long: see `--validation`).

The paper shows one picture and no numbers. What is asserted is what it says: more than one branch, and the direction of the stresses.
With three samples a test for *any* direction cannot be significant; the one against the vertical, named beforehand, can.
"""

import pytest

from capfrac import fracture
from runs import FOLDER, FRACTURE_SEEDS, execute, fractureRow, fractureRuns, writeTable

pytestmark = pytest.mark.validation


@pytest.fixture(scope="module")
def summaries():
    done = execute(fractureRuns())
    writeTable(FOLDER / "figure14.csv", done, fractureRow)
    return {case: [done[f"{case}-seed{seed}"] for seed in FRACTURE_SEEDS] for case in ("figure14", "figure14_vertical")}


def test_equalStressesGiveBranches(summaries):
    rows = [fractureRow(summary) for summary in summaries["figure14"]]
    assert all(row["mode"] in ("fracture", "mixed") for row in rows), rows
    assert all(row["branches"] >= 1 for row in rows) and sum(row["branches"] >= 2 for row in rows) > len(rows) / 2, rows


def test_equalStressesPreferNoDirection(summaries):
    # Samples without a direction fail this one time in a hundred.
    found = fracture.orientationOfRuns(summaries["figure14"])
    assert found["pVertical"] > 0.01, found


def test_aLargerVerticalStressTurnsTheFractureUpright(summaries):
    found = fracture.orientationOfRuns(summaries["figure14_vertical"])
    assert abs(found["mean [degrees]"] - 90) < 30, found  # a sixth of the circle on each side: a third of all directions
    assert found["pVertical"] < 0.05, found
