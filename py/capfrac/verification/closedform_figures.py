# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of the engine against closed forms: formulas as lines, the engine as marks."""

import math
import re

import numpy as np

from capfrac.lab.diffusion_figures import _HOLLOW
from capfrac.lab.figures import CYCLE, tidy
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.verification.lattices import conductance, pulseProfile


def drawClosedForms(result, path):
    """All of :func:`capfrac.verification.closedforms.checkClosedForms` on a page: formulas as lines, the engine as
    marks.
    """
    with newFigure((11.6, 6.2)) as figure:
        grid = {"left": 0.05, "right": 0.99, "bottom": 0.095, "top": 0.945, "wspace": 0.36, "hspace": 0.36}
        panels = figure.subplots(2, 4, gridspec_kw=grid).flat
        drawn = (
            ("two pores, a column between them", _drawDecay),
            ("two pores: order in time", _drawOrderInTime),
            ("throats in series", _drawSeries),
            ("in parallel: columns of radii", _drawParallel),
            ("lattices", _drawLattices),
            ("pressure set at an end", _drawPulse),
            ("the same: order in spacing", _drawOrderInSpacing),
            ("the same in other units", _drawUnits),
        )
        for axes, (title, draw) in zip(panels, drawn):
            draw(axes, result)
            axes.set_title(title, fontsize=9)
        tidy(figure)
        for axes in figure.axes:
            axes.xaxis.label.set_size(8)
            axes.yaxis.label.set_size(8)
        saveFigure(figure, path)


def _drawDecay(axes, result):
    time = np.linspace(0, 3, 200)
    axes.plot(time, np.exp(-time), color=COLOURS["dot"], linewidth=1.2, label="exp($-t/T$)")
    steps = np.arange(1, 31) / 10
    for scheme, marker, colour in (("implicit", "o", COLOURS["compression"]), ("explicit", "s", COLOURS["tension"])):
        axes.plot(
            steps,
            result["twoPores"][scheme]["curve"],
            color=colour,
            **{**_HOLLOW, "marker": marker},
            label=f"{scheme}, $\\Delta t = T/10$",
        )
    axes.set(
        xlabel="time $t/T$,  $1/T = G K_f (1/V_1 + 1/V_2)$",
        ylabel="$(p_1 - p_2)$ / first value",
        xlim=(0, 3),
        ylim=(0, 1),
    )
    axes.legend(fontsize=7, frameon=False)


def _drawOrderInTime(axes, result):
    found = result["twoPores"]
    steps = np.array(found["steps"], dtype=float)
    axes.loglog(1 / steps, 0.5 / math.e / steps, color=COLOURS["dot"], linewidth=1.2, label="$\\Delta t/(2 e T)$")
    for scheme, marker, colour in (("implicit", "o", COLOURS["compression"]), ("explicit", "s", COLOURS["tension"])):
        label = f"{scheme}: order {found[scheme]['orders'][-1]:.3f}"
        axes.loglog(1 / steps, found[scheme]["errors"], color=colour, **{**_HOLLOW, "marker": marker}, label=label)
    axes.set(xlabel="step $\\Delta t/T$", ylabel="error at $t = T$ / first value")
    axes.legend(fontsize=7, frameon=False)


def _drawSeries(axes, result):
    for found, colour in zip(result["network"]["series"], (COLOURS["dot"], COLOURS["compression"])):
        edges = np.array([0, *found["columns"], found["width"]]) / found["width"]
        axes.stairs(found["expected"], edges, baseline=None, color=colour, linewidth=1.2)
        label = f"{found['name']}: {abs(found['flow'] / found['expectedFlow'] - 1):.0e}"
        axes.plot(np.array(found["place"]) / found["width"], found["pressure"], color=colour, **_HOLLOW, label=label)
    axes.set(xlabel="place / width of the box", ylabel="pressure / whole difference", xlim=(0, 1), ylim=(-0.03, 1.03))
    axes.legend(fontsize=7, frameon=False, title="error of the flow", title_fontsize=7)


def _drawParallel(axes, result):
    found = result["network"]["parallel"]
    unit = found[0]["expectedFlow"]
    numbers = np.arange(len(found))
    axes.vlines(
        [one["expectedFlow"] / unit for one in found], numbers - 0.3, numbers + 0.3, color=COLOURS["dot"], linewidth=1.4
    )
    axes.plot([one["flow"] / unit for one in found], numbers, color=COLOURS["compression"], **_HOLLOW)
    axes.set(xlabel="flow / flow of the first", xscale="log", ylim=(len(found) - 0.4, -0.6))
    axes.set_yticks(numbers, labels=["-".join(map(str, one["radii"])) for one in found])
    axes.text(
        0.97,
        0.95,
        f"error of the flow: {result['network']['errors']['parallel']:.0e}",
        transform=axes.transAxes,
        va="top",
        ha="right",
        fontsize=7,
    )


