# SPDX-License-Identifier: GPL-2.0-or-later
"""Hydrate Ridge by depth: the runs of the sweep ``hydrate_ridge_depth`` in front of the theory, and the table with
both.
"""


import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from capfrac.io.csvfiles import writeRows
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.sweep import regime_map, table
from capfrac.sweep.regime_figures import MODES
from capfrac.theory import depth

NEEDED = (
    "depth [m]",
    "k0 [-]",
    "gas.interfacialTension [N/m]",
    "throat [m]",
    "stress.horizontal [Pa]",
    "mode",
    "displacement [r]",
    "medianDisplacement [r]",
    "breakthroughPressure [Pa]",
    "endPressure [Pa]",
    "openedShare [-]",
)
_THEORY, _STRESS = "#b7cfe6", "#e3cfc0"


def read(path):
    """The finished points of the sweep's table with ``mapMode`` (see :func:`capfrac.sweep.regime_map.mapMode`),
    ``pressure`` [Pa], ``column`` [m] and ``best`` (the best guess).
    """
    rows = table.read(path, NEEDED)
    for row in rows:
        row["mapMode"] = regime_map.mapMode(row)
        row["pressure"] = (
            row["breakthroughPressure [Pa]"]
            if np.isfinite(row["breakthroughPressure [Pa]"])
            else row["endPressure [Pa]"]
        )
        row["column"] = float(depth.gasColumn(row["pressure"], row["depth [m]"]))
        row["best"] = bool(
            np.allclose(
                [row["k0 [-]"], row["gas.interfacialTension [N/m]"], row["throat [m]"]],
                [depth.K0[1], depth.GAMMA[1], depth.THROAT[1]],
                rtol=1e-3,
            )
        )
    return rows


def drawDepth(rows, path):
    """Pressures, threshold over stress, and gas columns against depth. Lines and bands: theory; marks: runs (``rows``
    of :func:`read`).
    """
    z = np.linspace(5, 170, 100)
    theory = depth.bands(z)
    with newFigure((9.6, 5.2)) as figure:
        panels = figure.subplots(
            1, 3, sharey=True, gridspec_kw={"left": 0.07, "right": 0.985, "bottom": 0.27, "top": 0.97, "wspace": 0.09}
        )
        pressures, ratio, column = panels
        for name, colour, scale in (("threshold", _THEORY, 1e-6), ("stressH", _STRESS, 1e-6)):
            low, best, high = theory[name] * scale
            pressures.fill_betweenx(z, low, high, color=colour, alpha=0.65, linewidth=0)
        pressures.plot(theory["threshold"][1] * 1e-6, z, color="#0072b2", linewidth=1.3)
        pressures.plot(theory["stressH"][1] * 1e-6, z, color="#a0522d", linewidth=1.3)
        pressures.plot(theory["fracture"][1] * 1e-6, z, color="#a0522d", linewidth=1.3, linestyle=(0, (5, 2)))
        ratio.fill_betweenx(z, theory["ratio"][0], theory["ratio"][2], color="0.87", linewidth=0)
        ratio.plot(theory["ratio"][1], z, color="0.3", linewidth=1.3)
        ratio.axvline(1, color="black", linewidth=0.9, linestyle=(0, (2, 2)))
        column.fill_betweenx(z, theory["column"][0], theory["column"][2], color="0.87", linewidth=0)
        column.plot(theory["column"][1], z, color="0.3", linewidth=1.3)
        for row in sorted(rows, key=lambda row: row["best"]):
            colour, marker = MODES[row["mapMode"]]
            look = (
                {"s": 40, "facecolors": colour, "edgecolors": "white", "linewidths": 0.5, "zorder": 5}
                if row["best"]
                else {"s": 22, "facecolors": "none", "edgecolors": colour, "linewidths": 0.9, "zorder": 4}
            )
            threshold = depth.capillaryThreshold(row["gas.interfacialTension [N/m]"], row["throat [m]"])
            for axes, x in (
                (pressures, row["pressure"] * 1e-6),
                (ratio, threshold / row["stress.horizontal [Pa]"]),
                (column, row["column"]),
            ):
                axes.scatter(x, row["depth [m]"], marker=marker, **look)
        pressures.set(
            xlabel="capillary pressure, stress [MPa]",
            ylabel="depth below the seafloor [m]",
            ylim=(170, 0),
            xlim=(0, 1.3),
        )
        ratio.set(xlabel="capillary threshold / $\\sigma'_H$", xscale="log", xlim=(0.3, 40))
        ratio.set_xticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
        ratio.minorticks_off()
        column.set(xlabel="gas column $P_c / ((\\rho_w - \\rho_g)\\, g)$ [m]", xlim=(0, None))
        for axes, letter in zip(panels, "abc"):
            axes.tick_params(labelsize=8)
            axes.text(0.03, 0.985, letter, transform=axes.transAxes, fontweight="bold", va="top", fontsize=11)
        ratio.text(1.08, 24, "fracture $\\rightarrow$", fontsize=8)
        ratio.text(0.93, 24, "$\\leftarrow$ capillary", fontsize=8, ha="right")
        _key(figure, rows)
        saveFigure(figure, path)


