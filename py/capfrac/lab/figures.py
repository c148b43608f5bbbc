# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of laboratory tests: Figures 7 to 10 of Jain & Juanes (2008), Mohr circles, tables as curves.

Each function draws the result of a test (see the modules beside this one) to a file (.png, .pdf or .svg).
"""

import math

import numpy as np

from capfrac.lab import hydrate_ridge
from capfrac.plot import figures
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.units import prefix, quantity

#: One colour for each curve of a picture, then over again.
CYCLE = (
    COLOURS["dot"],
    COLOURS["compression"],
    COLOURS["tension"],
    COLOURS["broken"],
    COLOURS["gas"],
    COLOURS["outline"],
)

BAND = "#e4e0d2"


def tidy(figure):
    """Small labels, no frame on top and on the right."""
    for axes in figure.axes:
        axes.tick_params(labelsize=8)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)


def pressureUnit(highest):
    """Scale and unit for axes up to ``highest`` [Pa]: Pa, kPa or MPa."""
    return prefix(highest, "Pa", low=0)


def drawSettling(snapshots, path):
    """The settling process (Figure 7): snapshots side by side, with the time above each."""
    titles = [f"$t$ = {quantity(shot.time, 's')}" for shot in snapshots]
    figures.drawPair(snapshots, path, titles, width=1.9, dots=False, forceScale=figures.forceScaleOf(snapshots[-1]))


def drawTimeStep(result, path):
    """The time step while a sample settles (Figure 8), and the share of the grains that touch, against time."""
    table = result["table"]
    time = np.array(table["time [s]"])
    second, unit = prefix(time[-1], "s")
    with newFigure((5.4, 3.2)) as figure:
        axes = figure.add_axes([0.14, 0.16, 0.7, 0.76])
        axes.plot(
            time / second,
            np.array(table["timeStep [s]"]) / result["freeFall"],
            color=COLOURS["dot"],
            linewidth=1.4,
        )
        axes.axvline(result["settlingBegins"] / second, color="0.45", linewidth=0.9, linestyle=(0, (4, 3)))
        axes.text(
            result["settlingBegins"] / second,
            1.02,
            " free fall $\\leftarrow$ | $\\rightarrow$ settling",
            ha="center",
            va="bottom",
            fontsize=8,
            color="0.35",
        )
        axes.set(
            xlabel=f"time [{unit}]",
            ylabel=f"time step / {quantity(result['freeFall'], 's')}",
            ylim=(0, 1.1),
            xlim=(0, time[-1] / second),
        )
        share = axes.twinx()
        share.plot(
            time / second,
            table["shareTouching [-]"],
            color=COLOURS["compression"],
            linewidth=1.1,
            linestyle=(0, (2, 1.5)),
        )
        share.set(ylim=(0, 1.1))
        share.set_ylabel("share of grains with a contact", color=COLOURS["compression"])
        axes.yaxis.label.set_color(COLOURS["dot"])
        for each in (axes, share):
            each.tick_params(labelsize=8)
            each.spines["top"].set_visible(False)
        saveFigure(figure, path)


def drawScaling(result, path):
    """The time step against grain radius and stiffness with the fitted power laws (Figure 9)."""
    with newFigure((7.2, 3.2)) as figure:
        panels = figure.subplots(
            1, 2, gridspec_kw={"left": 0.1, "right": 0.98, "bottom": 0.16, "top": 0.93, "wspace": 0.3}
        )
        for axes, name, label in zip(
            panels, ("radius", "stiffness"), ("smallest radius [m]", "normal stiffness $k_n$ [N/m]")
        ):
            found = result[name]
            x, y = np.array(found["x"]), np.array(found["timeStep"])
            ends = np.array([x.min(), x.max()])
            line = math.exp(np.mean(np.log(y)) - found["exponent"] * np.mean(np.log(x))) * ends ** found["exponent"]
            axes.loglog(ends, line, color=COLOURS["compression"], linewidth=1.2, zorder=1)
            axes.loglog(x, y, linestyle="none", marker="o", markersize=4, color=COLOURS["dot"], zorder=2)
            axes.set(xlabel=label, ylabel="time step [s]")
            axes.text(
                0.5,
                0.93,
                f"exponent {found['exponent']:.4f} $\\pm$ {found['error']:.4f}",
                transform=axes.transAxes,
                ha="center",
                fontsize=9,
            )
        tidy(figure)
        saveFigure(figure, path)


def drawCompaction(found, path, title=None):
    """Stress against strain, and void ratio against log stress, of a compaction (a dict) with its loops (Figure 10)."""
    table = found["table"]
    strain, stress, void = (np.array(table[name]) for name in ("strain [-]", "stressV [Pa]", "voidRatioUsed [-]"))
    pascal, unit = pressureUnit(stress.max())
    with newFigure((7.6, 3.3)) as figure:
        curve, log = figure.subplots(
            1,
            2,
            gridspec_kw={"left": 0.09, "right": 0.985, "bottom": 0.155, "top": 0.9 if title else 0.96, "wspace": 0.28},
        )
        curve.plot(100 * strain, stress / pascal, color=COLOURS["dot"], linewidth=1.2)
        curve.set(xlabel="vertical strain [%]", ylabel=f"vertical stress [{unit}]", xlim=(0, None), ylim=(0, None))
        log.semilogx(stress, void, color=COLOURS["dot"], linewidth=1.2)
        log.set(xlabel="vertical stress [Pa]", ylabel="void ratio")
        if math.isfinite(found["Cc"]):
            at = np.array([found["fitFrom"], found["fitTo"]])
            virgin = np.array([branch == "virgin" for branch in table["branch"]])
            order = np.argsort(stress[virgin])
            middle = np.interp(
                math.log10(math.sqrt(at[0] * at[1])), np.log10(stress[virgin][order]), void[virgin][order]
            )
            log.semilogx(
                at,
                middle - found["Cc"] * (np.log10(at) - np.log10(at).mean()),
                color=COLOURS["broken"],
                linewidth=1.2,
                linestyle=(0, (4, 2)),
                label=f"$C_c$ = {found['Cc']:.3f}",
            )
        for number, loop in enumerate(found["loops"]):
            log.plot([], [], linestyle="none", label=f"$C_r$ = {loop['Cr']:.3f} at {loop['strain']:.0%}")
        log.legend(fontsize=7, frameon=False, loc="lower left", handlelength=1.6)
        tidy(figure)
        if title:
            figure.suptitle(title, fontsize=10, y=0.985)
        saveFigure(figure, path)


def drawHydrateRidge(result, path):
    """The compactions at the fitted stiffnesses, and their local C_c and C_r against the reported ranges
    (Figure 10).
    """
    highest = max(max(found["table"]["stressV [Pa]"]) for found in result["compactions"].values())
    pascal, unit = pressureUnit(highest)
    with newFigure((9.6, 3.7)) as figure:
        curve, slope, unloading = figure.subplots(
            1, 3, gridspec_kw={"left": 0.065, "right": 0.985, "bottom": 0.3, "top": 0.95, "wspace": 0.3}
        )
        for colour, (name, found) in zip(CYCLE, result["compactions"].items()):
            label = f"$k_n$ = {result['stiffness'][name]:.3g} N/m ($C_c$ = {result['Cc'][name]:.3f})"
            curve.plot(
                100 * np.array(found["table"]["strain [-]"]),
                np.array(found["table"]["stressV [Pa]"]) / pascal,
                color=colour,
                linewidth=1.1,
                label=label,
            )
            stress, index = hydrate_ridge.localIndex(found)
            slope.semilogx(stress, index, color=colour, linewidth=1.2)
            unloading.semilogx(
                [loop["stress"] for loop in found["loops"]],
                [loop["Cr"] for loop in found["loops"]],
                color=colour,
                linewidth=0.8,
                marker="o",
                markersize=4,
            )
        if result["laboratory"]:
            lab = result["laboratory"]
            curve.plot(
                100 * np.array(lab["strain"]),
                np.array(lab["stress"]) / pascal,
                color="black",
                linestyle="none",
                marker="s",
                markersize=3,
                label="laboratory (yours)",
            )
        for axes, (low, high, average), name in (
            (slope, result["reported"]["Cc"], "C_c"),
            (unloading, result["reported"]["Cr"], "C_r"),
        ):
            axes.axhspan(low, high, color=BAND, zorder=0, label=f"reported range, Site 1244: {low:g}-{high:g}")
            axes.axhline(
                average,
                color=COLOURS["outline"],
                linewidth=1,
                linestyle=(0, (4, 2)),
                zorder=1,
                label=f"reported average: {average:g}",
            )
            axes.set(
                xlabel="vertical stress [Pa]",
                ylabel=f"{'local ' if name == 'C_c' else ''}${name}$ of the model [-]",
                ylim=(0, None),
            )
        curve.set(xlabel="vertical strain [%]", ylabel=f"vertical stress [{unit}]", xlim=(0, None), ylim=(0, None))
        for axes in (curve, slope, unloading):
            axes.legend(fontsize=7, frameon=False, loc="upper left", bbox_to_anchor=(-0.08, -0.16))
        tidy(figure)
        saveFigure(figure, path)
