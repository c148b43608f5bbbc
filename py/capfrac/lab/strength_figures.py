# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of stress paths, biaxial tests and tables of macroscopic properties."""

import math

import numpy as np

from capfrac.lab.figures import BAND, CYCLE, pressureUnit, tidy
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.units import quantity


def drawBiaxial(result, path, title=None):
    """Deviator and volume against strain for each confining stress, and the Mohr circles at the peaks with their
    envelope.
    """
    tests = result["tests"]
    pascal, unit = pressureUnit(max(test["peak"] for test in tests))
    with newFigure((9.6, 3.3)) as figure:
        deviator, volume, mohr = figure.subplots(
            1,
            3,
            gridspec_kw={"left": 0.065, "right": 0.985, "bottom": 0.155, "top": 0.9 if title else 0.96, "wspace": 0.3},
        )
        for colour, test in zip(CYCLE, tests):
            table = test["table"]
            axial, lateral = np.array(table["strain [-]"]), np.array(table["lateralStrain [-]"])
            vertical, horizontal = np.array(table["stressV [Pa]"]), np.array(table["stressH [Pa]"])
            deviator.plot(
                100 * axial,
                (vertical - horizontal) / pascal,
                color=colour,
                linewidth=1.1,
                label=f"$\\sigma_H$ = {quantity(test['stress'], 'Pa')}",
            )
            volume.plot(100 * axial, 100 * (axial + lateral), color=colour, linewidth=1.1)
            _drawCircle(mohr, test["stress"] / pascal, test["peak"] / pascal, colour)
        deviator.set(xlabel="vertical strain [%]", ylabel=f"$\\sigma_V - \\sigma_H$ [{unit}]", xlim=(0, None))
        deviator.legend(fontsize=7, frameon=False)
        volume.set(xlabel="vertical strain [%]", ylabel="volumetric strain [%] (compression +)", xlim=(0, None))
        _drawEnvelope(mohr, result, max(test["peak"] for test in tests) / pascal, pascal, unit)
        tidy(figure)
        if title:
            figure.suptitle(title, fontsize=10, y=0.985)
        saveFigure(figure, path)


def _drawCircle(axes, low, high, colour):
    angle = np.linspace(0, math.pi, 181)
    axes.plot(
        0.5 * (low + high) + 0.5 * (high - low) * np.cos(angle),
        0.5 * (high - low) * np.sin(angle),
        color=colour,
        linewidth=1.1,
    )


def _drawEnvelope(axes, result, highest, pascal, unit):
    tangent = math.tan(math.radians(result["frictionAngle"]))
    cohesion = result["cohesion"] / pascal
    start = -cohesion / tangent if cohesion > 0 else 0.0
    ends = np.array([max(start, -0.3 * highest), highest])
    axes.plot(ends, cohesion + tangent * ends, color="black", linewidth=1, linestyle=(0, (4, 2)))
    axes.set(
        xlabel=f"normal stress [{unit}]",
        ylabel=f"shear stress [{unit}]",
        ylim=(0, 0.85 * highest),
        xlim=(min(0.0, ends[0]), 1.05 * highest),
    )
    axes.set_aspect("equal", adjustable="box")
    axes.text(
        0.03,
        0.97,
        f"$\\varphi$ = {result['frictionAngle']:.1f}°\n$c$ = {quantity(result['cohesion'], 'Pa')}",
        transform=axes.transAxes,
        va="top",
        fontsize=9,
    )


def drawPath(rows, path, title=None):
    """A stress path: stress against strain, and deviator against mean stress."""
    axial, lateral, vertical, horizontal = (
        np.array(rows[name]) for name in ("strain [-]", "lateralStrain [-]", "stressV [Pa]", "stressH [Pa]")
    )
    pascal, unit = pressureUnit(max(vertical.max(), horizontal.max()))
    with newFigure((7.6, 3.3)) as figure:
        curve, invariants = figure.subplots(
            1,
            2,
            gridspec_kw={"left": 0.09, "right": 0.985, "bottom": 0.155, "top": 0.9 if title else 0.96, "wspace": 0.28},
        )
        curve.plot(
            100 * axial,
            vertical / pascal,
            color=COLOURS["dot"],
            marker=".",
            label="$\\sigma_V$ against $\\varepsilon_V$",
        )
        curve.plot(
            100 * lateral,
            horizontal / pascal,
            color=COLOURS["compression"],
            marker=".",
            label="$\\sigma_H$ against $\\varepsilon_H$",
        )
        curve.set(xlabel="strain [%]", ylabel=f"stress [{unit}]", ylim=(0, None))
        curve.legend(fontsize=8, frameon=False)
        invariants.plot(
            0.5 * (vertical + horizontal) / pascal,
            (vertical - horizontal) / pascal,
            color=COLOURS["dot"],
            marker=".",
        )
        invariants.set(xlabel=f"mean stress [{unit}]", ylabel=f"$\\sigma_V - \\sigma_H$ [{unit}]", xlim=(0, None))
        tidy(figure)
        if title:
            figure.suptitle(title, fontsize=10, y=0.985)
        saveFigure(figure, path)


_NAMES = {"youngModulus": "$E$", "poissonRatio": "$\\nu$", "frictionAngle": "$\\varphi$", "cohesion": "$c$"}


def drawSizes(result, path):
    """Each macroscopic property over its mean, against the smallest radius."""
    table = result["table"]
    with newFigure((5.2, 3.2)) as figure:
        axes = figure.add_axes([0.13, 0.16, 0.84, 0.78])
        for colour, (name, label) in zip(CYCLE, _NAMES.items()):
            values = np.array(table[name])
            axes.semilogx(
                table["rMin [m]"],
                values / values.mean(),
                color=colour,
                marker="o",
                markersize=4,
                linewidth=1,
                label=label,
            )
        axes.axhspan(0.975, 1.025, color=BAND, zorder=0, label="5 %")
        axes.set(xlabel="smallest radius [m]", ylabel="property / its mean", ylim=(0.9, 1.1))
        axes.legend(fontsize=8, frameon=False, ncol=5)
        tidy(figure)
        saveFigure(figure, path)


def drawSensitivity(result, path):
    """Exponents of the macroscopic properties (rows of bars) with respect to each microscopic parameter."""
    parameters = list(result["exponent"])
    with newFigure((6.4, 3.4)) as figure:
        axes = figure.add_axes([0.33, 0.15, 0.65, 0.75])
        height = 0.8 / len(_NAMES)
        for number, (name, label) in enumerate(_NAMES.items()):
            values = [result["exponent"][parameter][name] for parameter in parameters]
            axes.barh(
                np.arange(len(parameters)) + (number - 1.5) * height, values, height, color=CYCLE[number], label=label
            )
        axes.set(xlabel="exponent: property ~ parameter$^n$", yticks=range(len(parameters)))
        axes.set_yticklabels(parameters, fontsize=8)
        axes.invert_yaxis()
        axes.axvline(0, color="0.3", linewidth=0.8)
        axes.legend(fontsize=8, frameon=False, ncol=4, loc="lower center", bbox_to_anchor=(0.5, 1.0))
        tidy(figure)
        saveFigure(figure, path)
