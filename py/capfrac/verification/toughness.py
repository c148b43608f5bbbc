# SPDX-License-Identifier: GPL-2.0-or-later
"""Fracture toughness: the gas pressure at which a crack of known length begins to grow, against linear elastic fracture
mechanics (LEFM).

A bonded sample gets a straight horizontal crack of half-length a in its middle: the contacts that it crosses lose their
bonds. Gas is let into the pores of the crack and nowhere else (its interfacial tension is so high that no throat takes
it), and its pressure rises slowly until a bond at a tip breaks. With sigma the stress on all walls,

    P - sigma = sigma_c sqrt(alpha r/a),    K_Ic = (P - sigma) sqrt(pi a) f = sigma_c sqrt(pi alpha r),

f being the correction for the width of the box (:func:`lattice_crack.finiteWidth`), alpha >= 1 a number of the packing
(Potyondy & Cundall 2004). A pressure in the crack does not stretch the sample ahead of it as a pull from outside would:
it lacks the uniform part of the stress, which counts when the crack is only some grains long. With that part c the bond
at the tip breaks at

    P - sigma = sigma_c/(sqrt(a f^2/(alpha r)) - c),

a line 1/p = sqrt(a f^2/r)/sqrt(alpha) - c in p = (P - sigma)/sigma_c. c is 0 in LEFM; for the square lattice
:mod:`lattice_crack` gives it.
"""

import math

import matplotlib.ticker
import numpy as np

from capfrac.errors import CaseError, SampleError
from capfrac.lab.run import LabRun
from capfrac.plot.painter import COLOURS
from capfrac.plot.sheet import newFigure, saveFigure
from capfrac.run import injection
from capfrac.scene import sediment
from capfrac.theory.lattice_crack import finiteWidth, tipForces
from capfrac.verification.handmade import squareLattice

#: Where the ramp of the pressure begins and ends and its increment, as shares of P - sigma of the linear lattice, and
#: of LEFM with alpha = 1 [-].
LATTICE_RAMP, SAMPLE_RAMP = (0.8, 1.3, 0.01), (0.5, 6.0, 0.04)
#: A bond within this distance of a tip is one at the tip, in mean grain diameters [-].
AT_TIP = 2.0
#: Steps between two looks at the bonds [-].
_LOOK = 20
#: Until a grain has moved this far, in smallest radii, the triangulation stays as it is [-]. Four grains on a square
#: have two, equally good ones, which would change places all over the lattice at the slightest movement and take the
#: gas out of the crack.
_REMESH = 0.2


def crackedContacts(centre, halfLength):
    """Contacts of the scene that a horizontal crack crosses: pairs of ids of the grains whose line it cuts; ``centre``
    (x, y), ``halfLength`` [m].
    """
    from yade import O

    place = {body.id: tuple(body.state.pos)[:2] for body in sediment.grainBodies()}
    pairs = []
    for contact in O.interactions:
        if not contact.isReal or contact.id1 not in place or contact.id2 not in place:
            continue
        (xa, ya), (xb, yb) = place[contact.id1], place[contact.id2]
        if (ya - centre[1]) * (yb - centre[1]) < 0:
            x = xa + (xb - xa) * (centre[1] - ya) / (yb - ya)
            if abs(x - centre[0]) < halfLength:
                pairs.append(tuple(sorted((contact.id1, contact.id2))))
    return sorted(pairs)


def besideContacts(pairs):
    """Points in the pores on either side of these contacts: (x, y) [m], two for each.

    0.3 of the smaller radius off the contact, at right angles to its line: disks that touch part by 0.05 radii there,
    and one that touched both would be 0.7 off.
    """
    from yade import O

    points = []
    for pair in pairs:
        (a, ra), (b, rb) = ((np.array(tuple(O.bodies[i].state.pos)[:2]), O.bodies[i].shape.radius) for i in pair)
        normal = (b - a) / np.linalg.norm(b - a)
        aside = 0.3 * min(ra, rb) * np.array([-normal[1], normal[0]])
        points += [tuple(a + ra * normal + sign * aside) for sign in (1, -1)]
    return points


def openCrack(pairs):
    """Take the bonds of these contacts: they break at the first tension or shear."""
    from yade import O

    for a, b in pairs:
        phys = O.interactions[a, b].phys
        phys.normalAdhesion = phys.shearAdhesion = np.finfo(float).tiny


