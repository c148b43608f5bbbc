# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of the contact law: the engines as marks, Eqs. 1 and 2 as lines."""

import numpy as np

from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.units import prefix
from capfrac.verification.contacts import _CLOSED_FORM

_PANELS = (
    ("loading", "normal", "pressed and released"),
    ("tension", "normal", "bond pulled apart, pressed again"),
    ("recontact", "normal", "broken, parted, pressed again"),
    ("slip", "shear", "sheared to and fro"),
    ("shear", "shear", "bond sheared"),
    ("recontact", "shear", "broken, parted, sheared again"),
)


def drawContacts(result, path):
    """Draw force against displacement for all paths of :func:`capfrac.verification.contacts.checkContacts` to ``path``
    (.png, .pdf or .svg).

    Marks are what the engines gave, full while the bond held; lines are Eqs. 1 and 2, dashed ones the strengths and
    friction limits.
    """
    from matplotlib.lines import Line2D

    with newFigure((9.6, 5.6)) as figure:
        grid = {"left": 0.075, "right": 0.96, "bottom": 0.15, "top": 0.945, "wspace": 0.36, "hspace": 0.42}
        for axes, (name, kind, title) in zip(figure.subplots(2, 3, gridspec_kw=grid).flat, _PANELS):
            _drawPanel(axes, result[name], name, kind)
            axes.set_title(title, fontsize=9)
        mark = {
            "marker": "o",
            "linestyle": "none",
            "markersize": 4.5,
            "markeredgecolor": COLOURS["dot"],
            "markeredgewidth": 0.7,
        }
        figure.legend(
            handles=[
                Line2D([], [], markerfacecolor=COLOURS["dot"], label="engines, bonded", **mark),
                Line2D([], [], markerfacecolor="white", label="engines, not bonded", **mark),
                Line2D([], [], color=COLOURS["compression"], linewidth=1.4, label="Eqs. 1 and 2"),
                Line2D([], [], color="0.45", linewidth=0.9, linestyle=(0, (4, 3)), label="strength or friction limit"),
            ],
            ncol=4,
            loc="lower center",
            fontsize=8,
            frameon=False,
            bbox_to_anchor=(0.53, 0.0),
        )
        saveFigure(figure, path)


def _drawPanel(axes, found, name, kind):
    table = found["table"]
    columns = (
        ("overlap [m]", "normalForce [N]", _CLOSED_FORM[0])
        if kind == "normal"
        else ("slip [m]", "shearForce [N]", _CLOSED_FORM[1])
    )
    x, y, expected = (np.array(table[column]) for column in columns)
    xScale, xUnit = _scaleOf(x, "m")
    yScale, yUnit = _scaleOf(np.concatenate([y, expected]), "N")
    axes.plot(x / xScale, expected / yScale, color=COLOURS["compression"], linewidth=1.4, zorder=2)
    held = np.array(table["bonded"])
    for chosen, fill, layer in ((~held, "white", 3), (held, COLOURS["dot"], 4)):
        axes.scatter(
            x[chosen] / xScale,
            y[chosen] / yScale,
            s=13,
            c=fill,
            edgecolors=COLOURS["dot"],
            linewidths=0.7,
            zorder=layer,
        )
    friction, limits = found["frictionLimit"], []
    if kind == "shear" and friction > 0:
        limits += [(friction, r"$\mu F_n$"), (-friction, r"$-\mu F_n$")]
    if name in ("shear", "recontact") and kind == "shear":
        limits += [(found["strength"], r"$\varphi_s$")]
    if name == "tension":
        limits += [(-found["strength"], r"$-\varphi_n$")]
    low, high = min(y.min(), expected.min()), max(y.max(), expected.max())
    for value, label in limits:
        if low - 0.1 * (high - low) <= value <= high + 0.1 * (high - low):
            axes.axhline(value / yScale, color="0.45", linewidth=0.9, linestyle=(0, (4, 3)), zorder=1)
            axes.annotate(
                label,
                (1, value / yScale),
                xycoords=("axes fraction", "data"),
                xytext=(2, 0),
                textcoords="offset points",
                va="center",
                fontsize=8,
                color="0.35",
            )
    axes.axhline(0, color="0.8", linewidth=0.6, zorder=0)
    axes.axvline(0, color="0.8", linewidth=0.6, zorder=0)
    axes.set(
        xlabel=f"overlap $U_n$ [{xUnit}]" if kind == "normal" else f"slip $U_s$ [{xUnit}]",
        ylabel=f"normal force $F_n$ [{yUnit}]" if kind == "normal" else f"shear force $F_s$ [{yUnit}]",
    )
    axes.margins(0.06, 0.12)
    axes.tick_params(labelsize=8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _scaleOf(values, unit):
    """The power of a thousand to write ``values`` with, and its unit."""
    return prefix(float(np.max(np.abs(values))), unit, -12, 9)
