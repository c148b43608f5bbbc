# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure 14 of Jain & Juanes (2008): branched fractures in all directions under equal stresses, upright ones under a
larger vertical stress (long: see `--validation`).

The paper shows one picture and no numbers. What is asserted is what it says: more than one branch, and the direction of
the stresses. Whether fractures prefer a direction is asked of the samples, not of their branches: see doc/fracture.md.
"""

import pytest

from capfrac import fracture
from runs import FOLDER, FRACTURE_SEEDS, execute, fractureRow, fractureRuns, writeTable

pytestmark = pytest.mark.validation


@pytest.fixture(scope="module")
def summaries():
    done = execute(fractureRuns())
    writeTable(FOLDER / "figure14.csv", done, fractureRow)
    return {case: [done[f"{case}-seed{seed}"] for seed in seeds] for case, seeds in FRACTURE_SEEDS.items()}


def test_equalStressesGiveBranches(summaries):
    rows = [fractureRow(summary) for summary in summaries["figure14"]]
    assert all(row["mode"] == "fracture" for row in rows), rows
    assert sum(row["branches"] >= 2 for row in rows) >= len(rows) - 1, rows  # one sample may have its accident


def test_equalStressesPreferNoDirection(summaries):
    # Samples without a direction fail each of these one time in a hundred.
    found = fracture.orientationOfRuns(summaries["figure14"])
    assert found["p"] > 0.01 and found["pVertical"] > 0.01, found


def test_aLargerVerticalStressTurnsTheFractureUpright(summaries):
    found = fracture.orientationOfRuns(summaries["figure14_vertical"])
    # a sixth of the circle on each side: a third of all directions
    assert abs(found["mean [degrees]"] - 90) < 30, found
    assert found["pVertical"] < 0.01, found