def pressurise(centre, halfLength, points, pairs, ramp, bondStrength, radius, poreMode, report=lambda text: None):
    """Raise the pressure in the crack until a bond at a tip breaks; a dict. ``ramp``: start, end and increment [Pa].

    ``pressure``: at that moment [Pa]; ``firstBond``: at which any bond but the crack's own broke [Pa]; ``brokenBonds``
    then; ``inletPores`` that hold the gas; ``levels`` of the ramp. The pressure is good to one increment. Raises
    :class:`SampleError` when no bond breaks.
    """
    start, end, increment = ramp
    gas = injection.startInjection(
        start,
        increment,
        end,
        outlet="any",
        points=points,
        poreMode=poreMode,
        interfacialTension=1e6 * bondStrength * radius,
        remeshDisplacement=_REMESH,
    )
    crack, tips = set(pairs), [(centre[0] - halfLength, centre[1]), (centre[0] + halfLength, centre[1])]
    first = None
    while not gas.rampDone:
        sediment.advance(_LOOK)
        broken = [pair for pair in map(lambda p: tuple(sorted(p)), gas.brokenBonds()) if pair not in crack]
        report(f"crack of {halfLength / radius:.3g} radii: {gas.gasPressure:.4g} Pa, {len(broken)} bonds broken")
        if broken and first is None:
            first = gas.gasPressure
        if any(_nearTip(pair, tips, 2 * AT_TIP * radius) for pair in broken):
            return {
                "pressure": gas.gasPressure,
                "firstBond": first,
                "brokenBonds": len(broken),
                "inletPores": gas.inletPores,
                "levels": gas.level,
            }
    raise SampleError(f"no bond at the tips of the crack broke up to {gas.gasPressure:g} Pa")


def _ramp(shares, stress, scale):
    return stress + shares[0] * scale, stress + shares[1] * scale, shares[2] * scale


def _nearTip(pair, tips, distance):
    from yade import O

    middle = np.mean([tuple(O.bodies[i].state.pos)[:2] for i in pair], axis=0)
    return min(math.hypot(middle[0] - x, middle[1] - y) for x, y in tips) <= distance


def latticeTest(sample, broken, columns, rows, stress, bondStrength):
    """The test on a square lattice of ``columns`` x ``rows`` grains of ``sample.rMin`` with ``broken`` contacts without
    bond: a dict.

    As :func:`pressurise`, with ``halfLength`` a = (broken + 1) r, half the way from bond to bond [m], and ``expected``,
    the pressure that the linear lattice gives [Pa].
    """
    r = sample.rMin
    perPressure, perStress = tipForces(columns, rows, broken, sample.normalStiffness, sample.shearStiffness)
    disks, box = squareLattice(columns, rows, r)
    sediment.buildScene(sample, *np.array(disks).T, box)
    sediment.compress(sample, stress, stress)
    sediment.bond(tensileStrength=bondStrength, shearStrength=100 * bondStrength)
    walls = sediment.wallBodies()
    centre = (
        0.5 * (walls["left"].state.pos[0] + walls["right"].state.pos[0]),
        0.5 * (walls["bottom"].state.pos[1] + walls["top"].state.pos[1]),
    )
    spacing = sediment.boxSize()[0] / columns
    pairs = crackedContacts(centre, 0.5 * broken * spacing)
    openCrack(pairs)
    points = [(centre[0] + (k - 0.5 * broken) * spacing + 0.05 * spacing, centre[1]) for k in range(broken + 1)]
    expected = (bondStrength + perStress * stress) / perPressure
    found = pressurise(
        centre,
        (broken + 1) * r,
        points,
        pairs,
        _ramp(LATTICE_RAMP, stress, expected - stress),
        bondStrength,
        r,
        "domain",
    )
    return {**found, "halfLength": (broken + 1) * r, "radius": r, "width": sediment.boxSize()[0], "expected": expected}


