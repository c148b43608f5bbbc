# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of the regime map, drawn from the table of its sweep alone."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.sweep import regime_map
from capfrac.theory import regime

#: Colours that people with any kind of colour vision can tell apart (Okabe & Ito), each with a shape of its own.
MODES = {"capillary": ("#0072b2", "o"), "mixed": ("#e69f00", "D"), "fracture": ("#d55e00", "^"), "none": ("0.6", "x")}
COHESIONS = ("#000000", "#009e73", "#cc79a7", "#56b4e9")
BAND = "#dcd6c4"
#: Half-lengths of flaws over mean radius between which the theory is drawn as a band [-].
FLAWS = (5, 50)


def drawRegimeMap(rows, path):
    """One panel for each cohesion: the mode of each run over mean grain radius and horizontal effective stress, with r*
    and its exponent.

    Samples of the same parameters stand above each other (a shift, not another stress). Line and band: r* by theory,
    for the inlet of the runs and for flaws of ``FLAWS``. Bars: between the coarsest size up to which all runs fracture
    and the finest from which on none does; on them r* by the modes, and by the displacement of the grains (see
    :func:`capfrac.sweep.regime_map.changes`), whose exponent is printed. ``rows`` as of
    :func:`capfrac.sweep.regime_map.read`.
    """
    cohesions = sorted({row["cohesion.chi [-]"] for row in rows})
    found = regime_map.changes(rows)
    fits = regime_map.laws(found)
    radii, stresses = np.array([row["rMean [m]"] for row in rows]), np.array(
        [row["stress.horizontal [Pa]"] for row in rows]
    )
    seeds = sorted({row["grains.seed [-]"] for row in rows})
    limits = radii.min() / 2.2, radii.max() * 2.2
    sigma = np.geomspace(stresses.min() / 3, stresses.max() * 3, 200)
    gamma = float(np.median(stresses * radii / [row["stressNumber [-]"] for row in rows]))
    with newFigure((3.1 * len(cohesions) + 0.7, 4.3)) as figure:
        panels = figure.subplots(
            1,
            len(cohesions),
            sharey=True,
            squeeze=False,
            gridspec_kw={
                "left": 0.62 / (3.1 * len(cohesions) + 0.7) + 0.01,
                "right": 0.985,
                "bottom": 0.295,
                "top": 0.9,
                "wspace": 0.06,
            },
        )[0]
        for axes, chi in zip(panels, cohesions):
            here = [entry for entry in found if entry["chi"] == chi]
            _theory(axes, sigma, chi, gamma, float(np.median([entry["aOverR"] for entry in here])), limits)
            _runs(axes, [row for row in rows if row["cohesion.chi [-]"] == chi], seeds)
            _measured(axes, here, fits[chi])
            axes.set(
                xscale="log", yscale="log", xlim=limits, ylim=(sigma[0], sigma[-1]), xlabel="mean grain radius [m]"
            )
            axes.set_title({0: "no cohesion"}.get(chi, f"$\\sigma_c = {chi:g}\\,\\gamma/r$"), fontsize=10)
            axes.set_yticks(sorted(set(stresses)), [f"{stress / 1e3:g}" for stress in sorted(set(stresses))])
            axes.minorticks_off()
            axes.set_xticks([10.0**k for k in range(-8, -1) if limits[0] <= 10.0**k <= limits[1]])
            axes.tick_params(labelsize=8)
        panels[0].set_ylabel("horizontal effective stress $\\sigma'_H$ [kPa]")
        _keyOfMap(figure, rows)
        saveFigure(figure, path)


def _theory(axes, sigma, chi, gamma, aOverR, limits):
    floor = limits[0] / 10  # where there is no r*, off the picture
    line = np.maximum(regime.criticalRadius(sigma, chi, gamma, aOverR), floor)
    if chi > 0:
        edges = [np.maximum(regime.criticalRadius(sigma, chi, gamma, a), floor) for a in FLAWS]
        axes.fill_betweenx(sigma, *edges, color=BAND, linewidth=0, zorder=0)
    axes.plot(line, sigma, color="0.25", linewidth=1.3, zorder=1)


def _runs(axes, rows, seeds):
    for mode, (colour, marker) in MODES.items():
        here = [row for row in rows if row["mapMode"] == mode]
        shift = [1.28 ** (seeds.index(row["grains.seed [-]"]) - (len(seeds) - 1) / 2) for row in here]
        filled = {} if marker == "x" else {"edgecolors": "white", "linewidths": 0.4}
        axes.scatter(
            [row["rMean [m]"] for row in here],
            [row["stress.horizontal [Pa]"] * s for row, s in zip(here, shift)],
            s=26,
            c=colour,
            marker=marker,
            zorder=3,
            **filled,
        )


def _measured(axes, found, laws):
    for entry in found:
        change, y = entry["change"], entry["stressH"] / 1.9
        if np.isfinite(change.radius):
            ends = [value if np.isfinite(value) else change.radius for value in (change.low, change.high)]
            axes.plot(ends, [y, y], color="black", linewidth=1.2, zorder=4, marker="|", markersize=6)
            axes.plot(
                change.radius,
                y,
                color="black",
                marker="*",
                markersize=9,
                markeredgecolor="white",
                markeredgewidth=0.5,
                zorder=5,
            )
        if np.isfinite(entry["gaveWay"]):
            axes.plot(entry["gaveWay"], y, color="black", marker="s", markersize=5, markerfacecolor="white", zorder=6)
    law = laws.get("gaveWay")
    if law and np.isfinite(law.error):  # two radii say nothing about their scatter
        error = f" \\pm {law.error:.3f}"
        axes.text(
            0.97,
            0.965,
            f"$r^* \\propto {{\\sigma'_H}}^{{{law.exponent:.3f}{error}}}$",
            transform=axes.transAxes,
            ha="right",
            va="top",
            fontsize=9,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5, "alpha": 0.85},
        )


