# SPDX-License-Identifier: GPL-2.0-or-later
"""The painter of samples: every picture that shows grains and cells is drawn by these functions.

``s``: a :class:`~capfrac.snapshot.Snapshot`; lengths are in metres on the axes, widths of lines in points.
"""

import math

import numpy as np
from matplotlib.collections import PatchCollection, PolyCollection
from matplotlib.patches import Circle, Rectangle

from capfrac.results.moment import WALL_AXIS, WALL_NAMES
from capfrac.units import quantity

COLOURS = {
    "grain": "#f3e8c3",
    "rattler": "#f7f4ec",
    "outline": "#9a8f73",
    "gas": "#5aa9ea",
    "dot": "#0f4fa8",
    "compression": "#8b4a1c",
    "tension": "#1c8f3a",
    "broken": "#e0182d",
    "wall": "#3c3c3c",
    "inlet": "#0f4fa8",
}


def fitSample(s, width):
    """Inches per metre, and the size of a sample's picture [inches]: ``width`` wide, but at most twice as high."""
    across, up = s.box[1] - s.box[0], s.box[3] - s.box[2]
    scale = min(width / across, 2 * width / up)
    return scale, scale * across, scale * up


def gasDots(s, gas):
    """For each gas domain the roomiest of many trial points in its cells, and its distance to the nearest grain [m].

    Such a point is in the pore whatever its shape; a centroid may lie on a grain.
    """
    n = 9
    weights = np.array([(i, j, n - i - j) for i in range(n + 1) for j in range(n + 1 - i)]) / n
    best = {}
    for c in gas:
        corners, rows = s.polygon(c), s.rowOf(s.cellVertices[c])
        rows = rows[rows >= 0]
        fan = np.array([[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)])
        trials = (weights @ fan).reshape(-1, 2)
        free = np.min(np.hypot(trials[:, :1] - s.x[rows], trials[:, 1:] - s.y[rows]) - s.r[rows], axis=1)
        free = np.minimum(free, np.min(np.abs(trials[:, [0, 0, 1, 1]] - s.box), axis=1))
        k = int(np.argmax(free))
        if free[k] > best.get(s.cellDomain[c], (0.0, None))[0]:
            best[s.cellDomain[c]] = (free[k], trials[k])
    order = sorted(best)
    return np.array([best[d][1] for d in order]).reshape(-1, 2), np.array([best[d][0] for d in order])


def bondStrokes(s):
    """Short strokes across the broken contacts, half way between the surfaces of the two bodies."""
    ends = s.endsOf(s.brokenBonds)
    known = np.all(np.isfinite(ends), axis=(1, 2))
    ends, rows = ends[known], s.rowOf(s.brokenBonds[known])
    radii = np.where(rows >= 0, s.r[rows], 0.0)
    along = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(along, axis=1, keepdims=True)
    along = along / np.where(length > 0, length, 1)
    middle = ends[:, 0] + along * 0.5 * (length + radii[:, :1] - radii[:, 1:])
    half = (
        0.4
        * np.where(radii > 0, radii, np.inf).min(axis=1, keepdims=True)
        * np.column_stack([-along[:, 1], along[:, 0]])
    )
    return np.stack([middle - half, middle + half], axis=1)


def drawCells(axes, polygons, colours, linewidth=0.5, zorder=1):
    """Cells, a list of ``polygons`` ((corners, 2) [m]), in one colour or one each.

    Outlines of their own colour close the hairlines that antialiasing leaves between neighbouring cells.
    """
    axes.add_collection(
        PolyCollection(polygons, facecolors=colours, edgecolors=colours, linewidths=linewidth, zorder=zorder)
    )


def drawDisks(axes, places, radii, colours, outline=None, linewidth=0.0, zorder=2):
    """Disks at ``places`` ((n, 2) [m]) with ``radii`` [m], in one colour or one each; ``linewidth`` in points."""
    disks = [Circle(place, radius) for place, radius in zip(places, radii)]
    edges = {} if outline is None else {"edgecolors": outline}
    axes.add_collection(PatchCollection(disks, facecolors=colours, linewidths=linewidth, zorder=zorder, **edges))


def drawBox(axes, s, zorder=7, **line):
    """The box of a snapshot, as a line."""
    left, right, bottom, top = s.box
    rectangle = {"fill": False, "edgecolor": COLOURS["wall"], "linewidth": 1.2, "zorder": zorder, **line}
    axes.add_patch(Rectangle((left, bottom), right - left, top - bottom, **rectangle))


def drawInlet(axes, s, points, **marker):
    """Where the gas comes in: a bar along the wall, or marks at the points; ``points`` (of widths) per metre."""
    if s.inletPoints.size:
        marker = {
            "marker": "o",
            "markersize": 6,
            "markerfacecolor": "none",
            "markeredgecolor": COLOURS["inlet"],
            **marker,
        }
        axes.plot(*s.inletPoints.T, linestyle="none", zorder=9, **marker)
    if s.inletWall and s.inletTo > s.inletFrom:
        # A bar just outside of the wall, over the stretch that takes the gas.
        axis, place = WALL_AXIS[s.inletWall], s.box[WALL_NAMES.index(s.inletWall)]
        outward = 1 if WALL_NAMES.index(s.inletWall) % 2 else -1
        line = np.empty((2, 2))
        line[:, axis] = place + outward * 2.6 / points
        line[:, 1 - axis] = s.inletFrom, s.inletTo
        axes.plot(*line.T, color=COLOURS["inlet"], linewidth=4, solid_capstyle="butt", clip_on=False, zorder=8)


def drawScaleBar(axes, s, inches):
    """A bar of 1, 2 or 5 units, at most a quarter of the sample, below its right corner; ``inches`` per metre."""
    left, right, bottom, _ = s.box
    room = (right - left) / 4
    decade = 10.0 ** math.floor(math.log10(room))
    length = max(m * decade for m in (1, 2, 5) if m * decade <= room)
    y = bottom - 0.19 / inches
    axes.plot([right - length, right], [y, y], color="black", linewidth=1.6, solid_capstyle="butt", clip_on=False)
    axes.text(right - 1.03 * length, y, quantity(length, "m"), ha="right", va="center", fontsize=8)