def sampleTest(sample, halfLengths, stress, bondStrength, run):
    """The test on one settled sample, once for each of ``halfLengths`` in mean radii: a list of dicts as of
    :func:`pressurise`, with ``halfLength`` [m].
    """
    from yade import O

    def prepare():
        sediment.makeSample(
            sample,
            stress,
            stress,
            progress=lambda label, unbalanced: run.report(
                f"seed {sample.seed}, {label}: unbalanced force {unbalanced:.2g}"
            ),
        )
        sediment.bond(tensileStrength=bondStrength, shearStrength=bondStrength)
        sediment.relax()

    run.stage("sample", prepare)
    O.saveTmp("capfrac.toughness", quiet=True)
    found = []
    for length in halfLengths:
        O.loadTmp("capfrac.toughness", quiet=True)
        width, height = sediment.boxSize()
        radius = float(np.mean([body.shape.radius for body in sediment.grainBodies()]))
        walls = sediment.wallBodies()
        centre = (walls["left"].state.pos[0] + 0.5 * width, walls["bottom"].state.pos[1] + 0.5 * height)
        a = length * radius
        if 2 * a > 0.5 * width:
            raise CaseError(
                f"halfLengths = {length} mean radii, allowed: up to {0.25 * width / radius:.3g}, a quarter of the width"
                " of the box"
            )
        pairs = crackedContacts(centre, a)
        openCrack(pairs)
        points = [(x, centre[1]) for x in np.linspace(centre[0] - a, centre[0] + a, max(3, int(8 * a / radius)))]
        if not sediment.anyInTheVoid(points):  # a short crack may run through grains and contacts alone
            points += besideContacts(pairs)
        ramp = _ramp(SAMPLE_RAMP, stress, bondStrength * math.sqrt(radius / a))
        found.append(
            {
                **pressurise(centre, a, points, pairs, ramp, bondStrength, radius, "triangle", run.report),
                "halfLength": a,
                "radius": radius,
                "width": width,
            }
        )
    return found


def fit(tests, stress, bondStrength):
    """alpha and c of the tests: a dict.

    ``alphaLEFM``: of P - sigma = sigma_c sqrt(alpha r/(a f^2)), the mean over the tests (of the logarithms) [-];
    ``exponent``: of (P - sigma) against a f^2, -1/2 in LEFM [-], with its ``exponentError`` (standard error);
    ``alpha``, ``c``: of 1/p = sqrt(a f^2/(alpha r)) - c by least squares [-]; ``toughness``: K_Ic = sigma_c sqrt(pi
    alpha r) with that alpha [Pa m^0.5]; ``scatter``: standard deviation of ln p about the curve [-].
    """
    size = np.array([t["halfLength"] / t["radius"] * finiteWidth(t["halfLength"], t["width"]) ** 2 for t in tests])
    p = (np.array([t["pressure"] for t in tests]) - stress) / bondStrength
    if len(set(np.round(size, 9))) < 2 or np.any(p <= 0):
        raise CaseError("tests: allowed: at least two lengths of the crack, pressures above the stress")
    slope, offset = np.polyfit(np.sqrt(size), 1 / p, 1)
    x, y = np.log(size), np.log(p)
    exponent, level = np.polyfit(x, y, 1)
    error = math.sqrt(((y - level - exponent * x) ** 2).sum() / max(len(x) - 2, 1) / ((x - x.mean()) ** 2).sum())
    alpha = 1 / slope**2 if slope > 0 else math.nan
    curve = np.maximum(slope * np.sqrt(size) + offset, 1e-9)
    return {
        "alphaLEFM": float(np.exp((2 * y + x).mean())),
        "exponent": float(exponent),
        "exponentError": float(error),
        "alpha": float(alpha),
        "c": float(-offset),
        "toughness": (
            float(bondStrength * math.sqrt(math.pi * alpha * tests[0]["radius"])) if alpha == alpha else math.nan
        ),
        "scatter": float(np.std(y + np.log(curve))),
    }


