"""What decides at which pressure a fine, cohesive sediment opens: the width of the inlet and the stiffness (long).

A bond of strength sigma_c = chi gamma/r at the tip of a gas-filled flaw of half-length a breaks at
P - sigma'_H = sigma_c sqrt(alpha r/a) (linear elastic fracture mechanics with the grain as the internal length), so
wider inlets open at lower pressures. Stiffer contacts stretch less before they break, so throats open later.
"""

import statistics

import pytest

from runs import FOLDER, INLETS, STIFFNESSES, execute, inletRuns, row, stiffnessRuns, writeTable

pytestmark = pytest.mark.validation


def _medians(rows, key):
    values = {}
    for run in rows:
        # A run that never opened did so above its last pressure: the rigid threshold stands for it.
        values.setdefault(run[key], []).append(run["initiation [Pa]"] or run["breakthrough [Pa]"])
    return {value: statistics.median(pressures) for value, pressures in values.items()}


def test_widerInletsOpenEarlier():
    summaries = execute(inletRuns())
    writeTable(FOLDER / "inlet.csv", summaries)
    medians = _medians([row(summary) for summary in summaries.values()], "inletPores")
    assert medians[max(INLETS)] < medians[min(INLETS)], medians


def test_stifferContactsOpenLater():
    summaries = execute(stiffnessRuns())
    writeTable(FOLDER / "stiffness.csv", summaries)
    medians = _medians([row(summary) for summary in summaries.values()], "normalStiffness [N/m]")
    assert medians[max(STIFFNESSES)] > medians[min(STIFFNESSES)], medians
