# SPDX-License-Identifier: GPL-2.0-or-later
"""Two grains along prescribed paths: the contact law of the engines against Eqs. 1 and 2 of Jain & Juanes (2008).

    F_n = k_n U_n,   dF_s = -k_s dU_s,   |F_s| <= mu F_n without a bond (Eqs. 1 and 2)

A bond holds tension and shear up to its strengths and no friction limit applies while it holds; it breaks for good when
the tension exceeds phi_n = sigma_c 2 r w or the shear phi_s = tau_c 2 r w (Eqs. 2 and 5; r: mean radius, w = 1 m).
A broken contact bears compression and friction, no tension; one that has parted forgets its shear.

Signs: an overlap U_n and its force F_n are positive in compression. U_s is the slip of the first grain's surface past
the second's. Forces are those on the second grain, the first lies to its left: F_n to the right, F_s in the direction
in which the first grain's surface slips, so that F_s = k_s U_s here, and dF_s = -k_s dU_s on the first grain, as in Eq.
1.
"""

import math

import numpy as np

from capfrac.lab.run import LabRun
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.plot.units import prefix
from capfrac.scene import sediment

#: Largest overlap of the paths over the smallest radius [-]. An overlap is a difference of positions of the size of the
#: radii, so round-off in the forces is some 1e-16 over this.
OVERLAP = 1e-2
#: Bonds are loaded to their strength times (1 - BRACKET), which they must hold, and (1 + BRACKET), which breaks them
#: [-]. Well above the round-off of the forces, some 1e-13.
BRACKET = 1e-9
#: Steps of each leg of a path; even, so that friction is used up or reversed at a row, and pictures show the corner.
_STEPS = 8
_CLOSED_FORM = ("expectedNormalForce [N]", "expectedShearForce [N]")


# --- paths: overlaps and slips of plain numbers ----------------------------------------------------


def loading(overlap):
    """Pressed to ``overlap`` [m] and released until the grains part: lists of overlaps and slips [m]."""
    overlaps = _legs(0, overlap, 0, -0.5 * overlap)
    return overlaps, [0.0] * len(overlaps)


def slip(overlap, limit):
    """Pressed to ``overlap`` [m], sheared to twice the slip ``limit`` [m], to the opposite and back: overlaps and slips
    [m].
    """
    overlaps = _legs(0, overlap)
    slips = _legs(0, 2 * limit, -2 * limit, 2 * limit)
    return overlaps + [overlap] * len(slips), [0.0] * len(overlaps) + slips


def tension(overlap, stretch):
    """Bonded at ``overlap`` [m], pulled to the ``stretch`` [m] at which the bond breaks and on, pressed and pulled
    again: overlaps and slips [m].
    """
    overlaps = (
        _legs(overlap, 0)
        + _through(-stretch, _legs(0, -1.5 * stretch)[1:])
        + _legs(-1.5 * stretch, 0, overlap, 0, -stretch)
    )
    return overlaps, [0.0] * len(overlaps)


def shear(overlap, breaking, limit):
    """Bonded at ``overlap`` [m], sheared to the slip ``breaking`` [m] at which the bond breaks and on, then back:
    overlaps and slips [m].

    ``limit``: the slip at which friction alone is used up [m]; the way back is four of it.
    """
    slips = _through(breaking, _legs(0, 1.5 * breaking)) + _legs(1.5 * breaking, 1.5 * breaking - 4 * limit)
    return [overlap] * len(slips), slips


def recontact(overlap, breaking, limit):
    """Bond broken by shear as in :func:`shear`, grains parted, pressed again, sheared by twice ``limit`` and parted:
    overlaps and slips [m].
    """
    slips = _through(breaking, _legs(0, 1.2 * breaking))
    released, sheared = _legs(overlap, 0, -0.5 * overlap), _legs(0, 2 * limit)
    parted = released + released[::-1]
    overlaps = [overlap] * len(slips) + parted + [overlap] * len(sheared) + released
    return overlaps, slips + [slips[-1]] * len(parted) + [slips[-1] + s for s in sheared] + [
        slips[-1] + sheared[-1]
    ] * len(released)


def _legs(*corners):
    """From corner to corner in equal steps, each corner once."""
    legs = [np.linspace(a, b, _STEPS + 1)[1:] for a, b in zip(corners, corners[1:])]
    return np.concatenate([corners[:1], *legs]).tolist()


def _through(value, values):
    """``values`` that run one way, with the bracket around ``value`` put in its place among them."""
    near = 1e-3 * abs(value)
    inserted = [v for v in values if abs(v - value) > near] + (
        [value * (1 - BRACKET), value * (1 + BRACKET)] if value else []
    )
    return sorted(inserted, reverse=values[-1] < values[0])


# --- Eqs. 1 and 2 --------------------------------------------------------------------------------


def equations(overlaps, slips, normalStiffness, shearStiffness, friction, normalStrength=0.0, shearStrength=0.0):
    """Forces after Eqs. 1 and 2 along a path that begins in contact, unsheared: lists F_n [N], F_s [N] and bonded.

    ``overlaps`` and ``slips`` [m], stiffnesses [N/m], strengths phi_n and phi_s of the bond [N], both 0: no bond.
    """
    normal, sheared, held = [], [], []
    bonded, anchor = normalStrength > 0 or shearStrength > 0, slips[0]  # the anchor is the slip at which F_s = 0
    for overlap, at in zip(overlaps, slips):
        fn, fs = normalStiffness * overlap, shearStiffness * (at - anchor)
        bonded = bonded and -fn <= normalStrength and abs(fs) <= shearStrength
        if not bonded and fn < 0:
            fn, fs, anchor = 0.0, 0.0, at
        elif not bonded and abs(fs) > friction * fn:
            fs = math.copysign(friction * fn, fs)
            anchor = at - fs / shearStiffness
        normal.append(fn)
        sheared.append(fs)
        held.append(bonded)
    return normal, sheared, held


# --- the contact law of the engines --------------------------------------------------------------


def drive(sample, overlaps, slips, tensileStrength=0.0, shearStrength=0.0):
    """Lead two grains of radii ``rMin`` and ``rMax`` along a path; returns the table, columns as in
    :func:`checkContacts`.

    Strengths sigma_c and tau_c [Pa]; the bond is made in the first row, which needs an overlap then. Only the forces
    and whether the contact is bonded are read from YADE. The scene must be empty and is empty afterwards;
    :class:`SceneError` when it is not.
    """
    from yade import O

    r1, r2 = sample.rMin, sample.rMax
    far = 10 * (r1 + r2)
    sediment.buildScene(sample, (-r1, r2), (0, 0), (r1, r2), (-far, far, -far, far))
    first, second = sediment.grainBodies()
    for grain in (first, second):
        grain.state.blockedDOFs = "xyzXYZ"
    rows = []
    try:
        for row, (overlap, at) in enumerate(zip(overlaps, slips)):
            # The overlap is set as a place, so that errors do not add up. The slip is a turn of both grains about z,
            # half each. A sideways motion would not be exact: the overlap changes in second order, YADE turns the shear
            # force with the normal to first order only, and counts the motion times (r1 + r2) / (r1 + r2 - U_n) against
            # ratcheting. A turn leaves normal and overlap alone and counts as (r1 w1 + r2 w2) dt, to round-off,
            # whatever the overlap.
            second.state.pos = (r2 - overlap, 0, 0)
            for grain, radius in ((first, r1), (second, r2)):
                grain.state.angVel = (0, 0, 0.5 * (at - slips[row - 1]) / (radius * O.dt) if row else 0)
            O.step()
            if row == 0 and (tensileStrength > 0 or shearStrength > 0):
                sediment.bond(tensileStrength=tensileStrength, shearStrength=shearStrength)
            force = O.forces.f(second.id)
            rows.append(
                (overlap, at, force[0], force[1], any(i.isReal and not i.phys.cohesionBroken for i in O.interactions))
            )
    finally:
        O.reset()
    return dict(zip(("overlap [m]", "slip [m]", "normalForce [N]", "shearForce [N]", "bonded"), map(list, zip(*rows))))


def checkContacts(sample=None, run=None):
    """Compare the contact law with Eqs. 1 and 2 on all paths: a dict of path -> dict. The scene is replaced.

    ``sample`` gives k_n, k_s, friction, density and the radii of the two grains, ``rMin`` and ``rMax``; strengths are
    chosen so that overlaps stay within ``OVERLAP``. Paths: ``loading``, ``slip``, ``tension``, ``shear``,
    ``recontact``, see the functions of these names. Each dict holds ``table``: overlap [m], slip [m], normalForce [N],
    shearForce [N], bonded, expectedNormalForce [N], expectedShearForce [N] (signs as in the module's text); ``error``:
    largest difference between forces measured and expected over the largest force on the path [-]; ``bondErrors``: rows
    in which the bond held and should not, or the other way round; ``largestNormalForce``, ``largestShearForce`` and
    ``frictionLimit``, mu F_n at the overlap of the shearing [N]. With a bond also ``strength``: phi_n or phi_s,
    whichever breaks it [N]; ``borne``: largest such force that it bore [N]; ``brokeAt``: k_n U_n or k_s U_s of the row
    in which it broke [N], NaN when it held (k_s = 0); ``tensionAfterwards`` and ``shearAfterwards``: largest of what
    the broken contact bore [N]. Raises :class:`RunFolderError` when ``run`` cannot be saved.
    """
    sample = sample or sediment.Sediment()
    run = run or LabRun("contacts", {})
    overlap = OVERLAP * sample.rMin
    kn, ks, mu = sample.normalStiffness, sample.shearStiffness, sample.friction
    pressed = 0.2 * overlap  # small on the paths that break in shear, so that friction takes over with a visible drop
    phiN, phiS = 0.4 * kn * overlap, (0.4 + 0.2 * mu) * kn * overlap

    def slipOf(force):
        """Slip that gives a shear force; any where there is none (k_s = 0, or no friction)."""
        return force / ks if ks > 0 and force > 0 else overlap

    plans = {
        "loading": (overlap, *loading(overlap), 0.0, 0.0),
        "slip": (overlap, *slip(overlap, slipOf(mu * kn * overlap)), 0.0, 0.0),
        # Strengths that are not tested are far off: each bond breaks for one reason.
        "tension": (overlap, *tension(0.5 * overlap, phiN / kn), phiN, 10 * phiS),
        "shear": (pressed, *shear(pressed, slipOf(phiS), slipOf(mu * kn * pressed)), 10 * phiN, phiS),
        "recontact": (pressed, *recontact(pressed, slipOf(phiS), slipOf(mu * kn * pressed)), 10 * phiN, phiS),
    }
    return {name: run.result(name, lambda: _compare(sample, name, *plan)) for name, plan in plans.items()}


def _compare(sample, name, overlap, overlaps, slips, normalStrength, shearStrength):
    kn, ks, mu = sample.normalStiffness, sample.shearStiffness, sample.friction
    area = sample.rMin + sample.rMax  # 2 r w of Eq. 5
    table = drive(sample, overlaps, slips, normalStrength / area, shearStrength / area)
    *forces, held = equations(overlaps, slips, kn, ks, mu, normalStrength, shearStrength)
    table.update(zip(_CLOSED_FORM, forces))
    normal, sheared = np.array(table["normalForce [N]"]), np.array(table["shearForce [N]"])
    off = np.hypot(normal - forces[0], sheared - forces[1])
    bonded = np.array(table["bonded"])
    found = {
        "table": table,
        "error": float(np.max(off) / np.max(np.hypot(*forces))),
        "bondErrors": int(np.sum(bonded != held)),
        "largestNormalForce": float(np.max(np.abs(normal))),
        "largestShearForce": float(np.max(np.abs(sheared))),
        "frictionLimit": mu * kn * overlap,
    }
    if normalStrength > 0:
        asked = -kn * np.array(overlaps) if name == "tension" else np.abs(ks * np.array(slips))
        bore = -normal if name == "tension" else np.abs(sheared)
        found.update(
            strength=normalStrength if name == "tension" else shearStrength,
            borne=float(np.max(bore[bonded], initial=0)),
            brokeAt=math.nan if bonded.all() else float(asked[np.argmin(bonded)]),
            tensionAfterwards=float(np.max(np.abs(np.minimum(normal[~bonded], 0)), initial=0)),
            shearAfterwards=float(np.max(np.abs(sheared[~bonded]), initial=0)),
        )
    return found


# --- picture -------------------------------------------------------------------------------------

_PANELS = (
    ("loading", "normal", "pressed and released"),
    ("tension", "normal", "bond pulled apart, pressed again"),
    ("recontact", "normal", "broken, parted, pressed again"),
    ("slip", "shear", "sheared to and fro"),
    ("shear", "shear", "bond sheared"),
    ("recontact", "shear", "broken, parted, sheared again"),
)


def drawContacts(result, path):
    """Draw force against displacement for all paths of :func:`checkContacts` to ``path`` (.png, .pdf or .svg).

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