def toughness(
    sample,
    halfLengths=(3.0, 5.0, 7.0, 10.0),
    seeds=3,
    stress=3e3,
    bondStrength=100e3,
    columns=30,
    brokenContacts=(1, 3, 5, 9),
    run=None,
):
    """The test on a square lattice and on settled samples of ``seeds`` seeds from the sample's own on; a dict.

    ``halfLengths`` in mean radii for the samples, ``brokenContacts`` (odd) for the lattice of about ``columns`` x
    ``columns`` grains; ``stress`` [Pa] on all walls, small beside ``bondStrength`` [Pa] (sigma_c = tau_c; in the
    lattice tau_c does not matter). Results: ``lattice`` and ``samples``, each with ``tests`` and the dict of
    :func:`fit`; ``latticeError``: largest relative difference of the lattice's pressures from the linear lattice.
    """
    run = run or LabRun("toughness", {})
    if len(set(halfLengths)) < 2 or len(set(brokenContacts)) < 2 or min(halfLengths) <= 0:
        raise CaseError(
            f"halfLengths = {list(halfLengths)}, brokenContacts = {list(brokenContacts)}, allowed: at least two of"
            " each, > 0"
        )
    if any(broken != int(broken) for broken in brokenContacts):
        raise CaseError(f"brokenContacts = {list(brokenContacts)}, allowed: whole numbers")
    if not 0 < stress <= 0.2 * bondStrength:
        raise CaseError(f"stress = {stress} Pa, allowed: 0 < stress <= 0.2 bondStrength = {0.2 * bondStrength:g} Pa")
    found = {"lattice": {"tests": []}, "samples": {"tests": []}}
    for broken in brokenContacts:
        across = int(columns) + (int(columns) - int(broken)) % 2
        lattice = sediment.changed(sample, rMax=sample.rMin, grading=None, friction=0.0)
        found["lattice"]["tests"].append(
            run.result(
                f"square lattice, {int(broken)} broken contacts",
                lambda: latticeTest(lattice, int(broken), across, 2 * (int(columns) // 2), stress, bondStrength),
            )
        )
    for seed in range(sample.seed, sample.seed + seeds):
        one = sediment.changed(sample, seed=seed)
        found["samples"]["tests"] += run.result(
            f"settled sample, seed {seed}",
            lambda: [{**t, "seed": seed} for t in sampleTest(one, halfLengths, stress, bondStrength, run)],
        )
    for kind in found.values():
        kind.update(fit(kind["tests"], stress, bondStrength))
    found["latticeError"] = max(abs(t["pressure"] / t["expected"] - 1) for t in found["lattice"]["tests"])
    return {**found, "stress": stress, "bondStrength": bondStrength}


def drawToughness(found, path):
    """Pressure against the length of the crack, lattice and samples, with LEFM (alpha = 1) and the fits; and as lines
    1/p against sqrt(a).
    """
    with newFigure((7.4, 3.3)) as figure:
        left, right = figure.subplots(
            1, 2, gridspec_kw={"left": 0.085, "right": 0.985, "bottom": 0.16, "top": 0.95, "wspace": 0.28}
        )
        sizes = []
        for name, colour, marker in (("lattice", COLOURS["dot"], "s"), ("samples", COLOURS["compression"], "o")):
            one = found[name]
            size = np.array(
                [t["halfLength"] / t["radius"] * finiteWidth(t["halfLength"], t["width"]) ** 2 for t in one["tests"]]
            )
            p = (np.array([t["pressure"] for t in one["tests"]]) - found["stress"]) / found["bondStrength"]
            sizes += list(size)
            label = {"lattice": "square lattice", "samples": "settled samples"}[name]
            left.plot(size, p, marker, color=colour, markersize=4.5, markerfacecolor="none", label=label)
            right.plot(np.sqrt(size), 1 / p, marker, color=colour, markersize=4.5, markerfacecolor="none")
            line = np.linspace(0.9 * size.min(), 1.1 * size.max(), 60)
            # Cracks of settled samples scatter too much to tell c from 0.
            alpha, c = (one["alpha"], one["c"]) if name == "lattice" else (one["alphaLEFM"], 0.0)
            inverse = np.sqrt(line / alpha) - c
            left.plot(line[inverse > 0], 1 / inverse[inverse > 0], color=colour, linewidth=1.0)
            right.plot(
                np.sqrt(line),
                inverse,
                color=colour,
                linewidth=1.0,
                label=f"{label}: $\\alpha$ = {alpha:.2f}, c = {c:.2g}",
            )
            if name == "lattice":
                left.plot(
                    size,
                    [(t["expected"] - found["stress"]) / found["bondStrength"] for t in one["tests"]],
                    "+",
                    color="black",
                    markersize=8,
                    label="linear lattice",
                )
        line = np.linspace(0.8 * min(sizes), 1.2 * max(sizes), 60)
        left.plot(line, line**-0.5, color="0.5", linestyle=(0, (4, 3)), linewidth=1.0, label="LEFM, $\\alpha$ = 1")
        right.plot(np.sqrt(line), np.sqrt(line), color="0.5", linestyle=(0, (4, 3)), linewidth=1.0)
        left.set(xscale="log", yscale="log", xlabel="$a f^2/r$", ylabel="$(P - \\sigma')/\\sigma_c$")
        right.set(xlabel="$\\sqrt{a f^2/r}$", ylabel="$\\sigma_c/(P - \\sigma')$", xlim=(0, None), ylim=(0, None))
        for axes in (left, right):
            axes.legend(fontsize=7, frameon=False)
            axes.tick_params(labelsize=8, which="both")
            for side in ("top", "right"):
                axes.spines[side].set_visible(False)
        plain = matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}")
        for axis in (left.xaxis, left.yaxis):
            axis.set_major_formatter(plain)
            axis.set_minor_formatter(
                matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}" if f"{value:e}"[0] in "25" else "")
            )
        saveFigure(figure, path)
