# SPDX-License-Identifier: GPL-2.0-or-later
"""The loops of pressure cycles, and maps of where the gas is."""

import numpy as np
from matplotlib.patches import Patch

from capfrac.plot.painter import COLOURS, drawCells, drawDisks
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.scene import sediment

_COLOURS_OF_CELLS = ("#ffffff", COLOURS["gas"], "#e8862e")  # water, gas, trapped gas

_COLOURS = {"drainage": "#1f5fa8", "imbibition": "#c7641b", "second drainage": "#3aa0d8"}


def cellMap(gas):
    """The cells as they are now, for :func:`drawCycle`: a dict of ``grains`` (x, y, r [m]), ``polygons`` and ``state``
    (0 water, 1 gas, 2 trapped gas).
    """
    cells = gas.cells()
    state = [0 if not phase else 2 if held else 1 for phase, held in zip(cells["phase"], cells["cutOff"])]
    grains = [(b.state.pos[0], b.state.pos[1], b.shape.radius) for b in sediment.grainBodies()]
    return {"grains": grains, "polygons": [list(map(tuple, polygon)) for polygon in cells["polygon"]], "state": state}


def drawCycle(tables, path, maps=()):
    """Draw the loops of several samples (the first one strong), and maps of where the gas is: (title, :func:`cellMap`)
    pairs, to ``path``.
    """
    width = 4.6 + 3.0 * len(maps)
    with newFigure((width, 4.4)) as figure:
        columns = figure.add_gridspec(
            1,
            1 + len(maps),
            width_ratios=[1.4] + [1] * len(maps),
            left=0.6 / width,
            right=0.995,
            bottom=0.24,
            top=0.92,
            wspace=0.06 if maps else None,
        )
        _drawLoops(figure.add_subplot(columns[0]), tables)
        for column, (title, one) in enumerate(maps, start=1):
            _drawMap(figure.add_subplot(columns[column]), title, one, legend=column == 1)
        saveFigure(figure, path)


def _drawLoops(axes, tables):
    for number, table in reversed(list(enumerate(tables))):
        for name in dict.fromkeys(table["stage"]):
            rows = [k for k, stage in enumerate(table["stage"]) if stage == name]
            rows = ([rows[0] - 1] if rows[0] > 0 else []) + rows
            axes.plot(
                [table["gasSaturation"][k] for k in rows],
                [table["capillaryPressure"][k] for k in rows],
                color=_COLOURS.get(name, "#555555"),
                lw=2 if number == 0 else 0.8,
                alpha=1 if number == 0 else 0.35,
                label=name if number == 0 else None,
            )
    if len(tables) > 1:
        axes.plot([], [], color="#555555", lw=0.8, alpha=0.6, label="other samples, thin")
    table = tables[0]
    back = [k for k, stage in enumerate(table["stage"]) if stage == "imbibition"]
    axes.plot(
        [table["trappedGas"][k] for k in back],
        [table["capillaryPressure"][k] for k in back],
        color=_COLOURS["imbibition"],
        lw=1.3,
        ls=":",
        label="trapped, on imbibition",
    )
    axes.set(xlim=(0, 1), xlabel="gas saturation $S_g$ [-]", ylabel="capillary pressure $P_c$ [Pa]")
    axes.set_ylim(bottom=0)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=2, frameon=False, fontsize=8)


def _drawMap(axes, title, one, legend):
    colours = [_COLOURS_OF_CELLS[state] for state in one["state"]]
    drawCells(axes, one["polygons"], colours, linewidth=0.3)
    *places, radii = zip(*one["grains"])
    drawDisks(axes, zip(*places), radii, COLOURS["grain"], COLOURS["outline"], 0.4, zorder=1)
    corners = np.array([corner for polygon in one["polygons"] for corner in polygon])
    axes.set(
        xlim=(corners[:, 0].min(), corners[:, 0].max()),
        ylim=(corners[:, 1].min(), corners[:, 1].max()),
        xticks=[],
        yticks=[],
        aspect="equal",
    )
    axes.set_title(title, fontsize=9)
    if legend:
        names = zip(_COLOURS_OF_CELLS, ("water", "gas on the inlet", "trapped gas"))
        axes.legend(
            handles=[Patch(facecolor=colour, edgecolor=COLOURS["outline"], label=label) for colour, label in names],
            loc="upper left",
            bbox_to_anchor=(0, -0.04),
            ncol=3,
            frameon=False,
            fontsize=8,
        )
