# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of invasion percolation in rigid networks."""

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from capfrac.lab.figures import tidy
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.run import rigid

#: Width and height of the network that is shown.
_SHOWN = 256
_TRAPPED = "#e9b44c"
_KINDS = (("free", "without trapping", COLOURS["dot"]), ("trapping", "with trapping", COLOURS["compression"]))
_MARKS = {"square": ("o", "square lattice"), "delaunay": ("^", "Delaunay triangulation")}


def drawPercolation(found, path, seed=1):
    """Draw the results of :func:`capfrac.verification.percolation.percolation` to ``path`` (.png, .pdf or .svg).

    Above the gas at breakthrough in one square lattice without and with trapping; below mass and saturation against the
    width of the networks, with error bars of two standard errors and the fitted powers.
    """
    with newFigure((7.2, 8.1)) as figure:
        for k, (kind, label, _) in enumerate(_KINDS):
            axes = figure.add_axes([0.06 + 0.475 * k, 0.54, 0.46, 0.409])
            _drawCluster(axes, kind == "trapping", seed)
            axes.set_title(f"{'ab'[k]})  {label}", fontsize=9, loc="left")
        figure.legend(
            handles=[
                Patch(color=COLOURS["dot"], label="gas"),
                Patch(facecolor="white", edgecolor="0.6", linewidth=0.6, label="water"),
                Patch(color=_TRAPPED, label="trapped water"),
                Line2D([], [], color=COLOURS["inlet"], linewidth=3, label="inlet"),
            ],
            ncol=4,
            loc="center",
            bbox_to_anchor=(0.53, 0.513),
            fontsize=8,
            frameon=False,
            handlelength=1.4,
        )
        mass, saturation = figure.add_axes([0.085, 0.155, 0.395, 0.305]), figure.add_axes([0.595, 0.155, 0.385, 0.305])
        _drawScaling(mass, found, "mass", "gas-filled pores in $L \\times L$, $M$", "c)  $M \\sim L^D$")
        _drawScaling(saturation, found, "saturation", "gas saturation at breakthrough, $S$", "d)  $S \\sim L^{D-2}$")
        figure.legend(
            handles=_handles(found),
            ncol=2,
            loc="lower center",
            bbox_to_anchor=(0.53, 0.0),
            fontsize=8,
            frameon=False,
            handlelength=2.6,
            labelspacing=0.6,
            columnspacing=3,
        )
        tidy(figure)
        for axes in figure.axes[:2]:
            for side in axes.spines.values():
                side.set(visible=True, linewidth=0.8)
        saveFigure(figure, path)


def _drawCluster(axes, trapping, seed):
    network = rigid.squareLattice(_SHOWN, _SHOWN, seed)
    drainage = rigid.drain(network, trapping=trapping)
    image = np.zeros(_SHOWN * _SHOWN + 1)
    image[drainage.pores] = 1
    image[drainage.trapped] = 2
    axes.imshow(
        image[:-1].reshape(_SHOWN, _SHOWN),
        cmap=ListedColormap(["white", COLOURS["dot"], _TRAPPED]),
        vmin=0,
        vmax=2,
        origin="lower",
        interpolation="nearest",
        extent=(0, _SHOWN, 0, _SHOWN),
    )
    axes.plot([0, _SHOWN], [-2.5, -2.5], color=COLOURS["inlet"], linewidth=3, solid_capstyle="butt", clip_on=False)
    axes.set(xticks=[], yticks=[], xlim=(0, _SHOWN), ylim=(0, _SHOWN))
    axes.text(
        0.99,
        1.015,
        f"{_SHOWN} $\\times$ {_SHOWN} pores, $S$ = {drainage.saturation:.2f}",
        transform=axes.transAxes,
        ha="right",
        va="bottom",
        fontsize=8,
        color="0.35",
    )


def _drawScaling(axes, found, name, label, title):
    dimension = "dimension" if name == "mass" else "fromSaturation"
    for network, (mark, _) in _MARKS.items():
        for kind, _, colour in _KINDS if network in found else ():
            one = found[network][kind]
            x, y, error = np.array(one["sizes"]), np.array(one[name]), np.array(one[f"{name}Error"])
            slope = one[dimension] - (0 if name == "mass" else 2)
            weight = (y / error) ** 2
            line = np.exp(np.sum(weight * (np.log(y) - slope * np.log(x))) / np.sum(weight)) * x**slope
            axes.plot(
                x, line, color=colour, linewidth=1.1, linestyle="-" if network == "square" else (0, (4, 2)), zorder=1
            )
            axes.errorbar(
                x,
                y,
                yerr=2 * error,
                color=colour,
                marker=mark,
                markersize=4.5,
                markerfacecolor=colour if network == "square" else "white",
                linestyle="none",
                elinewidth=0.9,
                capsize=2,
                zorder=2,
            )
    axes.set(xscale="log", yscale="log", xlabel="width of the network $L$ [pores]")
    axes.set_ylabel(label)
    widths = sorted({size for network in _MARKS if network in found for size in found[network]["free"]["sizes"]})
    axes.set_xticks(widths, [str(w) for w in widths])
    axes.minorticks_off()
    if name == "saturation":
        low, high = axes.get_ylim()
        ticks = [t for t in (0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0) if low <= t <= high]
        axes.set_yticks(ticks, [f"{t:g}" for t in ticks])
    axes.set_title(title, fontsize=9, loc="left")


def _handles(found):
    """The curves of both panels, with what each says of D."""
    handles = []
    for network, (mark, networkLabel) in _MARKS.items():
        for kind, kindLabel, colour in _KINDS if network in found else ():
            one = found[network][kind]
            handles.append(
                Line2D(
                    [],
                    [],
                    color=colour,
                    marker=mark,
                    markersize=4.5,
                    markerfacecolor=colour if network == "square" else "white",
                    linewidth=1.1,
                    linestyle="-" if network == "square" else (0, (4, 2)),
                    label=(
                        f"{networkLabel}, {kindLabel}:\n$D$ = {_rounded(one, 'dimension')} (c),"
                        f" {_rounded(one, 'fromSaturation')} (d)"
                    ),
                )
            )
    return handles


def _rounded(one, name):
    error = one[f"{name}Error"]
    return f"{one[name]:.3f} $\\pm$ {error:.3f}"
