# SPDX-License-Identifier: GPL-2.0-or-later
"""What decides at which pressure a fine, cohesive sediment opens: the width of the inlet and the stiffness (long).

A bond of strength sigma_c = chi gamma/r at the tip of a gas-filled flaw of half-length a breaks at
P - sigma'_H = sigma_c sqrt(alpha r/a) (linear elastic fracture mechanics with the grain as the internal length), so
wider inlets should open at lower pressures. Stiffer bonds stretch less, so the load concentrates and they break instead
of letting gas through stretched throats: the fracture is clearer (its pressure does not rise, see doc/validation.md).
"""

import statistics

import pytest

from runs import FOLDER, INLETS, STIFFNESSES, execute, inletRuns, row, stiffnessRuns, writeTable

pytestmark = pytest.mark.validation


def _medians(rows, key):
    values = {}
    for run in rows:
        # The pressure that drives gas to the outlet, not the first opened throat: that one is a matter of a single
        # throat.
        values.setdefault(run[key], []).append(run["breakthrough [Pa]"])
    return {value: statistics.median(pressures) for value, pressures in values.items()}


def test_widerInletsLetGasThroughEarlier():
    summaries = execute(inletRuns())
    writeTable(FOLDER / "inlet.csv", summaries)
    medians = _medians([row(summary) for summary in summaries.values()], "inletPores")
    assert medians[max(INLETS)] < medians[min(INLETS)], medians


def test_stifferContactsPushGrainsFarther():
    summaries = execute(stiffnessRuns())
    writeTable(FOLDER / "stiffness.csv", summaries)
    pushed = {}
    for summary in summaries.values():
        run = row(summary)
        pushed.setdefault(run["normalStiffness [N/m]"], []).append(run["displacement [r]"])
    assert statistics.median(pushed[max(STIFFNESSES)]) > statistics.median(pushed[min(STIFFNESSES)]), pushed