def _key(figure, rows):
    modes = [mode for mode in MODES if any(row["mapMode"] == mode for row in rows)]
    entries = [
        Line2D(
            [],
            [],
            color=MODES[mode][0],
            marker=MODES[mode][1],
            linestyle="none",
            markersize=6,
            markeredgecolor="white",
            label=f"{mode}: run, best guess",
        )
        for mode in modes
    ]
    entries += (
        [
            Line2D(
                [],
                [],
                color="0.4",
                marker="o",
                markerfacecolor="none",
                linestyle="none",
                markersize=5,
                label="hollow: $K_0$, $\\gamma$ or throat elsewhere in its range",
            )
        ]
        if not all(row["best"] for row in rows)
        else []
    )
    entries += [
        Line2D([], [], color="#0072b2", label="capillary threshold $2\\gamma/r_{throat}$"),
        Patch(color=_THEORY, alpha=0.65, label="its range"),
        Line2D([], [], color="#a0522d", label="$\\sigma'_H$"),
        Patch(color=_STRESS, alpha=0.65, label="its range"),
        Line2D([], [], color="#a0522d", linestyle=(0, (5, 2)), label="fracture pressure with cohesion"),
        Line2D([], [], color="0.3", label="theory, best guess"),
        Patch(color="0.87", label="range of the theory"),
        Line2D([], [], color="black", linewidth=0.9, linestyle=(0, (2, 2)), label="threshold = $\\sigma'_H$"),
    ]
    figure.legend(handles=entries, loc="lower center", ncol=4, frameon=False, fontsize=8, columnspacing=1.4)


#: What theory says of a depth: name in :func:`capfrac.depth.bands` -> unit.
THEORY = {"stressH": "Pa", "threshold": "Pa", "fracture": "Pa", "pressure": "Pa", "column": "m", "ratio": "-"}
#: Columns of the table of :func:`writeSummary`.
SUMMARY_COLUMNS = (
    "depth [m]",
    *(f"{name}{end} [{unit}]" for name, unit in THEORY.items() for end in ("Low", "", "High")),
    "fractureShare [-]",
    "runs [-]",
    "runPressureLow [Pa]",
    "runPressureHigh [Pa]",
    "runColumnLow [m]",
    "runColumnHigh [m]",
    "modes",
    "modesElsewhereInTheRanges",
)


def writeSummary(rows, path):
    """Theory and runs for each depth of the sweep as a CSV: ranges as low, best and high; of the runs those of the best
    guess, and modes of all.
    """
    depths = sorted({row["depth [m]"] for row in rows})
    theory = depth.bands(depths)
    table = (_summaryRow(k, theory, [row for row in rows if row["depth [m]"] == z], z) for k, z in enumerate(depths))
    writeRows(path, SUMMARY_COLUMNS, table, form=".5g")


def _summaryRow(k, theory, here, z):
    """The values of :data:`SUMMARY_COLUMNS` at the depth number ``k``, ``z`` [m], with its runs ``here``."""
    best = [row for row in here if row["best"]]
    numbers = [float(theory[name][end][k]) for name in THEORY for end in range(3)]
    ends = [f(row[name] for row in best) if best else "" for name in ("pressure", "column") for f in (min, max)]
    modes = [_count(best), _count([row for row in here if not row["best"]])]
    return [z, *numbers, float(theory["fractureShare"][k]), len(best), *ends, *modes]


def _count(rows):
    modes = [row["mapMode"] for row in rows]
    return ", ".join(f"{modes.count(mode)} {mode}" for mode in MODES if mode in modes)
