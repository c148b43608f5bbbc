# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws doc/figures/rate.png from the runs of tests/validation/rate.py: capfrac python doc/make_rate.py.

Runs that are missing are made first (half an hour).
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "tests" / "validation"))

from rate import LARGE, NUDGED, RUNS, SMALL, one, table

from capfrac.plot.figures import COLOURS, newFigure, saveFigure

STYLES = {
    "ramp": ("prescribed: a ramp of 1 kPa steps", "0.45", "-"),
    "large": (f"rate, dead volume {LARGE} times the pores", COLOURS["gas"], "-"),
    "small": (f"rate, dead volume {SMALL} times the pores", COLOURS["compression"], "-"),
    "small-half-rate": ("half the rate", COLOURS["tension"], "--"),
    "small-half-step": ("half the time step", COLOURS["broken"], ":"),
}


def marks(axes, run, x, colour):
    """The first opened throat and the breakthrough, at the abscissae `x(iteration)`."""
    events = run["events"]
    first = next((k for k, opened in enumerate(events["opened"]) if opened), None)
    last = (
        events["iteration"].index(run["breakthroughIter"]) if run["breakthroughIter"] in events["iteration"] else None
    )
    for k, marker in ((first, "^"), (last, "o")):
        if k is not None:
            axes.plot(
                x(events["iteration"][k]),
                events["gasPressure"][k] / 1e3,
                marker,
                color=colour,
                markersize=6,
                markerfacecolor="white",
                zorder=4,
            )


def drawBySupply(axes, run, label, colour, line):
    """The pressure of the gas over what came in."""
    history = run["history"]
    supplied = (np.array(history["mass"]) - run["ledger"]["initial"]) / run["ledger"]["initial"]
    axes.plot(supplied, np.array(history["gasPressure"]) / 1e3, line, color=colour, linewidth=1.2, label=label)
    marks(axes, run, lambda i: np.interp(i, history["iteration"], supplied), colour)


def main():
    runs = {name: one(name, **RUNS[name]) for name in STYLES}
    nudged = [one(name, **values) for name, values in NUDGED.items()]
    print(*table([*runs.values(), *nudged]), sep="\n")
    with newFigure((7.2, 3.0)) as figure:
        left, right = figure.subplots(
            1, 2, gridspec_kw={"left": 0.075, "right": 0.985, "bottom": 0.16, "top": 0.925, "wspace": 0.2}
        )
        for name in ("ramp", "large", "small"):
            run, (label, colour, line) = runs[name], STYLES[name]
            history = run["history"]
            time = (np.array(history["time"]) - run["begun"]) * 1e6
            left.plot(time, np.array(history["gasPressure"]) / 1e3, line, color=colour, linewidth=1.2, label=label)
            marks(left, run, lambda i: np.interp(i, history["iteration"], time), colour)
        left.set(xlabel="time since the start of the injection [µs]", ylabel="capillary pressure $P_c$ [kPa]")
        for k, run in enumerate(nudged):
            drawBySupply(right, run, "rate changed by 1 or 2 billionths" if k == 0 else None, "0.7", "-")
        for name in ("small", "small-half-rate", "small-half-step"):
            label, colour, line = STYLES[name]
            drawBySupply(right, runs[name], label if name != "small" else "as on the left", colour, line)
        right.set(xlabel="gas supplied / gas at the start [-]")
        for axes, letter in ((left, "a"), (right, "b")):
            axes.plot([], [], "^", color="black", markerfacecolor="white", markersize=6, label="first opened throat")
            axes.plot([], [], "o", color="black", markerfacecolor="white", markersize=6, label="breakthrough")
            axes.legend(fontsize=6.5, frameon=False, loc="best")
            axes.tick_params(labelsize=8)
            axes.text(0.0, 1.01, letter, transform=axes.transAxes, fontweight="bold", fontsize=9, va="bottom")
            axes.spines["top"].set_visible(False), axes.spines["right"].set_visible(False)
        saveFigure(figure, HERE / "figures" / "rate.png")


if __name__ == "__main__":
    main()
