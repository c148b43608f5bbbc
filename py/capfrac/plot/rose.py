# SPDX-License-Identifier: GPL-2.0-or-later
"""Roses of axial directions."""

import numpy as np

from capfrac.plot.painter import COLOURS
from capfrac.results.fracture import orientation


def drawRose(axes, angles, lengths, sectors=12):
    """A rose of axial directions on polar axes: length of fracture in each sector, drawn on both sides; the mean
    direction as a line.
    """
    edges, sums = orientation.rose(angles, lengths, sectors)
    axes.set_xticks(np.radians([0, 90, 180, 270]), ["", "V", "H", ""], fontsize=8)
    axes.set_yticks([])
    axes.spines["polar"].set_color("0.7")
    if not sums.sum() > 0:
        return
    share = np.sqrt(sums / sums.sum())  # the area of a sector, not its radius, is its share
    for turn in (0, 180):
        axes.bar(
            np.radians(edges[:-1] + turn),
            share,
            width=np.radians(180 / sectors),
            align="edge",
            color=COLOURS["gas"],
            edgecolor=COLOURS["dot"],
            linewidth=0.6,
        )
    mean, resultant = orientation.axialMean(orientation.orientationVector(angles, lengths))
    length = resultant * axes.get_ylim()[1]
    for turn, label in ((0, "mean direction"), (180, None)):
        axes.plot(np.radians([mean + turn] * 2), [0, length], color=COLOURS["broken"], linewidth=1.8, label=label)
    axes.set_title(f"mean {mean:.0f}°, resultant {resultant:.2f}", fontsize=8)
    axes.legend(fontsize=7, frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.06), borderaxespad=0)
