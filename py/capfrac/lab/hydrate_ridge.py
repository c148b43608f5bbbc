# SPDX-License-Identifier: GPL-2.0-or-later
"""Hydrate Ridge: the model's compaction against what is reported of the sediment (Figure 10).

Reported (Tan, Germaine & Flemings 2006, Proc. ODP Sci. Results 204, doi:10.2973/odp.proc.sr.204.102.2006, abstract;
Site 1244, eight whole-core samples from 5 to 136 mbsf): compression index C_c 0.340-0.704, average 0.568; recompression
index C_r 0.035-0.064, average 0.052. The curves of the laboratory are not public in that text, so none is drawn here:
the comparison is with the range of slopes. Indices are read as void ratio per tenfold stress (an inference: the
symbols, and 0.009 (LL - 10) = 0.64 for the liquid limit of 81).

Strains are what a two-dimensional pack and a clay have in common; the void ratio of the sediment turns them into
indices. Its default, 1.5, is that of the porosity model of Hydrate Ridge at about 80 mbsf (0.60), computed, not
measured.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.io.tables import Column, readTable
from capfrac.lab import compaction, stiffness
from capfrac.lab.box import INERTIAL_NUMBER
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import exactText

#: Reported indices [-]: smallest, largest, average.
CC_REPORTED = (0.340, 0.704, 0.568)
CR_REPORTED = (0.035, 0.064, 0.052)
#: Strain at the end of the runs, and of the loops in them [-], as in the paper.
STRAIN, LOOPS = 0.25, (0.05, 0.10, 0.15, 0.20)


def hydrateRidge(
    sample,
    voidRatio=1.5,
    preload=10e3,
    fitFrom=100e3,
    fitTo=1e6,
    laboratory=None,
    inertialNumber=INERTIAL_NUMBER,
    run=None,
):
    """Fit k_n to the reported average C_c, compact with loops at the fit, and compare with the reported ranges; a dict.

    ``stiffness``: k_n [N/m] fitted to the average, and those for the ends of the range; ``compactions``: a
    :class:`~capfrac.lab.compaction.Compaction` as a dict of each; ``local``: where the slope of the average's curve
    lies in the reported range; ``laboratory``: curves of the user's own (see :func:`readLaboratory`); ``verdict``: in
    words.
    """
    run = run or LabRun("hydrate-ridge", {})
    curve = readLaboratory(laboratory, voidRatio) if laboratory else None
    if curve and (min(curve["stress"]) > fitTo or max(curve["stress"]) < fitFrom):
        run.warn(
            f"the laboratory curve {laboratory} runs from {min(curve['stress']):g} to {max(curve['stress']):g} "
            f"Pa, outside of the fitted stresses, {fitFrom:g} to {fitTo:g} Pa; are its stresses in kPa? Then name "
            "its column stress [kPa]"
        )
    fits = {}
    for name, index in (("average", CC_REPORTED[2]), ("stiffest", CC_REPORTED[0]), ("softest", CC_REPORTED[1])):
        start = fits["average"]["normalStiffness"] * CC_REPORTED[2] / index if fits else sample.normalStiffness
        ratio = sample.shearStiffness / sample.normalStiffness
        run.report(f"searching k_n for C_c = {index:g}")
        fits[name] = stiffness.findStiffness(
            sediment.changed(sample, normalStiffness=start, shearStiffness=ratio * start),
            index,
            fitFrom,
            fitTo,
            voidRatio,
            preload,
            0.02,
            inertialNumber,
            run,
        )
    compactions = {}
    for name, fit in fits.items():
        k = fit["normalStiffness"]
        other = sediment.changed(
            sample, normalStiffness=k, shearStiffness=k * sample.shearStiffness / sample.normalStiffness
        )
        loops = f"compaction with loops, k_n {exactText(k, '.6g')} N/m"
        compactions[name] = run.result(
            loops,
            lambda: compaction.compact(
                other,
                preload,
                STRAIN,
                LOOPS,
                voidRatio=voidRatio,
                fitFrom=fitFrom,
                fitTo=None,
                inertialNumber=inertialNumber,
                run=run,
            ).asDict(),
        )
    result = {
        "stiffness": {name: fit["normalStiffness"] for name, fit in fits.items()},
        "Cc": {name: fit["Cc"] for name, fit in fits.items()},
        "fits": fits,
        "compactions": compactions,
        "laboratory": curve,
        "voidRatio": voidRatio,
        "reported": {"Cc": CC_REPORTED, "Cr": CR_REPORTED},
        "local": inReportedRange(compactions["average"]),
    }
    result["verdict"] = verdict(result)
    return result


def localIndex(found, points=60, window=0.3):
    """Local C_c of a compaction (as a dict) against stress: arrays of stress [Pa] and -de/dlog10(sigma) [-].

    The slope of a least-squares line through the virgin curve within ``window`` decades.
    """
    branch = np.array(found["table"]["branch"])
    strain, stress = (np.array(found["table"][name])[branch == "virgin"] for name in ("strain [-]", "stressV [Pa]"))
    low, high = math.log10(stress[0]) + window / 2, math.log10(stress.max()) - window / 2
    at = np.linspace(low, high, points)
    slopes = [compaction.compressionSlope(strain, stress, 10 ** (a - window / 2), 10 ** (a + window / 2)) for a in at]
    return 10**at, (1 + found["voidRatio"]) * np.array(slopes)


def inReportedRange(found):
    """Stresses [Pa] between which the local C_c lies within the reported range: [from, to], or [] if nowhere."""
    stress, index = localIndex(found)
    inside = stress[(index >= CC_REPORTED[0]) & (index <= CC_REPORTED[1])]
    return [float(inside.min()), float(inside.max())] if len(inside) else []


def verdict(result):
    """What agrees with the reported ranges and what does not, in words: a list of sentences."""
    low, high, average = CC_REPORTED
    text = [
        f"Compression: with k_n = {result['stiffness']['average']:.3g} N/m the model has C_c ="
        f" {result['Cc']['average']:.3f} between the fitted stresses, the reported average ({average}); k_n from"
        f" {result['stiffness']['softest']:.3g} to {result['stiffness']['stiffest']:.3g} N/m spans the reported range"
        f" ({low}-{high}). This is a fit of one parameter, not a prediction."
    ]
    if result["local"]:
        a, b = result["local"]
        text.append(
            f"Shape: the slope is inside the reported range from {a:.3g} to {b:.3g} Pa only. It grows with stress, for"
            " contacts are linear springs: a clay's is about constant over decades of stress."
        )
    else:
        text.append("Shape: the slope lies nowhere inside the reported range.")
    loops = result["compactions"]["average"]["loops"]
    if loops:
        indices = [loop["Cr"] for loop in loops]
        inside = [CR_REPORTED[0] <= c <= CR_REPORTED[1] for c in indices]
        agreement = "agrees" if all(inside) else "does not agree" if not any(inside) else "agrees in part"
        text.append(
            f"Unloading: C_r from {min(indices):.3f} to {max(indices):.3f}, reported {CR_REPORTED[0]}-{CR_REPORTED[1]}:"
            f" {agreement}. C_r/C_c is {np.mean(indices) / result['Cc']['average']:.2f} against a reported 0.09: the"
            " sediment becomes much stiffer on unloading than the model, as the paper says of its own model."
            if not all(inside)
            else f"Unloading: C_r from {min(indices):.3f} to {max(indices):.3f}, within the reported range."
        )
        text.append(
            f"Loops: {loops[-1]['recovered']:.0%} of the strain is recovered when unloaded from"
            f" {loops[-1]['strain']:.0%}; hysteresis {loops[-1]['hysteresis']:.0%} of the work of reloading."
        )
    if result["laboratory"] is None:
        text.append("No laboratory curve is drawn: none was given, and none is public. Give your own as a CSV.")
    return text


#: What a laboratory curve is made of.
COLUMNS = (
    Column("stress", "Pa", {"stressV": "1"}, low=0, openLow=True),
    Column("strain", "-", high=1, optional=True),
    Column("voidRatio", "-", low=0, openLow=True, optional=True),
)


def readLaboratory(path, voidRatio):
    """A laboratory curve of a file with the columns stress and strain or voidRatio: a dict.

    ``stress`` [Pa] and ``strain`` [-]; the strain is that of the file where it has one, else it follows from
    ``voidRatio`` [-] at the preload. ``name``: the file. Raises :class:`CaseError` naming file, line and column; see
    :mod:`capfrac.io.tables` for what is read.
    """
    table = readTable(path, COLUMNS, "the laboratory curve")
    if "strain" in table.values:
        strain = table.values["strain"]
    elif "voidRatio" in table.values:
        strain = 1 - (1 + table.values["voidRatio"]) / (1 + voidRatio)
    else:
        raise CaseError(f"{path}: neither strain nor voidRatio among the columns; needed: strain [-] or voidRatio [-]")
    return {"stress": table.values["stress"].tolist(), "strain": strain.tolist(), "name": str(path)}
