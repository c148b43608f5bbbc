# SPDX-License-Identifier: GPL-2.0-or-later
"""The one free parameter: the contact stiffness for a requested compression index."""

import math

import numpy as np

from capfrac.errors import CaseError, SampleError
from capfrac.lab.box import INERTIAL_NUMBER
from capfrac.lab.compaction import LARGEST_STRAIN, Compaction, compact, compressionSlope
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import exactText, isPositive, shown

#: Steps of the search for a stiffness before it gives up.
LARGEST_SEARCH = 8


def findStiffness(
    sample,
    compressionIndex,
    fitFrom=100e3,
    fitTo=1e6,
    voidRatio=None,
    preload=10e3,
    tolerance=0.01,
    inertialNumber=INERTIAL_NUMBER,
    run=None,
):
    """The k_n [N/m] (k_s = k_n stays in its ratio) whose compaction has the requested C_c; a dict.

    k_n is the one free parameter, as in the paper. A pack of disks with linear contacts looks the same at the same
    stress over k_n, so one curve, its stresses scaled, tells where to look; a compaction at the stiffness found
    confirms or corrects it, until C_c is within ``tolerance`` (relative). The dict holds ``normalStiffness``, ``Cc``,
    ``error`` (relative), ``tried`` (all pairs) and ``compaction``. Raises :class:`SampleError` when the search does not
    end, :class:`CaseError` for a C_c that no stiffness gives.
    """
    run = run or LabRun("fit", {})
    if not isPositive(compressionIndex):
        raise CaseError(f"compressionIndex = {shown(compressionIndex)}, allowed: > 0")
    ratio, stiffness, tried = sample.shearStiffness / sample.normalStiffness, sample.normalStiffness, []
    for _ in range(LARGEST_SEARCH):
        other = sediment.changed(sample, normalStiffness=stiffness, shearStiffness=ratio * stiffness)
        # To a fixed strain: the curve serves for other stiffnesses, too.
        found = Compaction(
            **run.result(
                f"k_n {exactText(stiffness, '.6g')} N/m",
                lambda: compact(
                    other,
                    preload,
                    LARGEST_STRAIN,
                    (),
                    voidRatio=voidRatio,
                    fitFrom=fitFrom,
                    fitTo=fitTo,
                    inertialNumber=inertialNumber,
                    untilStress=fitTo if tried else None,
                    run=run,
                ).asDict(),
            )
        )
        tried.append((stiffness, found.Cc))
        if math.isfinite(found.Cc) and abs(found.Cc / compressionIndex - 1) <= tolerance:
            return {
                "normalStiffness": stiffness,
                "Cc": found.Cc,
                "error": found.Cc / compressionIndex - 1,
                "tried": tried,
                "compaction": found.asDict(),
            }
        stiffness = _nextStiffness(found, tried, compressionIndex, stiffness)
    raise SampleError(f"no k_n was found for C_c = {compressionIndex:g} within {LARGEST_SEARCH} compactions: {tried}")


def _nextStiffness(found, tried, wanted, stiffness):
    finite = [(k, c) for k, c in tried if math.isfinite(c)]
    if len(finite) >= 2 and finite[-1][1] != finite[-2][1]:  # secant through the last two, in logarithms
        (k1, c1), (k2, c2) = finite[-2:]
        slope = math.log(c2 / c1) / math.log(k2 / k1)
        return k2 * math.exp(math.log(wanted / c2) / slope)
    strain, stress = np.array(found.table["strain [-]"]), np.array(found.table["stressV [Pa]"])
    scales = np.geomspace(1e-4, 1e4, 2001)
    slopes = np.array(
        [
            (1 + found.voidRatio) * compressionSlope(strain, stress * scale, found.fitFrom, found.fitTo)
            for scale in scales
        ]
    )
    good = np.isfinite(slopes)
    if not good.any() or not (slopes[good].min() <= wanted <= slopes[good].max()):
        within = f"{slopes[good].min():.3g} to {slopes[good].max():.3g}" if good.any() else "none"
        raise CaseError(
            f"compressionIndex = {wanted:g} cannot be met between {found.fitFrom:g} and {found.fitTo:g} Pa with strains"
            f" up to {LARGEST_STRAIN}: within reach: {within} (at the void ratio {found.voidRatio:.3g})"
        )
    # C_c falls with the stiffness where grains deform little; of several crossings the stiffest is that one.
    crossing = [
        k
        for k in range(len(scales) - 1)
        if good[k] and good[k + 1] and (slopes[k] - wanted) * (slopes[k + 1] - wanted) <= 0
    ][-1]
    part = (
        (slopes[crossing] - wanted) / (slopes[crossing] - slopes[crossing + 1])
        if slopes[crossing] != slopes[crossing + 1]
        else 0
    )
    return stiffness * float(scales[crossing] * (scales[crossing + 1] / scales[crossing]) ** part)
