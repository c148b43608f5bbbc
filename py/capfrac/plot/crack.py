# SPDX-License-Identifier: GPL-2.0-or-later
"""A crack in its sample: gas, cracked throats by aperture, stretched ones, branches and tips; and the keys to it."""

import math

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullLocator

from capfrac.plot.painter import COLOURS, bondStrokes, drawBox, drawCells, drawDisks, drawInlet
from capfrac.results.fracture import throats

#: Colours of apertures, light to dark.
APERTURES = "inferno_r"

_PATH, _STRETCHED, _PALE = "#15323f", "#6f9cc4", "#b3d6f4"


def hasCracks(found):
    """Whether there are cracked throats with gas on both sides."""
    return bool(np.any(found.inGas & found.cracked))


def keysOf(shot, found):
    """What the lines and marks of :func:`drawCrack` mean, those that are there."""
    keys = [Patch(color=_PALE, label="gas")] if np.any(shot.gasCells) else []
    if np.any(found.inGas & found.opened & ~found.cracked):
        keys.append(Line2D([], [], color=_STRETCHED, linewidth=2, label="stretched throat"))
    if len(shot.brokenBonds):
        keys.append(Line2D([], [], color=COLOURS["broken"], linewidth=1.5, label="broken bond"))
    if found.fractureBranches:
        keys.append(
            Line2D(
                [],
                [],
                color=_PATH,
                linewidth=1.2,
                marker="o",
                markersize=5,
                markerfacecolor="white",
                label="branch and its tip",
            )
        )
    if shot.inletPoints.size or (shot.inletWall and shot.inletTo > shot.inletFrom):
        mark = {"marker": "*", "linestyle": "none", "markeredgewidth": 0} if shot.inletPoints.size else {"linewidth": 4}
        keys.append(Line2D([], [], color=COLOURS["inlet"], markersize=7, solid_capstyle="butt", label="inlet", **mark))
    return keys


def branchText(found):
    """The number of branches in words."""
    n = len(found.fractureBranches)
    return f"{n or 'no'} branch{'es' if n > 1 else ''} of fracture"


def drawCrack(axes, shot, found, points, largest=None):
    """The sample with gas, cracked throats by aperture, stretched ones blue, branches and tips; ``points`` per metre.
    Returns the colours of the apertures.

    A throat is drawn as the line between the middles of the two cells that it joins. Apertures are in mean radii, on a
    logarithmic scale from 0.1 to ``largest`` (default: 10^0.5 or what there is).
    """
    radius = 0.5 * found.diameter * points
    drawCells(axes, [shot.polygon(c) for c in np.flatnonzero(shot.gasCells)], _PALE, zorder=1)
    places = np.column_stack([shot.x, shot.y])
    drawDisks(axes, places, shot.r, "#f6f1e2", "#c9c0a6", min(0.5, 0.06 * radius), zorder=2)
    joined = np.flatnonzero(found.inGas)
    centres = {
        int(c): centre
        for c, centre in zip(np.flatnonzero(shot.gasCells), throats.cellCentres(shot, np.flatnonzero(shot.gasCells)))
    }
    lines = np.array([[centres[int(a)], centres[int(b)]] for a, b in shot.throatCells[joined]]).reshape(-1, 2, 2)
    opened = found.cracked[joined]
    stretched = found.opened[joined] & ~opened
    aperture = found.aperture[joined] / (0.5 * found.diameter)
    top = largest or max(1.0, float(np.nanmax(aperture[opened], initial=1.0)))
    norm = matplotlib.colors.LogNorm(0.1, top)
    colours = matplotlib.cm.ScalarMappable(norm, matplotlib.colormaps[APERTURES])
    axes.add_collection(
        LineCollection(lines[stretched], colors=_STRETCHED, linewidths=0.22 * radius, zorder=3, capstyle="round")
    )
    order = np.argsort(aperture[opened])
    axes.add_collection(
        LineCollection(
            lines[opened][order],
            colors=colours.to_rgba(np.maximum(aperture[opened][order], 0.1)),
            linewidths=0.45 * radius,
            zorder=4,
            capstyle="round",
        )
    )
    strokes = bondStrokes(shot)
    axes.add_collection(
        LineCollection(strokes, colors=COLOURS["broken"], linewidths=0.2 * radius, zorder=5, capstyle="butt")
    )
    for number, branch in enumerate(found.fractureBranches, start=1):
        axes.plot(*branch.path.T, color=_PATH, linewidth=0.16 * radius, zorder=6)
        axes.plot(
            *branch.tip,
            marker="o",
            markersize=min(max(3.0, 1.1 * radius), 12.0),
            markerfacecolor="white",
            markeredgecolor=_PATH,
            markeredgewidth=0.9,
            zorder=7,
        )
        axes.text(*branch.tip, str(number), fontsize=max(3.5, min(7, 0.9 * radius)), ha="center", va="center", zorder=8)
    drawInlet(
        axes,
        shot,
        points,
        marker="*",
        markersize=7 if len(shot.inletPoints) == 1 else max(4.0, 0.8 * radius),
        markerfacecolor=COLOURS["inlet"],
        markeredgewidth=0,
    )
    drawBox(axes, shot, zorder=9)
    axes.set(xlim=shot.box[:2], ylim=shot.box[2:], aspect="equal")
    axes.axis("off")
    return colours


def colourBar(figure, axes, colours):
    """The scale of the apertures. Its numbers are few enough not to touch."""
    bar = figure.colorbar(colours, cax=axes, orientation="horizontal")
    low, high = colours.get_clim()
    steps = (1, 2, 5) if high / low <= 30 else (1,)
    ticks = [m * 10.0**k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for m in steps]
    bar.set_ticks([tick for tick in ticks if 0.999 * low <= tick <= 1.001 * high], minor=False)
    bar.ax.xaxis.set_minor_locator(NullLocator())
    bar.ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    bar.set_label("aperture of cracked throats / mean radius", fontsize=7.5)
    bar.ax.tick_params(labelsize=7)
