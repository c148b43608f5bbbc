# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of snapshots, in the language of Figures 15 and 16 of Jain & Juanes (2008).

Grains are disks, gas is blue, compression between grains is brown and tension green, with lines from centre to centre
as thick as the force is large. A picture's file has the same bytes whenever it is drawn from the same numbers.
"""

import math
import os
import textwrap
from contextlib import contextmanager

import matplotlib
import numpy as np
from matplotlib import style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PatchCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Rectangle

from capfrac.errors import CaseError
from capfrac.results.snapshot import WALL_AXIS, WALL_NAMES

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
#: Forces are drawn to scale up to this percentile of their magnitudes, which is as thick as this share of the mean
#: radius.
FORCE_PERCENTILE, FORCE_WIDTH = 95, 0.4
#: Forces above this multiple of that percentile are drawn no thicker: one crack tip must not hide its neighbours.
FORCE_LIMIT = 2.0
_RESOLUTION = 220  # dots per inch


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


def quantity(value, unit, digits=3):
    """A number with an SI prefix, for people: ``quantity(1.5e5, "Pa")`` is "150 kPa"."""
    prefixes = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}
    if not math.isfinite(value) or value == 0:
        return f"{value:g} {unit}"
    # Round first: 999.9 of one prefix is 1 of the next.
    value = float(f"{value:.{digits}g}")
    power = min(max(3 * math.floor(math.log10(abs(value)) / 3 + 1e-12), -12), 9)
    return f"{value / 10.0**power:.{digits}g} {prefixes[power]}{unit}"


def prefix(highest, unit):
    """The power of a thousand that makes ``highest`` a number from 1 to 1000, and the unit with its prefix."""
    if not highest > 0:
        return 1.0, unit
    power = min(max(3 * math.floor(math.log10(highest) / 3 + 1e-12), -9), 6)
    return 10.0**power, {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M"}[power] + unit


def saySo(axes, text):
    """Say in a panel why it is empty."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", fontsize=8, color="0.45")
    axes.set_yticks([])
    axes.minorticks_off()


def putLegend(axes, *others):
    """A legend of what the axes (and others over them) hold, where it hides least; none where they hold nothing."""
    keys = [key for each in (axes, *others) for key in each.get_legend_handles_labels()[0]]
    if keys:
        axes.legend(handles=keys, fontsize=7, framealpha=0.8, edgecolor="none", borderpad=0.2, loc="best")


def fitSample(s, width):
    """Inches per metre, and the size of a sample's picture [inches]: ``width`` wide, but at most twice as high."""
    across, up = s.box[1] - s.box[0], s.box[3] - s.box[2]
    scale = min(width / across, 2 * width / up)
    return scale, scale * across, scale * up


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
        figure.legend(
            handles=handles,
            ncol=columns,
            loc="lower left",
            bbox_to_anchor=(rim / total[0], 0.05 / total[1]),
            fontsize=7,
            frameon=False,
            borderaxespad=0,
            borderpad=0,
            handlelength=1.5,
            columnspacing=1.3,
            handletextpad=0.5,
            labelspacing=0.35,
        )
        saveFigure(figure, path)


def stateOf(snapshot):
    """Pressure and saturation of a snapshot, as a title."""
    return f"$P_c$ = {quantity(snapshot.capillaryPressure, 'Pa')},   $S_g$ = {snapshot.gasSaturation:.2f}"


def _drawSample(axes, s, points, forces, bonds, dots, scale):
    """``points`` per metre turn lengths of the sample into widths of lines; ``scale`` [N] is the standard force."""
    left, right, bottom, top = s.box
    radius = float(np.mean(s.r)) * points if len(s.r) else 1.0

    gas = np.flatnonzero(s.gasCells)
    # Outlines of their own colour close the hairlines that antialiasing leaves between neighbouring cells.
    axes.add_collection(
        PolyCollection(
            [s.polygon(c) for c in gas], facecolors=COLOURS["gas"], edgecolors=COLOURS["gas"], linewidths=0.5, zorder=1
        )
    )
    colours = np.where(s.rattler, COLOURS["rattler"], COLOURS["grain"])
    grains = [Circle(centre, r) for centre, r in zip(np.column_stack([s.x, s.y]), s.r)]
    axes.add_collection(
        PatchCollection(
            grains,
            facecolors=list(colours),
            edgecolors=COLOURS["outline"],
            zorder=2,
            linewidths=min(0.6, 0.06 * radius),
        )
    )
    if dots and len(gas):
        centres, clearances = _gasDots(s, gas)
        spots = [Circle(centre, r) for centre, r in zip(centres, np.minimum(0.6 * clearances, 0.3 * np.mean(s.r)))]
        axes.add_collection(PatchCollection(spots, facecolors=COLOURS["dot"], linewidths=0, zorder=3))
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
    axes.add_patch(
        Rectangle(
            (left, bottom),
            right - left,
            top - bottom,
            fill=False,
            edgecolor=COLOURS["wall"],
            linewidth=1.2,
            zorder=7,
            clip_on=False,
        )
    )
    drawInlet(axes, s, points)
    axes.set(xlim=(left, right), ylim=(bottom, top))
    axes.set_axis_off()


def _strokeWidth(radius):
    return min(max(0.16 * radius, 0.7), 2.0)


def _gasDots(s, gas):
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
            if any(
                np.any(sign * t.normalForce > 0.02 * scale) for t, scale in zip(snapshots, scales)
            ):  # else no one could see it
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


def titleOf(title, width, size=10):
    """A title for a figure ``width`` inches wide: its text, in as many lines as needed (up to 3), and the height
    [inches].
    """
    if not title:
        return "", 0.0
    # 0.6 of the size is the mean width of a letter, with room to spare.
    lines = textwrap.wrap(title, max(10, int((width - 0.3) * 72 / (0.56 * size))), max_lines=3, placeholder=" …")
    return "\n".join(lines), 0.14 + len(lines) * 1.25 * size / 72


def putTitle(figure, text, size=10):
    """Put what :func:`titleOf` gave above a figure."""
    if text:
        figure.suptitle(text, fontsize=size, y=1 - 0.05 / figure.get_figheight(), va="top")


@contextmanager
def newFigure(size):
    """An empty figure in matplotlib's own style: the user's matplotlibrc must not change the pictures."""
    with style.context("default"), matplotlib.rc_context(
        {"svg.hashsalt": "capfrac", "font.size": 9, "pdf.fonttype": 42}
    ):
        figure = Figure(figsize=size, dpi=_RESOLUTION)
        FigureCanvasAgg(figure)
        yield figure


def saveFigure(figure, path):
    """Without the date and the versions that matplotlib would put into the file."""
    kind = os.path.splitext(str(path))[1].lower()
    metadata = {
        ".png": {"Software": None},
        ".pdf": {"CreationDate": None, "Producer": None, "Creator": None},
        ".svg": {"Date": None, "Creator": None},
    }
    if kind not in metadata:
        raise CaseError(f"the picture {path} would be of kind '{kind}', allowed: .png, .pdf, .svg")
    figure.savefig(path, metadata=metadata[kind])
