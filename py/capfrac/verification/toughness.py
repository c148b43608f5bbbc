# SPDX-License-Identifier: GPL-2.0-or-later
"""Fracture toughness: the gas pressure at which a crack of known length begins to grow, against linear elastic fracture
mechanics (LEFM).

A bonded sample gets a straight horizontal crack of half-length a in its middle: the contacts that it crosses lose their
bonds. Gas is let into the pores of the crack and nowhere else (its interfacial tension is so high that no throat takes
it), and its pressure rises slowly until a bond at a tip breaks. With sigma the stress on all walls,

    P - sigma = sigma_c sqrt(alpha r/a),    K_Ic = (P - sigma) sqrt(pi a) f = sigma_c sqrt(pi alpha r),

f being the correction for the width of the box (:func:`capfrac.theory.lattice_crack.finiteWidth`), alpha >= 1 a number
of the packing (Potyondy & Cundall 2004). A pressure in the crack does not stretch the sample ahead of it as a pull from
outside would: it lacks the uniform part of the stress, which counts when the crack is only some grains long. With that
part c the bond at the tip breaks at

    P - sigma = sigma_c/(sqrt(a f^2/(alpha r)) - c),

a line 1/p = sqrt(a f^2/r)/sqrt(alpha) - c in p = (P - sigma)/sigma_c. c is 0 in LEFM; for the square lattice
:mod:`lattice_crack` gives it.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.theory.lattice_crack import finiteWidth, tipForces
from capfrac.verification.crack import _ramp, besideContacts, crackedContacts, openCrack, pressurise
from capfrac.verification.handmade import squareLattice

#: Where the ramp of the pressure begins and ends and its increment, as shares of P - sigma of the linear lattice, and
#: of LEFM with alpha = 1 [-].
LATTICE_RAMP, SAMPLE_RAMP = (0.8, 1.3, 0.01), (0.5, 6.0, 0.04)


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
