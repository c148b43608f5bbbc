# SPDX-License-Identifier: GPL-2.0-or-later
"""The smoothed effective stress around a fracture."""

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from capfrac.plot.figures import stateOf
from capfrac.plot.painter import COLOURS, drawCells, fitSample
from capfrac.plot.sheet import newFigure, saveFigure, titleOf
from capfrac.results.fracture import stress
from capfrac.units import prefix

#: Colours of stress: brown compression and green tension, as the contact forces.
STRESSES = "BrBG_r"


def drawStress(fields, path, smoothing=stress.SMOOTHING, titles=None):
    """The smoothed effective stress in snapshots side by side: its mean as colour, the larger principal one as strokes.

    ``fields``: pairs (Snapshot, GrainStress). Strokes are as long as the difference of the principal stresses is large.
    One scale for all.
    """
    grids = [_stressGrid(shot, grains, smoothing) for shot, grains in fields]
    means = np.concatenate([0.5 * (g["fine"][0] + g["fine"][1]).ravel() for g in grids])
    largest = float(np.percentile(np.abs(means), 99)) or 1.0
    deviator = max(float(np.percentile(g["coarse"][0] - g["coarse"][1], 95)) for g in grids) or 1.0
    width, rim = 3.6, 0.2
    sizes = [fitSample(shot, width)[1:] for shot, _ in fields]
    names = [titleOf(titles[k] if titles else stateOf(shot), width, 9) for k, (shot, _) in enumerate(fields)]
    keys = [
        Line2D([], [], color="0.15", linewidth=0.8, label="direction of the larger principal stress"),
        *([Patch(color=COLOURS["gas"], label="gas")] if any(np.any(shot.gasCells) for shot, _ in fields) else []),
    ]
    foot = 0.8 + 0.16 * len(keys)
    head = max(high for _, high in names)
    total = np.array([len(fields) * (width + rim) + rim, foot + max(up for _, up in sizes) + head + 0.05])
    with newFigure(total) as figure:
        for k, ((shot, _), g, (across, up), (text, _)) in enumerate(zip(fields, grids, sizes, names)):
            left = rim + k * (width + rim) + 0.5 * (width - across)
            axes = figure.add_axes([left / total[0], foot / total[1], across / total[0], up / total[1]])
            image = axes.imshow(
                0.5 * (g["fine"][0] + g["fine"][1]),
                extent=shot.box,
                origin="lower",
                cmap=STRESSES,
                vmin=-largest,
                vmax=largest,
                interpolation="bilinear",
                aspect="auto",
            )
            _drawPrincipal(axes, g, deviator)
            drawCells(axes, [shot.polygon(c) for c in np.flatnonzero(shot.gasCells)], COLOURS["gas"])
            axes.set(xlim=shot.box[:2], ylim=shot.box[2:], xticks=[], yticks=[])
            figure.text(
                (left + 0.5 * across) / total[0],
                (foot + up + 0.06) / total[1],
                text,
                ha="center",
                va="bottom",
                fontsize=9,
            )
        middle = 0.5 * total[0]
        bar = figure.add_axes([(middle - 1.6) / total[0], (foot - 0.3) / total[1], 3.2 / total[0], 0.09 / total[1]])
        bar = figure.colorbar(image, cax=bar, orientation="horizontal")
        pascal, unit = prefix(largest, "Pa")
        bar.ax.xaxis.set_major_locator(MaxNLocator(6))
        bar.ax.xaxis.set_major_formatter(lambda value, _: f"{value / pascal:g}")
        bar.set_label(f"mean effective stress [{unit}], compression positive", fontsize=7.5)
        bar.ax.tick_params(labelsize=7)
        figure.legend(
            handles=keys,
            loc="lower center",
            bbox_to_anchor=(0.5, 0.05 / total[1]),
            fontsize=7,
            frameon=False,
            borderaxespad=0,
            borderpad=0,
            labelspacing=0.35,
        )
        saveFigure(figure, path)


def _stressGrid(shot, grains, smoothing):
    left, right, bottom, top = shot.box
    grids = {}
    for name, n in (("fine", 90), ("coarse", 18)):
        x = left + (right - left) * (np.arange(n) + 0.5) / n
        m = max(2, round(n * (top - bottom) / (right - left)))
        y = bottom + (top - bottom) * (np.arange(m) + 0.5) / m
        points = np.column_stack([a.ravel() for a in np.meshgrid(x, y)])
        values = stress.principal(stress.smoothField(grains, points, smoothing))
        grids[name] = tuple(v.reshape(m, n) for v in values)
        grids[name + "Points"] = points
    return grids


def _drawPrincipal(axes, g, deviator):
    points, (first, second, angle) = g["coarsePoints"], (v.ravel() for v in g["coarse"])
    spacing = float(np.ptp(points[:, 0])) / 17
    half = (
        0.45
        * spacing
        * np.minimum((first - second) / deviator, 1.2)[:, None]
        * np.column_stack([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    )
    axes.add_collection(LineCollection(np.stack([points - half, points + half], axis=1), colors="0.15", linewidths=0.8))
