# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of the toughness of bonded samples."""

import matplotlib.ticker
import numpy as np

from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.theory.lattice_crack import finiteWidth


def drawToughness(found, path):
    """Pressure against the length of the crack, lattice and samples, with LEFM (alpha = 1) and the fits; and as lines
    1/p against sqrt(a).
    """
    with newFigure((7.4, 3.3)) as figure:
        left, right = figure.subplots(
            1, 2, gridspec_kw={"left": 0.085, "right": 0.985, "bottom": 0.16, "top": 0.95, "wspace": 0.28}
        )
        sizes = []
        for name, colour, marker in (("lattice", COLOURS["dot"], "s"), ("samples", COLOURS["compression"], "o")):
            one = found[name]
            size = np.array(
                [t["halfLength"] / t["radius"] * finiteWidth(t["halfLength"], t["width"]) ** 2 for t in one["tests"]]
            )
            p = (np.array([t["pressure"] for t in one["tests"]]) - found["stress"]) / found["bondStrength"]
            sizes += list(size)
            label = {"lattice": "square lattice", "samples": "settled samples"}[name]
            left.plot(size, p, marker, color=colour, markersize=4.5, markerfacecolor="none", label=label)
            right.plot(np.sqrt(size), 1 / p, marker, color=colour, markersize=4.5, markerfacecolor="none")
            line = np.linspace(0.9 * size.min(), 1.1 * size.max(), 60)
            # Cracks of settled samples scatter too much to tell c from 0.
            alpha, c = (one["alpha"], one["c"]) if name == "lattice" else (one["alphaLEFM"], 0.0)
            inverse = np.sqrt(line / alpha) - c
            left.plot(line[inverse > 0], 1 / inverse[inverse > 0], color=colour, linewidth=1.0)
            right.plot(
                np.sqrt(line),
                inverse,
                color=colour,
                linewidth=1.0,
                label=f"{label}: $\\alpha$ = {alpha:.2f}, c = {c:.2g}",
            )
            if name == "lattice":
                left.plot(
                    size,
                    [(t["expected"] - found["stress"]) / found["bondStrength"] for t in one["tests"]],
                    "+",
                    color="black",
                    markersize=8,
                    label="linear lattice",
                )
        line = np.linspace(0.8 * min(sizes), 1.2 * max(sizes), 60)
        left.plot(line, line**-0.5, color="0.5", linestyle=(0, (4, 3)), linewidth=1.0, label="LEFM, $\\alpha$ = 1")
        right.plot(np.sqrt(line), np.sqrt(line), color="0.5", linestyle=(0, (4, 3)), linewidth=1.0)
        left.set(xscale="log", yscale="log", xlabel="$a f^2/r$", ylabel="$(P - \\sigma')/\\sigma_c$")
        right.set(xlabel="$\\sqrt{a f^2/r}$", ylabel="$\\sigma_c/(P - \\sigma')$", xlim=(0, None), ylim=(0, None))
        for axes in (left, right):
            axes.legend(fontsize=7, frameon=False)
            axes.tick_params(labelsize=8, which="both")
            for side in ("top", "right"):
                axes.spines[side].set_visible(False)
        plain = matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}")
        for axis in (left.xaxis, left.yaxis):
            axis.set_major_formatter(plain)
            axis.set_minor_formatter(
                matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}" if f"{value:e}"[0] in "25" else "")
            )
        saveFigure(figure, path)
