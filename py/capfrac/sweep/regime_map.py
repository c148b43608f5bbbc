# SPDX-License-Identifier: GPL-2.0-or-later
"""The regime map from the table of its sweep: grain size of the change of mode, against stress and cohesion.

Everything here is computed from a table (:mod:`capfrac.sweep.table`), never from the runs themselves.
"""


import numpy as np

from capfrac.io.csvfiles import writeRows
from capfrac.sweep import table
from capfrac.theory import regime

#: Columns that a table needs.
NEEDED = (
    "stress.horizontal [Pa]",
    "grains.rMin [m]",
    "cohesion.chi [-]",
    "grains.seed [-]",
    "rMean [m]",
    "stressNumber [-]",
    "mode",
    "ended",
    "breakthroughPressure [Pa]",
    "endPressure [Pa]",
    "displacement [r]",
    "medianDisplacement [r]",
    "openedShare [-]",
    "inletWidth [m]",
)
#: Median displacement [r] from which on a sediment has given way as a whole: see :func:`changes`.
GAVE_WAY = 0.5


def read(path):
    """The finished points of a table, each with ``mapMode``, ``mapModeByThroats``, ``pressure`` [Pa] and ``aOverR``
    besides its columns.
    """
    rows = table.read(path, NEEDED)
    for row in rows:
        row["mapModeByThroats"] = modeByThroats(row)
        row["mapMode"] = mapMode(row)
        through = row["breakthroughPressure [Pa]"]
        row["pressure"] = through if np.isfinite(through) else row["endPressure [Pa]"]
        row["aOverR"] = 0.5 * row["inletWidth [m]"] / row["rMean [m]"]
    return rows


def modeByThroats(row):
    """The mode of a run by the older rule of :mod:`capfrac.mode`, but for one case.

    Gas that lifts the sediment from the inlet before it has entered a single pore is called 'none' there (no throat
    says how it was entered); in the map it is what it is, a fracture.
    """
    mode = row.get("modeByThroats", row["mode"])
    return "fracture" if mode == "none" and row["displacement [r]"] >= 1 else mode


def mapMode(row):
    """The mode of a run, by the rule of :mod:`capfrac.mode`; in a table of before that rule, by the older one."""
    return row["mode"] if "modeByThroats" in row else modeByThroats(row)


def changes(rows):
    """r* for each cohesion and stress: a list of dicts.

    ``chi``, ``stressH`` [Pa], ``aOverR`` (median of the runs), ``theory`` (r* [m] for that flaw, 0 if none), ``change``
    (a :class:`~capfrac.regime.Change` in mean radii [m], by the modes), ``byThroats`` (the same by the older rule of
    the mode, in which one grain that slips into a void may decide) and, as another opinion, ``gaveWay`` [m]: where the
    median displacement of the grains falls through ``GAVE_WAY`` radii.
    """
    found = []
    for chi in sorted({row["cohesion.chi [-]"] for row in rows}):
        for stress in sorted({row["stress.horizontal [Pa]"] for row in rows}):
            here = [row for row in rows if row["cohesion.chi [-]"] == chi and row["stress.horizontal [Pa]"] == stress]
            if here:
                a = float(np.median([row["aOverR"] for row in here]))
                gamma = stress * here[0]["rMean [m]"] / here[0]["stressNumber [-]"]
                found.append(
                    {
                        "chi": chi,
                        "stressH": stress,
                        "aOverR": a,
                        "theory": float(regime.criticalRadius(stress, chi, gamma, a)),
                        **_change(here, "rMean [m]"),
                    }
                )
    return found


def _change(rows, abscissa):
    x = [row[abscissa] for row in rows]
    return {
        "change": regime.modeChange(x, [row["mapMode"] for row in rows]),
        "byThroats": regime.modeChange(x, [row["mapModeByThroats"] for row in rows]),
        "gaveWay": regime.crossing(x, [max(row["medianDisplacement [r]"], 1e-12) for row in rows], GAVE_WAY),
    }


def laws(found):
    """The :class:`~capfrac.regime.PowerLaw` of r* against sigma'_H by both opinions, where there are two r* or more:
    dict chi -> dict ``change``, ``gaveWay`` -> law.
    """
    result = {}
    for chi in sorted({entry["chi"] for entry in found}):
        result[chi] = {}
        for opinion, radius in (
            ("change", lambda entry: entry["change"].radius),
            ("gaveWay", lambda entry: entry["gaveWay"]),
        ):
            known = [
                (entry["stressH"], radius(entry))
                for entry in found
                if entry["chi"] == chi and np.isfinite(radius(entry))
            ]
            if len(known) > 1:
                result[chi][opinion] = regime.powerLaw(*zip(*known))
    return result


def numbers(rows):
    """The change in sigma'_H r/gamma, of all stresses together: dict chi -> dict of ``change``, ``byThroats`` and
    ``gaveWay`` [-], as in :func:`changes`.
    """
    return {
        chi: _change([row for row in rows if row["cohesion.chi [-]"] == chi], "stressNumber [-]")
        for chi in sorted({row["cohesion.chi [-]"] for row in rows})
    }


#: Columns of the table of :func:`writeChanges`.
CHANGE_COLUMNS = (
    "cohesion.chi [-]",
    "stress.horizontal [Pa]",
    "runs [-]",
    "inlet a/r [-]",
    "rStar [m]",
    "allFractureUpTo [m]",
    "noFractureFrom [m]",
    "allCapillaryFrom [m]",
    "rStarByThroats [m]",
    "rStarByMedianDisplacement [m]",
    "rStarTheory [m]",
    "exponent [-]",
    "exponentError [-]",
    "exponentByMedianDisplacement [-]",
    "exponentByMedianDisplacementError [-]",
)


def writeChanges(rows, path):
    """Write r* of each cohesion and stress by both opinions and by theory, and the fitted exponents, as a CSV with
    units in its header.
    """
    found = changes(rows)
    fits = laws(found)
    writeRows(path, CHANGE_COLUMNS, (_changeRow(entry, fits[entry["chi"]]) for entry in found))


def _changeRow(entry, fit):
    """The numbers of :data:`CHANGE_COLUMNS` of one cohesion and stress, as texts; what there is not is empty."""
    change = entry["change"]
    exponents = [
        getattr(fit.get(opinion), name, np.nan) for opinion in ("change", "gaveWay") for name in ("exponent", "error")
    ]
    values = [
        entry["chi"],
        entry["stressH"],
        change.runs,
        entry["aOverR"],
        change.radius,
        change.low,
        change.high,
        change.rigid,
        entry["byThroats"].radius,
        entry["gaveWay"],
        entry["theory"],
        *exponents,
    ]
    return ["" if isinstance(value, float) and not np.isfinite(value) else f"{value:.5g}" for value in values]
