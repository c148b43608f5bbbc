# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of an undrained compaction: Figure 13."""

import numpy as np

from capfrac.lab.figures import pressureUnit, tidy
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure


def drawUndrained(result, path):
    """Total, dry and effective stress and the water's pressure against strain (Figure 13); compressible grains in a
    panel of their own.
    """
    panels = [(result, "rigid grains")] + (
        [(result["compressible"], "grains that water compresses")] if "compressible" in result else []
    )
    pascal, unit = pressureUnit(max(result["total"]))
    with newFigure((5.2 if len(panels) == 1 else 8.6, 3.5)) as figure:
        for number, (one, title) in enumerate(panels):
            axes = figure.add_axes(
                [0.14, 0.14, 0.83, 0.82] if len(panels) == 1 else [0.08 + 0.48 * number, 0.14, 0.42, 0.76]
            )
            for colour, name, label in (
                (COLOURS["dot"], "total", "total stress, sealed"),
                (COLOURS["gas"], "pressure", "pressure of the water"),
                (COLOURS["compression"], "dry", "stress, dry"),
                (
                    COLOURS["broken"],
                    "effective",
                    f"$\\sigma - b\\,p$, $b$ = {one['biot']:.3f} $\\pm$ {one['biotError']:.3f}",
                ),
            ):
                line = (
                    {"linestyle": "none", "marker": "o", "markersize": 3.5, "markerfacecolor": "white"}
                    if name == "effective"
                    else {"linewidth": 1.3}
                )
                axes.plot(
                    100 * np.array(one["strain"]),
                    np.array(one[name]) / pascal,
                    color=colour,
                    label=label,
                    **line,
                )
            axes.set(
                xlabel="vertical strain [%]",
                ylabel=f"stress [{unit}]" if number == 0 else "",
                xlim=(0, None),
                ylim=(0, 1.05 * max(result["total"]) / pascal),
            )
            if len(panels) > 1:
                axes.set_title(title, fontsize=9)
            axes.legend(fontsize=8, frameon=False)
        tidy(figure)
        saveFigure(figure, path)