def _drawLattices(axes, result):
    found = result["lattices"]
    gaps = np.linspace(min(found["gaps"]), max(found["gaps"]), 200)
    axes.semilogy(
        gaps,
        [1e3 * conductance(2 * g, 1.0, 1.0) / (2 + 2 * g) for g in gaps],
        color=COLOURS["dot"],
        linewidth=1.2,
        label="$\\mu C/(a w r^2)$",
    )
    kinds = (
        ("square", "squares", "s", 6.5, COLOURS["compression"]),
        ("triangular", "triangles, along rows", "^", 4, COLOURS["tension"]),
        ("across", "triangles, across", "x", 4, COLOURS["broken"]),
    )
    for name, label, marker, size, colour in kinds:
        axes.semilogy(
            found["gaps"],
            1e3 * np.array(found[name]),
            linestyle="none",
            marker=marker,
            markersize=size,
            color=colour,
            markerfacecolor="none",
            label=f"{label}: {found['errors'][name]:.0e}",
        )
    axes.set(xlabel="gap / diameter (overlap: < 0)", ylabel="permeability $1000\\,k/r^2$")
    axes.set_yticks([1, 2, 5, 10, 20], labels=["1", "2", "5", "10", "20"])
    axes.minorticks_off()
    axes.legend(
        fontsize=7,
        frameon=False,
        title="largest error",
        title_fontsize=7,
        loc="lower right",
        bbox_to_anchor=(1.04, -0.02),
        handletextpad=0.2,
        handlelength=1.3,
    )


def _drawPulse(axes, result):
    run = result["pulse"]["runs"][-2]
    whole = run["profiles"][-1]["length"]
    x = np.linspace(0, 2 * whole, 300)
    for profile, colour in zip(run["profiles"], (COLOURS["dot"], COLOURS["compression"], COLOURS["tension"])):
        axes.plot(x / whole, pulseProfile(x, profile["length"]), color=colour, linewidth=1.2)
        label = f"$\\sqrt{{4Dt}}$ = {profile['length'] / whole:g} $\\ell$"
        axes.plot(
            np.array(profile["x"]) / whole,
            profile["pressure"],
            color=colour,
            **{**_HOLLOW, "markersize": 2.8},
            label=label,
        )
    axes.set(xlabel="distance $x/\\ell$", ylabel="$(p - p_0)/(p_1 - p_0)$", xlim=(0, 2), ylim=(-0.02, 1.02))
    axes.legend(
        fontsize=7,
        frameon=False,
        title=f"lines: erfc($x/\\sqrt{{4Dt}}$); pores {run['spacing'] / whole:g} $\\ell$ apart",
        title_fontsize=7,
    )


def _drawOrderInSpacing(axes, result):
    found = result["pulse"]
    for name, label, line in (
        ("predicted", "leading error, derived", {"color": COLOURS["dot"], "linewidth": 1.2}),
        ("error", f"engine: order {found['orders'][-1]:.3f}", {"color": COLOURS["compression"], **_HOLLOW}),
    ):
        axes.loglog(found["spacings"], [run[name] for run in found["runs"]], label=label, **line)
    axes.set(xlabel="spacing $a/\\ell$", ylabel="largest error at $\\sqrt{4Dt} = \\ell$")
    axes.set_xticks(found["spacings"], labels=[f"{s:g}" for s in found["spacings"]])
    axes.minorticks_off()
    axes.legend(fontsize=7, frameon=False)


def _drawUnits(axes, result):
    found, least = result["units"], 1e-17
    systems = list(next(iter(found.values()))["differences"])
    for colour, marker, (problem, one) in zip(CYCLE, "osv^", found.items()):
        values = [one["differences"][system] for system in systems]
        axes.semilogy(
            range(len(systems)), np.maximum(values, least), color=colour, **{**_HOLLOW, "marker": marker}, label=problem
        )
    axes.set(xticks=range(len(systems)), ylabel="difference from SI / largest value", ylim=(0.2 * least, 1e-1))
    axes.set_xticklabels([re.sub(r"2\^(-?\d+)", r"$2^{\1}$", name).replace(", ", "\n") for name in systems], fontsize=7)
    ticks = [least, 1e-12, 1e-8, 1e-4]
    axes.set_yticks(ticks, labels=["0: same\nbits", *(f"$10^{{{round(math.log10(t))}}}$" for t in ticks[1:])])
    axes.minorticks_off()
    axes.legend(fontsize=7, frameon=False, ncol=2, loc="upper left")
