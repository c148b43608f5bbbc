# SPDX-License-Identifier: GPL-2.0-or-later
"""Macroscopic properties against microscopic parameters: does grain size matter, and which parameter does what.

With strengths by Eq. 5 and constant stiffnesses the model has no length but the grain's: stresses over k_n and
strengths in stress units decide alone, so the macroscopic properties do not depend on the grain size (the paper's claim
after Eq. 5). :func:`sizes` shows it by running it; :func:`sensitivity` says which parameter to turn in a calibration.

All tests of a table begin with one settled packing, scaled to the grain size. Even so, grains that slide make a
difference in the last digit large, and two samples of 300 grains differ by some 10 % in every property: a scatter that
has nothing to do with the grain size. Sizes that differ by powers of two round alike, so they leave it out: their runs
agree to the last bit if, and only if, no other length is hidden in the model.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab import biaxial
from capfrac.lab.box import INERTIAL_NUMBER
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import isPositive, shown

#: Smallest radii from 1.2 um to 1 cm, powers of two apart [m].
RADII = tuple(1e-2 / 2**n for n in (13, 10, 7, 3, 0))
#: Macroscopic properties of a table.
PROPERTIES = ("youngModulus", "poissonRatio", "frictionAngle", "cohesion")


def sizes(
    sample,
    radii=RADII,
    stresses=(20e3, 50e3, 100e3),
    strain=0.08,
    bondStrength=100e3,
    inertialNumber=INERTIAL_NUMBER,
    run=None,
):
    """Macroscopic properties for several smallest radii [m]: a dict.

    ``table``: ``rMin [m]`` and :data:`PROPERTIES`; ``spread``: of each property (largest - smallest) / mean [-].
    """
    run = run or LabRun("sizes", {})
    if not radii or not all(map(isPositive, radii)):
        raise CaseError(f"radii = {shown(list(radii))}, allowed: numbers > 0")
    found = [
        biaxial.biaxial(
            sediment.changed(sample, rMin=r, rMax=r * sample.rMax / sample.rMin),
            stresses,
            strain,
            bondStrength,
            inertialNumber,
            settledPacking(sample, run, r),
            run,
        )
        for r in radii
    ]
    table = {"rMin [m]": list(map(float, radii)), **{name: [one[name] for one in found] for name in PROPERTIES}}
    return {"table": table, "spread": {name: spread(table[name]) for name in PROPERTIES}}


def settledPacking(sample, run, rMin=None):
    """The sample's grains after settling, (x, y, r) [m], with the smallest radius scaled to ``rMin``; settled once in a
    run.
    """
    scale = 1.0 if rMin is None else rMin / sample.rMin

    def settle():
        sediment.placeSample(sample)
        sediment.settle(sample)
        return [
            [float(v) for v in column]
            for column in zip(*((*tuple(body.state.pos)[:2], body.shape.radius) for body in sediment.grainBodies()))
        ]

    return tuple(scale * np.array(column) for column in run.result("settled packing", settle))


def spread(values):
    """(largest - smallest) / mean of the values [-]."""
    mean = sum(values) / len(values)
    return (max(values) - min(values)) / abs(mean) if mean else math.inf


def sensitivity(
    sample,
    factor=2.0,
    stresses=(20e3, 50e3, 100e3),
    strain=0.08,
    bondStrength=100e3,
    inertialNumber=INERTIAL_NUMBER,
    run=None,
):
    """How each macroscopic property answers to each microscopic parameter: a dict.

    Each of k_n (with k_s in its ratio), k_s/k_n, friction, bond strength and r_min is divided and multiplied by
    ``factor`` > 1, the others kept; what the reference sample shares is run once. ``table``: parameter, value, and
    :data:`PROPERTIES`; ``exponent``: parameter -> property -> n where the property goes like parameter^n between the
    two ends (NaN where it changes its sign).
    """
    run = run or LabRun("sensitivity", {})
    if not (isPositive(factor) and factor > 1):
        raise CaseError(f"factor = {shown(factor)}, allowed: > 1")
    rows = {"parameter": [], "value": [], **{name: [] for name in PROPERTIES}}
    exponents = {}
    for parameter, value, make in _variants(sample, bondStrength):
        ends = []
        for scale in (1 / factor, 1.0, factor):
            other, strength = make(value * scale)
            found = biaxial.biaxial(
                other, stresses, strain, strength, inertialNumber, settledPacking(sample, run, other.rMin), run
            )
            rows["parameter"].append(parameter)
            rows["value"].append(value * scale)
            for name in PROPERTIES:
                rows[name].append(found[name])
            ends.append(found)
        exponents[parameter] = {name: _exponent(ends[0][name], ends[-1][name], factor**2) for name in PROPERTIES}
    return {"table": rows, "exponent": exponents}


def _variants(sample, bondStrength):
    """Parameter, its value in the reference, and value -> (sample, bond strength)."""
    ratio = sample.shearStiffness / sample.normalStiffness
    return (
        (
            "normalStiffness [N/m]",
            sample.normalStiffness,
            lambda k: (sediment.changed(sample, normalStiffness=k, shearStiffness=k * ratio), bondStrength),
        ),
        (
            "shearStiffness / normalStiffness",
            ratio,
            lambda q: (sediment.changed(sample, shearStiffness=q * sample.normalStiffness), bondStrength),
        ),
        ("friction", sample.friction, lambda mu: (sediment.changed(sample, friction=mu), bondStrength)),
        ("bondStrength [Pa]", bondStrength, lambda strength: (sample, strength)),
        (
            "rMin [m]",
            sample.rMin,
            lambda r: (sediment.changed(sample, rMin=r, rMax=r * sample.rMax / sample.rMin), bondStrength),
        ),
    )


def _exponent(low, high, ratio):
    return math.log(high / low) / math.log(ratio) if low > 0 and high > 0 else math.nan
