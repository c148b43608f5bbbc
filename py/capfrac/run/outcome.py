# SPDX-License-Identifier: GPL-2.0-or-later
"""What a finished injection leaves: results for its summary, and the pictures of its course."""

import numpy as np

from capfrac.plot import curve, history
from capfrac.results import mode
from capfrac.run.ending import isRamped
from capfrac.values import exactText

#: Gas saturations whose capillary pressures are told [-].
SATURATIONS = (0.5, 0.9, 0.97)


def saturationPressures(levels, waterPressure):
    """The lowest P_c [Pa] of a finished level at which each of :data:`SATURATIONS` was reached; None: not reached."""
    rows = list(zip(levels["pressure"], levels["gasSaturation"], levels["finished"]))
    found = {}
    for share in SATURATIONS:
        reached = (p - waterPressure for p, s, done in rows if s >= share and done)
        found[f"capillaryPressureAt{share:.0%} [Pa]"] = next(reached, None)
    return found


def upperBounds(start, pressures, warn):
    """Names of those capillary ``pressures`` [Pa] (None: not reached) that were reached where the ramp began.

    ``start`` of the ramp [Pa]; ``warn(text)`` is told where there are some.
    """
    found = [name for name, p in pressures.items() if p is not None and p <= start * (1 + 1e-12)]
    if found:
        warn(
            f"reached at ramp.start = {exactText(start)} Pa already, so upper bounds: "
            f"{', '.join(found)}; begin the ramp lower to find them"
        )
    return found


def resultsOf(gas, start, last, course, modes):
    """Numbers of a finished run for its summary, beside its pressures: a dict.

    ``gas``: the engine; ``start``, ``last``: the first and the last snapshot; ``course`` to the end; ``modes`` of the
    run.
    """
    moved = np.hypot(*last.displacement.T) / last.r
    highest = max([*course["gasPressure"], *gas.events()["gasPressure"], last.gasPressure])
    ledger = {f"{name} [kg]" if name != "error" else name: value for name, value in gas.gasLedger().items()}
    return {
        "displacementWithRattlersAtEnd [r]": float(moved.max()),
        "largestDisplacementAtEnd [r]": modes["modeAtEnd"]["largestDisplacement"],
        "remeshes": gas.nRemeshes,
        "forceNetwork": mode.forceNetworkChange(start, last),
        "ledger [m^3]": dict(gas.volumes()),
        "iterations": last.iteration,
        "gas": {**ledger, "highestCapillaryPressure [Pa]": highest - gas.waterPressure},
    }


def drawCourse(case, gas, folder, levels, course, bounds):
    """Draw curve.png and history.png into the run ``folder`` from levels and course to the end of the run.

    ``bounds``: see :func:`upperBounds`.
    """
    from yade import O

    sample = folder.summary["sample"]
    same = {
        "events": gas.events(),
        "waterPressure": gas.waterPressure,
        "title": case["case"]["title"],
        "startTime": sample["startTime [s]"],
        "breakthroughIter": gas.breakthroughIter,
    }
    levels = {**levels, "time": [O.time - (O.iter - iteration) * O.dt for iteration in levels["iteration"]]}
    curve.drawCapillaryCurve(
        levels,
        folder.path / "curve.png",
        bondCount=sample["bondsHolding"],
        breakthroughPressure=gas.breakthroughPressure,
        history=course,
        over="pressure" if isRamped(case) else "time",
        breakthroughAtStart="breakthroughPressure" in bounds,
        **same,
    )
    history.drawHistory(course, folder.path / "history.png", **same)
