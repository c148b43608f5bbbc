# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of snapshots, in the language of Figures 15 and 16 of Jain & Juanes (2008).

Grains are disks, gas is blue, compression between grains is brown and tension green, with lines from centre to centre
as thick as the force is large. A picture's file has the same bytes whenever it is drawn from the same numbers.
"""

import math

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D

from capfrac.errors import CaseError
from capfrac.plot.painter import (
    COLOURS,
    bondStrokes,
    drawBox,
    drawCells,
    drawDisks,
    drawInlet,
    drawScaleBar,
    fitSample,
    gasDots,
)
from capfrac.plot.sheet import newFigure, putKeys, saveFigure, titleOf
from capfrac.units import prefix, quantity

__all__ = [
    "COLOURS",
    "FORCE_LIMIT",
    "FORCE_PERCENTILE",
    "FORCE_WIDTH",
    "drawPair",
    "drawSnapshot",
    "forceScaleOf",
    "newFigure",
    "prefix",
    "quantity",
    "saveFigure",
    "stateOf",
]

#: Forces are drawn to scale up to this percentile of their magnitudes, which is as thick as this share of the mean
#: radius.
FORCE_PERCENTILE, FORCE_WIDTH = 95, 0.4

#: Forces above this multiple of that percentile are drawn no thicker: one crack tip must not hide its neighbours.
FORCE_LIMIT = 2.0


def drawSnapshot(snapshot, path, title=None, width=4.6, forces=True, bonds=True, dots=True, forceScale=None):
    """Draw one snapshot to ``path`` (.png, .pdf or .svg).

    ``title`` replaces P_c and S_g above the sample; ``width`` of the sample is in inches. ``forces``, ``bonds`` and
    ``dots`` leave the contact forces, the broken bonds and the dots in the gas pores out when False. ``forceScale``
    [N] is the force whose line has the standard width; by default a high percentile of the snapshot's own forces: give
    it to make pictures comparable (see :func:`forceScaleOf`).
    """
    _drawPanels([snapshot], path, [title], width, forces, bonds, dots, forceScale)


def drawPair(snapshots, path, titles=None, width=3.6, forces=True, bonds=True, dots=True, forceScale=None):
    """Draw snapshots side by side with one scale of lengths and one of forces, as in Figures 15 and 16.

    Any number of snapshots >= 1; ``titles`` as many, or None. The rest as in :func:`drawSnapshot`. Samples of different
    size (one more than twice as wide as another) are drawn each to its own scales, and the key then gives no force.
    """
    snapshots = list(snapshots)
    titles = [None] * len(snapshots) if titles is None else list(titles)
    if not snapshots or len(titles) != len(snapshots):
        raise CaseError(
            f"drawPair got {len(snapshots)} snapshots and {len(titles)} titles, allowed: at least one, as many titles"
            " as snapshots"
        )
    _drawPanels(snapshots, path, titles, width, forces, bonds, dots, forceScale)


def forceScaleOf(*snapshots):
    """Contact force [N] that the standard width stands for: a high percentile over all the snapshots, > 0."""
    forces = np.concatenate([np.abs(s.normalForce) for s in snapshots])
    forces = forces[forces > 0]
    return float(np.percentile(forces, FORCE_PERCENTILE)) if len(forces) else 1.0


def _drawPanels(snapshots, path, titles, width, forces, bonds, dots, forceScale):
    # Everything in inches: rims around the samples, and room for title, scale bar and legend outside of them. One scale
    # of lengths for all panels, so that a sample that was pushed apart looks larger; but 1 mm beside 1 um needs two.
    rim, gap = 0.18, 0.3
    sides = np.array([(s.box[1] - s.box[0], s.box[3] - s.box[2]) for s in snapshots])
    alike = np.max(sides[:, 0]) <= 2 * np.min(sides[:, 0])
    inches = np.array([fitSample(s, width)[0] for s in snapshots])
    inches = np.full(len(sides), np.min(inches)) if alike else inches
    height = np.max(inches * sides[:, 1])
    scales = [forceScale or forceScaleOf(*(snapshots if alike else [s])) for s in snapshots]
    names = [titleOf(stateOf(s) if title is None else title, width) for s, title in zip(snapshots, titles)]
    head = 0.05 + max(high for _, high in names)
    room = len(snapshots) * width + (len(snapshots) - 1) * gap
    handles = _legend(snapshots, 72 * inches[0], forces, bonds, dots, scales, alike)
    columns = _legendColumns(handles, room)
    foot = 0.42 + 0.135 * math.ceil(len(handles) / columns)
    total = np.array([room + 2 * rim, head + height + foot])
    with newFigure(total) as figure:
        for k, (snapshot, (across, up), (title, _)) in enumerate(zip(snapshots, inches[:, None] * sides, names)):
            middle = rim + k * (width + gap) + 0.5 * width
            axes = figure.add_axes(
                [(middle - 0.5 * across) / total[0], foot / total[1], across / total[0], up / total[1]]
            )
            _drawSample(axes, snapshot, 72 * inches[k], forces, bonds, dots, scales[k])
            drawScaleBar(axes, snapshot, inches[k])
            figure.text(middle / total[0], 1 - 0.5 * head / total[1], title, ha="center", va="center", fontsize=10)
        putKeys(figure, handles, columns, rim, 1.5, 1.3)
        saveFigure(figure, path)


def stateOf(snapshot):
    """Pressure and saturation of a snapshot, as a title."""
    return f"$P_c$ = {quantity(snapshot.capillaryPressure, 'Pa')},   $S_g$ = {snapshot.gasSaturation:.2f}"


def _drawSample(axes, s, points, forces, bonds, dots, scale):
    """``points`` per metre turn lengths of the sample into widths of lines; ``scale`` [N] is the standard force."""
    radius = float(np.mean(s.r)) * points if len(s.r) else 1.0

    gas = np.flatnonzero(s.gasCells)
    drawCells(axes, [s.polygon(c) for c in gas], COLOURS["gas"], zorder=1)
    colours = np.where(s.rattler, COLOURS["rattler"], COLOURS["grain"])
    places = np.column_stack([s.x, s.y])
    drawDisks(axes, places, s.r, list(colours), COLOURS["outline"], min(0.6, 0.06 * radius), zorder=2)
    if dots and len(gas):
        centres, clearances = gasDots(s, gas)
        dotRadii = np.minimum(0.6 * clearances, 0.3 * np.mean(s.r))
        drawDisks(axes, centres, dotRadii, COLOURS["dot"], None, 0, zorder=3)
    if forces:
        for colour, sign, layer in (("compression", 1, 4), ("tension", -1, 5)):
            chosen = np.sign(s.normalForce) == sign
            widths = FORCE_WIDTH * radius * np.minimum(np.abs(s.normalForce[chosen]) / scale, FORCE_LIMIT)
            axes.add_collection(
                LineCollection(
                    s.contactEnds[chosen], colors=COLOURS[colour], linewidths=widths, capstyle="round", zorder=layer
                )
            )
    if bonds and len(s.brokenBonds):
        axes.add_collection(
            LineCollection(
                bondStrokes(s), colors=COLOURS["broken"], linewidths=_strokeWidth(radius), capstyle="round", zorder=6
            )
        )
    drawBox(axes, s, zorder=7, clip_on=False)
    drawInlet(axes, s, points)
    axes.set(xlim=s.box[:2], ylim=s.box[2:])
    axes.set_axis_off()


def _strokeWidth(radius):
    return min(max(0.16 * radius, 0.7), 2.0)


def _legend(snapshots, points, forces, bonds, dots, scales, alike):
    s = snapshots[0]
    radius = float(np.mean(s.r)) * points if len(s.r) else 1.0
    disk = {
        "marker": "o",
        "linestyle": "none",
        "markersize": 6.5,
        "markeredgecolor": COLOURS["outline"],
        "markeredgewidth": 0.6,
    }
    handles = [Line2D([], [], markerfacecolor=COLOURS["grain"], label="grain", **disk)]
    if any(np.any(t.rattler) for t in snapshots):
        handles.append(Line2D([], [], markerfacecolor=COLOURS["rattler"], label="grain without load", **disk))
    if any(np.any(t.gasCells) for t in snapshots):
        handles.append(
            Line2D(
                [],
                [],
                color=COLOURS["gas"],
                linewidth=7,
                solid_capstyle="butt",
                marker="o",
                markersize=3.2 if dots else 0,
                markerfacecolor=COLOURS["dot"],
                markeredgewidth=0,
                label="gas (dot per pore)" if dots else "gas",
            )
        )
    if any(t.inletPoints.size or t.inletTo > t.inletFrom for t in snapshots):
        handles.append(Line2D([], [], color=COLOURS["inlet"], linewidth=4, solid_capstyle="butt", label="inlet"))
    if forces:
        # One round force for both signs, so that the keys' widths can be compared.
        round1 = float(f"{scales[0]:.1g}")
        force = {"linewidth": FORCE_WIDTH * radius * round1 / scales[0], "solid_capstyle": "butt"}
        for name, sign in (("compression", 1), ("tension", -1)):
            # else no one could see it
            if any(np.any(sign * t.normalForce > 0.02 * scale) for t, scale in zip(snapshots, scales)):
                handles.append(
                    Line2D(
                        [],
                        [],
                        color=COLOURS[name],
                        label=f"{name}, {quantity(round1, 'N')}" if alike else name,
                        **force,
                    )
                )
    if bonds and any(len(t.brokenBonds) for t in snapshots):
        handles.append(
            Line2D(
                [],
                [],
                color=COLOURS["broken"],
                marker="|",
                linestyle="none",
                markersize=6,
                markeredgewidth=_strokeWidth(radius),
                label="broken bond",
            )
        )
    return handles


def _legendColumns(handles, room):
    """As many columns as ``room`` inches hold, from the numbers of letters: to measure the text would cost a
    drawing.
    """
    for columns in range(len(handles), 1, -1):
        letters = np.array([len(handle.get_label()) for handle in handles])
        longest = [np.max(column) for column in np.array_split(letters, columns)]  # matplotlib splits like this
        if sum(0.049 * n + 0.32 for n in longest) <= room:
            return columns
    return 1
