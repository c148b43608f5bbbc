# SPDX-License-Identifier: GPL-2.0-or-later
"""The table of a sweep: one line a point, a CSV with units in its header."""

import math

from capfrac.errors import CaseError
from capfrac.io.csvfiles import readRows, writeRows
from capfrac.results import mode

#: Columns after those of the sweep file: header -> how to find it in a run's summary.
RESULTS = {
    "mode": lambda s: s["mode"]["mode"],
    "modeByThroats": lambda s: s["mode"]["modeByThroats"],
    "moment": lambda s: s["mode"]["moment"],
    "modeAtBreakthrough": lambda s: s["modeAtBreakthrough"] and s["modeAtBreakthrough"]["mode"],
    "modeAtEnd": lambda s: s["modeAtEnd"]["mode"],
    "ended": lambda s: s["ended"],
    "initiationPressure [Pa]": lambda s: s["mode"]["initiationPressure"],
    "breakthroughPressure [Pa]": lambda s: s["mode"]["breakthroughPressure"],
    "endPressure [Pa]": lambda s: s["modeAtEnd"]["capillaryPressure"],
    "openedOnWay [-]": lambda s: s["mode"]["openedOnWay"],
    "rigidOnWay [-]": lambda s: s["mode"]["rigidOnWay"],
    "madeRoom [-]": lambda s: s["mode"]["madeRoom"],
    "openedShare [-]": lambda s: s["mode"]["openedShare"],
    "invadedThroats [-]": lambda s: s["mode"]["invadedThroats"],
    "brokenBonds [-]": lambda s: s["mode"]["brokenBonds"],
    "bonds [-]": lambda s: s["sample"]["bondsHolding"],
    "displacement [r]": lambda s: s["mode"]["largestDisplacement"],
    "medianDisplacement [r]": lambda s: s["mode"]["medianDisplacement"],
    "displacement90 [r]": lambda s: s["mode"]["displacement90"],
    "gasSaturation [-]": lambda s: s["mode"]["finalSaturation"],
    "inletPores [-]": lambda s: s["sample"]["inletPores"],
    "inletWidth [m]": lambda s: s["sample"]["inletWidth [m]"],
    "boxWidth [m]": lambda s: s["sample"]["boxWidth [m]"],
    "boxHeight [m]": lambda s: s["sample"]["boxHeight [m]"],
    "porosity [-]": lambda s: s["sample"]["porosity"],
    "entryPressureMin [Pa]": lambda s: s["sample"]["throatEntryPressureMin [Pa]"],
    "entryPressureMax [Pa]": lambda s: s["sample"]["throatEntryPressureMax [Pa]"],
    "iterations [-]": lambda s: s["results"]["iterations"],
    "upperBounds": lambda s: " ".join(s["results"].get("upperBounds", ())),
    "warnings": lambda s: "; ".join(s.get("warnings", ())),
    "threads [-]": lambda s: s.get("threads"),
    "cpuSeconds [s]": lambda s: s["cpuSeconds"],
    "capfrac": lambda s: s["versions"]["capfrac"],
    "yade": lambda s: s["versions"]["yade"],
}


def row(point, columns, state, summary, folder, error=""):
    """The line of a point with its run folder: dict of header -> value; what a point that is not finished does not have
    is None.
    """
    line = {
        "point": point.name,
        "state": state,
        **{header(name, unit): point.values[name] for name, unit in columns.items()},
    }
    if state == "finished":
        summary = {**summary, **mode.summarised(summary, folder)}
    for name, find in RESULTS.items():
        line[name] = find(summary) if state == "finished" else None
    return {**line, "error": " ".join(error.split())}


def header(name, unit):
    """Header of a column: name and unit."""
    return f"{name} [{unit}]"


def write(path, rows):
    """Write rows (all with the same headers) as a CSV; empty for None."""
    writeRows(path, list(rows[0]), (line.values() for line in rows), form=".6g")


def read(path, needed=()):
    """The lines of finished points of a table: a list of dicts, numbers as floats (NaN where empty), texts as they are.

    Raises :class:`CaseError` for a file that is no such table, or one that lacks a ``needed`` column.
    """
    try:
        rows = readRows(path)
    except (OSError, UnicodeDecodeError) as problem:
        raise CaseError(f"the table {path} cannot be read: {problem}") from None
    for name in ("point", "state", *needed):
        if not rows or name not in rows[0]:
            raise CaseError(f"{path} is not the table of a sweep, or holds no points: the column '{name}' is missing")
    return [
        {name: _number(value) if name.endswith("]") else value for name, value in line.items()}
        for line in rows
        if line["state"] == "finished"
    ]


def _number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan
