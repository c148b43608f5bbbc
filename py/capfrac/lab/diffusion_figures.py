# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of single-phase flow: Figures 11 and 12 of Jain & Juanes (2008), schemes in time, closed forms.

Each function draws the result of a test (:mod:`capfrac.lab.diffusion`, :mod:`capfrac.verification.closedforms`) to a
file (.png, .pdf or .svg).
"""

import numpy as np

from capfrac.lab.figures import CYCLE, tidy
from capfrac.lab.profiles import pressureProfile
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.units import quantity

_HOLLOW = {"linestyle": "none", "marker": "o", "markersize": 3.5, "markerfacecolor": "white"}


def drawRates(result, path):
    """In- and outflow over the steady flow against time, with Eqs. 21 and 22 (Figure 11)."""
    with newFigure((5.4, 3.3)) as figure:
        axes = figure.add_axes([0.12, 0.15, 0.85, 0.8])
        _rates(axes, result["rates"], 6)
        tidy(figure)
        saveFigure(figure, path)


def _rates(axes, rates, every):
    rates = {name: np.array(values) for name, values in rates.items()}
    shown = rates["tau"] > 1e-4
    for colour, name in ((COLOURS["dot"], "inflow"), (COLOURS["compression"], "outflow")):
        axes.semilogx(rates["tau"][shown], rates[f"expected{name.capitalize()}"][shown], color=colour, linewidth=1.1)
        axes.semilogx(rates["tau"][shown][::every], rates[name][shown][::every], color=colour, label=name, **_HOLLOW)
    axes.plot([], [], color="black", linewidth=1.1, label="Eqs. 21, 22")
    axes.set(xlabel="time $\\tau = t\\,k/(c_v\\mu H^2)$", ylabel="flow / steady flow", ylim=(-0.2, 8))
    axes.legend(fontsize=8, frameon=False)


def drawProfiles(result, path):
    """Pressure over the height at several times, of single pores and of layers, with Eq. 20 (Figure 12)."""
    with newFigure((5.4, 4.1)) as figure:
        axes = figure.add_axes([0.12, 0.12, 0.86, 0.85])
        for colour, profile in zip(CYCLE, result["profiles"]):
            axes.plot(
                profile["xi"],
                profile["pressure"],
                linestyle="none",
                marker=".",
                markersize=2.5,
                markeredgewidth=0,
                alpha=0.55,
                color=colour,
            )
        _equation20(axes, result["profiles"])
        for colour, profile in zip(CYCLE, result["profiles"]):
            axes.plot(
                profile["layers"]["xi"], profile["layers"]["pressure"], color=colour, **{**_HOLLOW, "markersize": 4}
            )
        axes.plot([], [], linestyle="none", marker=".", markersize=4, color="0.4", label="single pores")
        axes.plot([], [], color="0.2", label="layers of two grains", **{**_HOLLOW, "markersize": 4})
        axes.plot([], [], color="0.2", linewidth=1.2, label="Eq. 20")
        axes.legend(fontsize=8, frameon=False, loc="upper left")
        tidy(figure)
        saveFigure(figure, path)


def _equation20(axes, profiles):
    xi = np.linspace(0, 1, 401)
    for colour, profile in zip(CYCLE, profiles):
        axes.plot(
            xi,
            pressureProfile(xi, profile["tau"]),
            color=colour,
            linewidth=1.2,
            label=f"$\\tau$ = {profile['tau']:.3g}",
        )
    axes.set(xlabel="$x/H$", ylabel="$p/\\Delta p$", xlim=(-0.02, 1.02), ylim=(-0.03, 1.05))


def drawSchemes(result, path):
    """The explicit scheme (``schemes`` of a diffusion): rates, profiles of both schemes, errors against the limit of
    the implicit one.
    """
    found = result["schemes"]
    with newFigure((10.2, 3.5)) as figure:
        rates, profiles, errors = figure.subplots(
            1, 3, gridspec_kw={"left": 0.05, "right": 0.99, "bottom": 0.14, "top": 0.92, "wspace": 0.25}
        )
        _rates(rates, found["rates"], 2)
        rates.set_title(f"explicit, {found['grains']} grains, {found['explicitSteps']} steps", fontsize=9)
        for colour, one, other in zip(CYCLE, found["profiles"], found["implicitProfiles"]):
            profiles.plot(
                one["xi"], one["pressure"], linestyle="none", marker=".", markersize=3, markeredgewidth=0, color=colour
            )
            profiles.plot(
                other["xi"],
                other["pressure"],
                linestyle="none",
                marker="o",
                markersize=4.5,
                markerfacecolor="none",
                markeredgewidth=0.35,
                color=colour,
            )
        _equation20(profiles, found["profiles"])
        profiles.legend(fontsize=7, frameon=False, loc="upper left")
        profiles.set_title("pores: dots explicit, rings implicit", fontsize=9)
        for colour, (steps, at) in zip(CYCLE, found["implicitErrorsAt"].items()):
            errors.loglog(
                found["times"],
                at,
                color=colour,
                linewidth=1,
                marker="o",
                markersize=3.5,
                markerfacecolor="white",
                label=f"implicit, {steps} steps",
            )
        label = f"explicit, {quantity(found['explicitTimeStep'], 's')} or less"
        errors.loglog(
            found["times"],
            found["explicitErrorsAt"],
            color="black",
            linewidth=1,
            marker="s",
            markersize=3.5,
            label=label,
        )
        errors.set(xlabel="time $\\tau$", ylabel="largest error of a pore / $\\Delta p$")
        errors.set_title("against steps of length 0", fontsize=9)
        errors.legend(fontsize=7, frameon=False, loc="lower left")
        tidy(figure)
        saveFigure(figure, path)
