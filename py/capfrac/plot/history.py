# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of the course of an injection in time; its numbers are those of :mod:`capfrac.results.course`."""

import math

import numpy as np
from matplotlib.ticker import MaxNLocator

from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, putLegend, putTitle, saveFigure, saySo, titleOf
from capfrac.results.course import courseToTheEnd, levelsToTheEnd
from capfrac.units import prefix

__all__ = ["courseToTheEnd", "drawHistory", "levelsToTheEnd"]


def drawHistory(history, path, events=None, breakthroughIter=-1, startTime=0.0, waterPressure=0.0, title=None):
    """Draw P_c over time, with the pores that the gas entered, and below it saturation and broken bonds.

    ``history`` and ``events`` are the dicts of ``gas.history()`` and ``gas.events()``; ``breakthroughIter`` is the
    engine's, -1 where the gas did not reach the outlet. Times count from ``startTime`` [s]; ``waterPressure`` [Pa] is
    taken off the pressures. The first throat that had opened and the breakthrough are marked. A panel without anything
    to show says so.
    """
    rows = {name: list(history[name]) for name in ("time", "gasPressure", "gasSaturation", "brokenBonds")}
    entries = events if events is not None else {"time": [], "gasPressure": [], "opened": [], "iteration": []}
    # Of one step, the entries come before its row: the pressure falls by them.
    times, pressures = [*entries["time"], *rows["time"]], [*entries["gasPressure"], *rows["gasPressure"]]
    second, unit = prefix(max(times, default=startTime) - startTime, "s")
    pascal, pressureUnit = prefix(max(pressures, default=waterPressure) - waterPressure, "Pa")
    course = _Lines(startTime, second, waterPressure, pascal)
    text, head = titleOf(title, 6.4)
    total = 4.2 + max(0.0, head - 0.3)
    with newFigure((6.4, total)) as figure:
        grid = {
            "left": 0.115,
            "right": 0.885,
            "bottom": 0.48 / total,
            "top": 1 - max(head, 0.13) / total,
            "hspace": 0.12,
            "height_ratios": (2, 1),
        }
        above, below = figure.subplots(2, 1, sharex=True, gridspec_kw=grid)
        _drawPressure(above, course, times, pressures, entries, breakthroughIter)
        above.set(ylabel=f"capillary pressure $P_c$ [{pressureUnit}]")
        below.set(xlabel=f"time since the start of the injection [{unit}]", ylabel="gas saturation $S_g$")
        bonds = _drawGas(below, course, rows)
        through = course.breakthrough(entries, breakthroughIter)
        if math.isfinite(through):
            for axes in (above, below):
                axes.axvline(
                    through,
                    color="0.45",
                    linewidth=0.9,
                    linestyle=(0, (4, 3)),
                    zorder=1,
                    label="breakthrough" if axes is above else None,
                )
        for axes in figure.axes:
            axes.tick_params(labelsize=8)
            axes.spines["top"].set_visible(False)
        above.spines["right"].set_visible(False)
        putLegend(above)
        if bonds is not None:
            putLegend(below, bonds)
        putTitle(figure, text)
        saveFigure(figure, path)


class _Lines:
    """Times and pressures in the units of the axes."""

    def __init__(self, start, second, water, pascal):
        self.start, self.second, self.water, self.pascal = start, second, water, pascal

    def time(self, values):
        return (np.array(values, dtype=float) - self.start) / self.second

    def pressure(self, values):
        return (np.array(values, dtype=float) - self.water) / self.pascal

    def breakthrough(self, events, iteration):
        places = [k for k, number in enumerate(events["iteration"]) if number == iteration]
        return float(self.time(events["time"])[places[0]]) if places else math.nan


def _drawPressure(axes, course, times, pressures, events, breakthroughIter):
    if not times:
        saySo(axes, "the run ended before its first level")
        return
    # Through the entries, too: between two rows of the history the pressure may jump.
    at, values = course.time(times), course.pressure(pressures)
    order = np.argsort(at, kind="stable")
    axes.plot(
        at[order],
        values[order],
        color=COLOURS["gas"],
        linewidth=1.3,
        zorder=2,
        label="$P_c$",
        marker="." if len(at) == 1 else None,
    )
    at, entered = course.time(events["time"]), course.pressure(events["gasPressure"])
    opened = np.array(events["opened"], dtype=bool)
    for name, colour, chosen in (
        ("pore entered, rigid throat", COLOURS["dot"], ~opened),
        ("pore entered, opened throat", COLOURS["broken"], opened),
    ):
        if chosen.any():
            axes.plot(at[chosen], entered[chosen], ".", color=colour, markersize=4, zorder=3, label=name)
    if opened.any():
        first = int(np.flatnonzero(opened)[0])
        axes.plot(
            at[first],
            entered[first],
            "^",
            color=COLOURS["broken"],
            markersize=8,
            markerfacecolor="none",
            zorder=4,
            label="first opened throat",
        )


def _drawGas(axes, course, rows):
    """Saturation, and broken bonds on axes of their own, which are returned; None without a row."""
    if not rows["time"]:
        saySo(axes, "no row of the history")
        return None
    time, dot = course.time(rows["time"]), "." if len(rows["time"]) == 1 else None
    axes.plot(time, rows["gasSaturation"], color=COLOURS["dot"], linewidth=1.3, marker=dot, label="gas saturation")
    bonds = axes.twinx()
    bonds.plot(
        time,
        rows["brokenBonds"],
        color=COLOURS["broken"],
        linewidth=1.1,
        drawstyle="steps-post",
        marker=dot,
        label="broken bonds",
    )
    bonds.set_ylabel("broken bonds", color=COLOURS["broken"])
    bonds.yaxis.set_major_locator(MaxNLocator("auto", integer=True))
    for each, most in ((axes, max(*rows["gasSaturation"], 0.01)), (bonds, max(1, *rows["brokenBonds"]))):
        each.set_ylim(-0.04 * most, 1.06 * most)  # a line at nothing is a line, too
    axes.yaxis.label.set_color(COLOURS["dot"])
    return bonds
