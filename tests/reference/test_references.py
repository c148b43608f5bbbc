# SPDX-License-Identifier: GPL-2.0-or-later
"""What the engines give against what they gave: the same events in order, and the same numbers (see tolerances.py)."""

import numpy as np
import pytest

from cases import MOVING, STILL, finite
from references import DATA, read
from tolerances import allowed, kindOf


def checkTable(where, found, reference, kind, scales):
    assert list(found) == list(reference), where
    for name, expected in reference.items():
        assert len(found[name]) == len(
            expected
        ), f"{where}: {len(found[name])} rows of {name}, {len(expected)} in the reference"
        # NaN and infinity stand where they stood.
        off = np.abs(np.where(found[name] == expected, 0.0, found[name] - expected))
        worst = np.argmax(off - allowed(name, expected, kind, scales)) if len(off) else 0
        bad = ~(off <= allowed(name, expected, kind, scales)) & ~(np.isnan(found[name]) & np.isnan(expected))
        assert (
            not bad.any()
        ), f"{where}, {name}, row {worst + 1}: {found[name][worst]!r}, {expected[worst]!r} in the reference"


@pytest.mark.parametrize("case", [*STILL, *MOVING])
def test_asItWas(loadSample, request, case):
    if request.config.getoption("--nudge"):
        pytest.skip("the references are of the sample as it is stored")
    rMin = None

    def build(radius):
        nonlocal rMin
        rMin = radius
        loadSample(radius)

    tables = {**STILL, **MOVING}[case](build)
    reference, kind = read(case), kindOf(case, case in MOVING)
    assert sorted(tables) == sorted(reference)
    scales = {"length": rMin, "one": 1.0}
    for name, table in tables.items():
        checkTable(f"{case}, {name}", finite(table), reference[name], kind, scales)


def test_everyReferenceHasItsCase():
    assert {folder.name for folder in DATA.iterdir()} == {*STILL, *MOVING}
