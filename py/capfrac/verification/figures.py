# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of laboratory tests on grains and water that move together: Figure 13, consolidation, stability."""

import numpy as np

from capfrac.lab.figures import CYCLE, tidy
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure


def drawTerzaghi(result, path):
    """Degree of consolidation and pressure at the base against the time factor, with Terzaghi's solution."""
    T = np.array(result["T"])
    with newFigure((5.4, 3.4)) as figure:
        axes = figure.add_axes([0.12, 0.15, 0.85, 0.81])
        for colour, name, label in (
            (COLOURS["dot"], "degree", "degree of consolidation $U$"),
            (COLOURS["gas"], "pressure", "pressure at the base $/\\,p_0$"),
        ):
            axes.semilogx(T, result[f"{name}Expected"], color=colour, linewidth=1.2)
            axes.semilogx(
                T,
                result[name],
                color=colour,
                linestyle="none",
                marker="o",
                markersize=3.2,
                markerfacecolor="white",
                label=label,
            )
        axes.plot([], [], color="black", linewidth=1.2, label="Terzaghi")
        axes.set(xlabel="time factor $T = c\\,t/H^2$", xlim=(1e-3, T[-1]), ylim=(-0.05, 1.15))
        axes.legend(fontsize=8, frameon=False, loc="center left")
        tidy(figure)
        saveFigure(figure, path)


def drawMandel(result, path):
    """Pressure in the middle against the time factor, with Mandel's solution."""
    T = np.array(result["T"])
    with newFigure((5.4, 3.4)) as figure:
        axes = figure.add_axes([0.12, 0.15, 0.85, 0.81])
        axes.semilogx(
            T,
            result["pressureExpected"],
            color="black",
            linewidth=1.2,
            label=f"Mandel, peak {result['peakExpected']:.3f}",
        )
        axes.semilogx(
            T,
            np.array(result["pressure"]) / result["undrainedRatio"],
            color=COLOURS["gas"],
            linestyle="none",
            marker="o",
            markersize=3.2,
            markerfacecolor="white",
            label=f"pressure in the middle, peak {result['peak']:.3f}",
        )
        axes.axhline(1, color="0.6", linewidth=0.8, linestyle=(0, (4, 3)))
        axes.set(xlabel="time factor $T = c\\,t/a^2$", ylabel="pressure / undrained pressure", xlim=(T[0], T[-1]))
        axes.legend(fontsize=8, frameon=False, loc="lower left")
        tidy(figure)
        saveFigure(figure, path)


def drawStability(result, path):
    """Energy of shaken samples, and flips and the water's books of stirred ones, against the number of steps."""
    with newFigure((8.6, 3.4)) as figure:
        energy, books = figure.add_axes([0.075, 0.15, 0.4, 0.81]), figure.add_axes([0.56, 0.15, 0.37, 0.81])
        for colour, (name, one) in zip(CYCLE * 3, result["shake"].items()):
            end = "" if one["end"] == "bounded" else f": ended in step {one['stepsDone']}"
            steps, height = np.maximum(one["steps"], 1), np.maximum(one["energy"], 1e-4)
            energy.plot(
                steps,
                height,
                color=colour,
                linewidth=1.2,
                marker="x" if end else None,
                linestyle=(0, (2, 1.5)) if end else "-",
                label=name + end,
            )
        energy.set(
            xlabel="time steps",
            ylabel="energy / energy at the start",
            xscale="log",
            yscale="log",
            xlim=(1, None),
            ylim=(1e-2, None),
        )
        energy.legend(fontsize=7, frameon=False)
        flips = books.twinx()
        for colour, (name, one) in zip(CYCLE, result["stir"].items()):
            books.semilogy(
                one["steps"],
                np.maximum(one["ledger"], 1e-17),
                color=colour,
                linewidth=1.2,
                label=f"{name}: error of the mass",
            )
            flips.plot(
                one["steps"], one["flips"], color=colour, linewidth=1.0, linestyle=(0, (4, 2)), label=f"{name}: flips"
            )
        books.axhline(1e-10, color="0.6", linewidth=0.8)
        books.set(xlabel="time steps", ylabel="error of the water's mass, relative", ylim=(1e-17, 1e-9))
        flips.set(ylabel="flips", ylim=(0, None))
        lines = [line for axes in (books, flips) for line in axes.get_lines() if not line.get_label().startswith("_")]
        books.legend(lines, [line.get_label() for line in lines], fontsize=7, frameon=False, loc="upper left")
        for axes in (energy, books, flips):
            axes.tick_params(labelsize=8)
            axes.spines["top"].set_visible(False)
        saveFigure(figure, path)
