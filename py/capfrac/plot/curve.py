# SPDX-License-Identifier: GPL-2.0-or-later
"""What an injection did, level by level, as a picture: P_c against saturation, what opened, what moved."""

import itertools
import math

import numpy as np
from matplotlib.ticker import MaxNLocator, NullFormatter

from capfrac.errors import CaseError
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, putLegend, putTitle, saveFigure, saySo, titleOf
from capfrac.units import prefix

#: What the second and third panel can be drawn over.
OVER = ("pressure", "time")
_DASHED = {"color": "0.45", "linewidth": 0.9, "linestyle": (0, (4, 3)), "zorder": 1}


def drawCapillaryCurve(
    levels,
    path,
    events=None,
    bondCount=None,
    breakthroughPressure=math.nan,
    waterPressure=0.0,
    title=None,
    over="pressure",
    history=None,
    breakthroughIter=-1,
    startTime=0.0,
    breakthroughAtStart=False,
):
    """Draw P_c against saturation, and the opened throats, broken bonds and displacements on the way there.

    ``levels`` and ``events`` are the dicts of ``gas.levels()`` and ``gas.events()``; a level that is not ``finished``
    (where the dict says so) is the end of the run. The second panel shows the share of the invaded throats that had
    opened (with ``events``) and broken bonds, as a share of ``bondCount`` where that is given. Pressures are those of
    the engine [Pa]; ``waterPressure`` is taken off. Hollow marks are levels that ended before the grains were at rest.

    ``over``: "pressure" for a ramp; "time" for a pressure that goes up and down, as under a rate, from a reservoir or
    through a program. Levels then have a ``time`` [s], too; times count from ``startTime``, ``history`` (that of
    ``gas.history()``) draws the lines between the levels, and ``breakthroughIter`` says when the gas came through.
    ``breakthroughAtStart``: gas was through where the ramp began, so its pressure is marked as an upper bound. A panel
    without anything to show says so. :class:`CaseError` for another ``over``.
    """
    if over not in OVER:
        raise CaseError(f"over = {over!r}, allowed: {', '.join(map(repr, OVER))}")
    if over == "time" and "time" not in levels:
        raise CaseError("the levels have no 'time' [s], which over = 'time' needs")
    course = _Course(levels, events, history if over == "time" else None, waterPressure, startTime, over)
    text, head = titleOf(title, 9.6)
    total = 3.1 + max(0.0, head - 0.3)
    with newFigure((9.6, total)) as figure:
        # a second scale takes room
        grid = {
            "left": 0.075,
            "right": 0.985,
            "bottom": 0.51 / total,
            "top": 1 - max(head, 0.15) / total,
            "wspace": 0.33 if bondCount else 0.5,
        }
        curve, opening, moving = figure.subplots(1, 3, gridspec_kw=grid)
        word = "breakthrough, here or below" if breakthroughAtStart else "breakthrough"
        _drawCurve(curve, course, levels, (breakthroughPressure - waterPressure) / course.pascal, word)
        _drawOpening(opening, course, events, bondCount)
        _drawMoving(moving, course, levels)
        at = course.breakthrough(events, breakthroughPressure, breakthroughIter)
        for axes in (opening, moving):
            axes.set(xlabel=course.label, xlim=_rangeOf(course.shown))
            if math.isfinite(at):
                axes.axvline(at, label=word, **_DASHED)
        for axes in figure.axes:
            axes.tick_params(labelsize=8)
            axes.spines["top"].set_visible(False)
        for axes in (curve, opening, moving):
            axes.spines["right"].set_visible(False)
            putLegend(axes)
        putTitle(figure, text)
        saveFigure(figure, path)


class _Course:
    """The states of a run in their order, as the panels show them: ``x`` of each is a pressure or a time."""

    def __init__(self, levels, events, history, water, start, over):
        self.over, self.water, self.start = over, water, start
        pressures = [column["gasPressure"] for column in (history, events) if column]
        highest = max([*levels["pressure"], *itertools.chain(*pressures)], default=water) - water
        self.pascal, self.unit = prefix(highest, "Pa")
        self.pressure = (np.array(levels["pressure"], dtype=float) - water) / self.pascal
        times = [*levels.get("time", ()), *(events["time"] if events and over == "time" else ())]
        self.second, unit = prefix(max(times, default=start) - start, "s")
        self.label = (
            f"capillary pressure $P_c$ [{self.unit}]" if over == "pressure" else f"time since the start [{unit}]"
        )
        self.x = self.pressure if over == "pressure" else self.since(levels["time"])
        states = {name: np.array(levels[name], dtype=float) for name in ("pressure", "gasSaturation", "brokenBonds")}
        self.lineX = self.x
        if history is not None:  # between the levels, too
            more = {
                "pressure": history["gasPressure"],
                "gasSaturation": history["gasSaturation"],
                "brokenBonds": history["brokenBonds"],
            }
            self.lineX = np.append(self.since(history["time"]), self.x)
            order = np.argsort(self.lineX, kind="stable")
            self.lineX = self.lineX[order]
            states = {name: np.append(more[name], values)[order] for name, values in states.items()}
        self.linePressure = (states["pressure"] - water) / self.pascal
        self.lineSaturation, self.lineBroken = states["gasSaturation"], states["brokenBonds"]
        self.eventX = np.array([])
        if events is not None and len(events["opened"]):
            entered = np.array(events["gasPressure"], dtype=float)
            self.eventX = (entered - water) / self.pascal if over == "pressure" else self.since(events["time"])
        self.shown = np.concatenate([self.lineX, self.eventX])

    def since(self, times):
        return (np.array(times, dtype=float) - self.start) / self.second

    def breakthrough(self, events, pressure, iteration):
        """Where the gas reached the outlet on the axis of the second and third panel; NaN where it did not."""
        if self.over == "pressure":
            return (pressure - self.water) / self.pascal
        if not events or iteration not in events.get("iteration", ()):
            return math.nan
        return float(self.eventX[list(events["iteration"]).index(iteration)])