def _keyOfMap(figure, rows):
    shown = [mode for mode in MODES if any(row["mapMode"] == mode for row in rows)]
    entries = [
        Line2D(
            [], [], color=MODES[mode][0], marker=MODES[mode][1], linestyle="none", markersize=6, label=f"{mode} (run)"
        )
        for mode in shown
    ]
    entries += [
        Line2D(
            [],
            [],
            color="black",
            marker="*",
            markersize=9,
            markeredgecolor="white",
            linewidth=1.2,
            label="$r^*$ by the modes, and its bracket (drawn below its row)",
        ),
        Line2D(
            [],
            [],
            color="black",
            marker="s",
            markersize=5,
            markerfacecolor="white",
            linestyle="none",
            label="$r^*$ by the displacement of the grains",
        ),
        Line2D([], [], color="0.25", linewidth=1.3, label="$r^*$ by theory, flaw as wide as the inlet"),
        Patch(color=BAND, label=f"the same, flaws of {FLAWS[0]} to {FLAWS[1]} radii"),
    ]
    figure.legend(handles=entries, loc="lower center", ncol=3, frameon=False, fontsize=8.5, columnspacing=1.6)


def drawCollapse(rows, path):
    """All runs in numbers without dimension: P_c r/gamma, at which gas is through, against sigma'_H r/gamma.

    Lines: 4.65, the rigid threshold; sigma'_H + chi (gamma/r) sqrt(r/a), the fracture pressure for the inlet of the
    runs. Hollow: gas did not come through before the sample had come apart; the pressure then is that at the end.
    """
    cohesions = sorted({row["cohesion.chi [-]"] for row in rows})
    numbers = np.array([row["stressNumber [-]"] for row in rows])
    x = np.geomspace(numbers.min() / 1.6, numbers.max() * 1.6, 300)
    with newFigure((6.9, 5.0)) as figure:
        axes = figure.add_axes([0.09, 0.11, 0.63, 0.86])
        axes.plot(x, np.full_like(x, regime.RIGID), color="0.25", linewidth=1.3, zorder=1)
        for chi, colour in zip(cohesions, COHESIONS):
            here = [row for row in rows if row["cohesion.chi [-]"] == chi]
            a = float(np.median([row["aOverR"] for row in here]))
            axes.plot(
                x,
                regime.fracturePressure(x, chi, 1.0, 1.0, a),
                color=colour,
                linewidth=1.2,
                linestyle=(0, (5, 2)),
                zorder=1,
            )
            for row in here:
                reduced = row["pressure"] * row["stressNumber [-]"] / row["stress.horizontal [Pa]"]
                marker, through = MODES[row["mapMode"]][1], np.isfinite(row["breakthroughPressure [Pa]"])
                look = (
                    {"color": colour}
                    if marker == "x"
                    else (
                        {"facecolors": colour, "edgecolors": "white", "linewidths": 0.4}
                        if through
                        else {"facecolors": "white", "edgecolors": colour, "linewidths": 1.1}
                    )
                )
                axes.scatter(row["stressNumber [-]"], reduced, s=24, marker=marker, zorder=3, **look)
        axes.set(
            xscale="log",
            yscale="log",
            xlim=(x[0], x[-1]),
            ylim=(0.1, 12),
            xlabel="$\\sigma'_H\\, r/\\gamma$  (confinement over capillarity)",
            ylabel="$P_c\\, r/\\gamma$ when gas is through",
        )
        axes.set_yticks([0.1, 0.2, 0.5, 1, 2, 5, 10], ["0.1", "0.2", "0.5", "1", "2", "5", "10"])
        axes.minorticks_off()
        axes.tick_params(labelsize=8)
        _keyOfCollapse(figure, rows, cohesions)
        saveFigure(figure, path)


def _keyOfCollapse(figure, rows, cohesions):
    names = {chi: "no cohesion" if chi == 0 else f"$\\sigma_c = {chi:g}\\,\\gamma/r$" for chi in cohesions}
    entries = [
        Line2D([], [], color=colour, marker="s", linestyle="none", label=names[chi])
        for chi, colour in zip(cohesions, COHESIONS)
    ]
    entries += [
        Line2D([], [], color="0.35", marker=MODES[mode][1], linestyle="none", label=mode)
        for mode in MODES
        if any(row["mapMode"] == mode for row in rows)
    ]
    entries += [
        Line2D(
            [],
            [],
            color="0.35",
            marker="^",
            markerfacecolor="white",
            linestyle="none",
            label="came apart before\ngas was through",
        ),
        Line2D([], [], color="0.25", linewidth=1.3, label=f"rigid threshold {regime.RIGID:g}"),
        Line2D(
            [],
            [],
            color="0.35",
            linewidth=1.2,
            linestyle=(0, (5, 2)),
            label="fracture pressure,\n$\\sigma'_H + \\sigma_c\\sqrt{r/a}$",
        ),
    ]
    figure.legend(handles=entries, loc="center right", frameon=False, fontsize=8.5, labelspacing=0.8)
