# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of viscous displacement."""

import numpy as np

from capfrac.plot.painter import COLOURS, drawCells, drawDisks
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.results.moment import GAS


def drawDisplacement(found, snapshots, path):
    """Draw what :func:`capfrac.lab.displacement.displacement` found to ``path`` (.png, .pdf or .svg): the sample at
    breakthrough in each corner.

    ``snapshots``: name of the corner -> :class:`~capfrac.snapshot.Snapshot`.
    """
    with newFigure((7.2, 3.05)) as figure:
        for k, (name, one) in enumerate(found.items()):
            axes = figure.add_axes([0.008 + 0.333 * k, 0.02, 0.318, 0.74])
            _drawGas(axes, snapshots[name])
            axes.set_title(
                (
                    f"{'abcdef'[k]})  {name}\nCa = {_power(one['capillaryNumber'])},  M = {one['viscosityRatio']:g}\n"
                    f"S = {one['saturation']:.2f},  roughness = {one['roughness']:.2f}"
                ),
                fontsize=8,
                loc="left",
            )
        saveFigure(figure, path)


def _power(value):
    exponent = int(np.floor(np.log10(value)))
    factor = value / 10.0**exponent
    return f"$10^{{{exponent}}}$" if abs(factor - 1) < 1e-9 else f"{factor:g}$\\cdot 10^{{{exponent}}}$"


def _drawGas(axes, s):
    corners = [s.polygonCorners[a:b] for a, b in zip(s.polygonOffsets, s.polygonOffsets[1:])]
    gas = [c for c, phase in zip(corners, s.cellPhase) if phase == GAS]
    drawCells(axes, gas, COLOURS["gas"], linewidth=0.3)
    drawDisks(axes, np.column_stack([s.x, s.y]), s.r, COLOURS["grain"], COLOURS["outline"], 0.2, zorder=1)
    left, right, bottom, top = s.box
    axes.plot([left, right], [bottom, bottom], color=COLOURS["inlet"], linewidth=3, solid_capstyle="butt")
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", xticks=[], yticks=[])