def _drawCurve(axes, course, levels, breakthrough, word):
    axes.set(xlabel="gas saturation $S_g$", ylabel=f"capillary pressure $P_c$ [{course.unit}]", xlim=(0, 1))
    if not len(course.linePressure):
        saySo(axes, "no level was finished")
        return
    axes.plot(
        course.lineSaturation,
        course.linePressure,
        color=COLOURS["gas"],
        linewidth=1.2,
        zorder=2,
        label="course",
        marker="." if len(course.linePressure) == 1 else None,
    )
    finished = np.array(levels.get("finished", [True] * len(course.pressure)), dtype=bool)
    rest = np.array(levels["atRest"], dtype=bool)
    saturation = np.array(levels["gasSaturation"], dtype=float)
    for name, marker, size, fill, chosen in (
        ("grains at rest", "o", 9, COLOURS["dot"], finished & rest),
        ("not at rest", "o", 9, "white", finished & ~rest),
        ("end of the run", "D", 16, "white", ~finished),
    ):
        if chosen.any():
            axes.scatter(
                saturation[chosen],
                course.pressure[chosen],
                s=size,
                c=fill,
                edgecolors=COLOURS["dot"],
                linewidths=0.7,
                marker=marker,
                zorder=3,
                clip_on=False,
                label=name,
            )
    if math.isfinite(breakthrough):
        axes.axhline(breakthrough, label=word, **_DASHED)


def _drawOpening(axes, course, events, bondCount):
    axes.set(ylabel="share" if bondCount else "broken bonds")
    label = "broken bonds / bonds" if bondCount else "broken bonds"
    if len(course.lineX):
        axes.plot(
            course.lineX,
            course.lineBroken / (bondCount or 1),
            color=COLOURS["broken"],
            linewidth=1.4,
            label=label,
            marker="." if len(course.lineX) == 1 else None,
            drawstyle="default" if course.over == "pressure" else "steps-post",
        )
    most = 1 if bondCount else max(1, *course.lineBroken, 1)
    axes.set_ylim(-0.03 * most, 1.03 * most)
    if not bondCount:
        axes.yaxis.set_major_locator(MaxNLocator("auto", integer=True))
    if len(course.eventX):
        # Up to the last event at each place: within an avalanche the share says nothing about it.
        at, last = np.unique(course.eventX[::-1], return_index=True)
        last = len(course.eventX) - last
        shares = axes if bondCount else axes.twinx()
        shares.plot(
            at,
            np.cumsum(events["opened"])[last - 1] / last,
            color=COLOURS["dot"],
            linewidth=1.4,
            drawstyle="steps-post",
            marker="o",
            markersize=2.5,
            label="opened / invaded throats",
        )
        shares.set_ylim(-0.03, 1.03)
        if not bondCount:
            shares.set_ylabel("share of the invaded throats")
            axes.plot(
                [],
                [],
                color=COLOURS["dot"],
                linewidth=1.4,
                marker="o",
                markersize=2.5,
                label="opened / invaded throats",
            )
    if not len(course.shown):
        saySo(axes, "no pore was entered")


def _drawMoving(axes, course, levels):
    axes.set(yscale="log", ylabel="largest displacement / radius")
    for key, label, colour, line in (
        ("displacement", "loaded grains", COLOURS["compression"], "-"),
        ("displacementWithRattlers", "all grains", COLOURS["outline"], (0, (2, 2))),
    ):
        values = np.array(levels[key], dtype=float)
        if np.any(values > 0):
            axes.plot(
                course.x,
                np.where(values > 0, values, np.nan),
                linestyle=line,
                color=colour,
                linewidth=1.4,
                label=label,
                marker="." if np.sum(values > 0) == 1 else None,
            )
    if not axes.lines:
        saySo(axes, "no grain has moved")
        return
    axes.yaxis.set_minor_formatter(NullFormatter())
    low, high = (math.log10(v) for v in axes.get_ylim())
    axes.set_ylim(10.0 ** math.floor(low), 10.0 ** max(math.ceil(high), math.floor(low) + 1))  # whole decades


def _rangeOf(values):
    if len(values) == 0:
        return 0.0, 1.0
    low, high = float(np.min(values)), float(np.max(values))
    rim = 0.03 * (high - low) or 0.03 * abs(high) or 1.0
    return low - rim, high + rim
