# SPDX-License-Identifier: GPL-2.0-or-later
"""Biaxial tests: from contacts to Young's modulus, Poisson's ratio, friction angle and cohesion.

A sample is brought to an isotropic stress, bonded where asked for, and compressed vertically while the side walls keep
their stress; once for each confining stress. The moduli are those of a two-dimensional solid,
E = d(sigma_V)/d(eps_V) and nu = -d(eps_H)/d(eps_V) at constant sigma_H (plane-stress form: for plane strain of a
three-dimensional solid take nu' = nu/(1+nu), E' = E (1-nu'^2)). Strength follows from the peaks by Mohr and Coulomb,
sigma_V = sigma_H tan^2(45 deg + phi/2) + 2 c tan(45 deg + phi/2), a least-squares line.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.box import INERTIAL_NUMBER, Box
from capfrac.lab.compaction import prepareSample
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import exactText, isNotNegative, isPositive, shown

#: Share of the largest deviator up to which the moduli are taken [-]: before grains slide on a large scale.
ELASTIC_SHARE = 0.25


def biaxialTest(sample, stress, strain=0.08, bondStrength=0.0, inertialNumber=INERTIAL_NUMBER, packing=None, run=None):
    """One test at the confining ``stress`` [Pa] up to ``strain``; a dict.

    ``bondStrength``: sigma_c = tau_c of Eq. 5 [Pa], bonds set at the isotropic state; 0: none. ``packing``
    (x, y, r) [m]: grains to begin with, instead of settling new ones. The dict holds ``table``
    (columns of :data:`capfrac.lab.box.COLUMNS`), ``peak`` and ``residual`` (vertical stress [Pa]), ``strainAtPeak``,
    ``youngModulus`` [Pa], ``poissonRatio``, ``bonds`` and ``brokenBonds``, ``quasiStatic``. Raises :class:`CaseError`
    for impossible values.
    """
    run = run or LabRun("biaxial", {})
    for name, value, good, allowed in (
        ("stress", stress, isPositive, "> 0"),
        ("strain", strain, isPositive, "> 0"),
        ("bondStrength", bondStrength, isNotNegative, ">= 0"),
    ):
        if not good(value):
            raise CaseError(f"{name} = {shown(value)}, allowed: {allowed}")
    box = Box(sample, run, inertialNumber)

    def prepare():
        prepareSample(sample, stress, run, packing)
        if bondStrength > 0:
            sediment.bond(tensileStrength=bondStrength, shearStrength=bondStrength)
        box.setReference()
        box.mode("biaxial", stressH=stress)
        box.record("virgin")

    run.stage("sample", prepare)
    # Finer rows at first: the elastic part is short.
    run.stage("elastic", lambda: box.strainTo(0.05 * strain, spacing=0.0005 * strain))
    run.stage("shear", lambda: box.strainTo(strain, spacing=0.01 * strain))
    return evaluate(box.rows, stress, run.data["reference"]["bonds"], box.quasiStatic())


def evaluate(rows, stress, bonds=0, quasiStatic=None):
    """Read moduli and strength from the rows of a test at the confining ``stress`` [Pa]; see :func:`biaxialTest`."""
    axial, lateral, vertical = (np.array(rows[name]) for name in ("strain [-]", "lateralStrain [-]", "stressV [Pa]"))
    peak = int(np.argmax(vertical))
    deviator = vertical - vertical[0]
    elastic = np.flatnonzero(deviator >= ELASTIC_SHARE * deviator[peak])[0] + 1
    elastic = max(elastic, 3)
    young = np.polyfit(axial[:elastic], vertical[:elastic], 1)[0]
    poisson = -np.polyfit(axial[:elastic], lateral[:elastic], 1)[0]
    last = vertical[axial >= 0.9 * axial[-1]]
    return {
        "table": {name: list(values) for name, values in rows.items()},
        "stress": float(stress),
        "peak": float(vertical[peak]),
        "strainAtPeak": float(axial[peak]),
        "residual": float(last.mean()),
        "youngModulus": float(young),
        "poissonRatio": float(poisson),
        "bonds": bonds,
        "brokenBonds": int(rows["brokenBonds"][-1]),
        "quasiStatic": quasiStatic or {},
    }


def mohrCoulomb(confining, peak):
    """Friction angle [degrees] and cohesion [Pa] of the least-squares line through peaks: a dict, with ``residual``.

    ``residual``: largest distance of a peak from the line over the peak [-]. Raises :class:`CaseError` for fewer than
    two confining stresses.
    """
    if len(set(confining)) < 2:
        raise CaseError(f"stresses = {list(confining)}, allowed: at least two different confining stresses")
    slope, offset = np.polyfit(confining, peak, 1)
    line = slope * np.asarray(confining) + offset
    angle = 2 * (math.atan(math.sqrt(max(slope, 0.0))) - math.pi / 4)
    return {
        "frictionAngle": math.degrees(angle),
        "cohesion": float(offset / (2 * math.sqrt(slope))) if slope > 0 else math.nan,
        "residual": float(np.max(np.abs(line - peak) / np.asarray(peak))),
    }


def biaxial(
    sample,
    stresses=(20e3, 50e3, 100e3),
    strain=0.08,
    bondStrength=0.0,
    inertialNumber=INERTIAL_NUMBER,
    packing=None,
    run=None,
):
    """Biaxial tests at several confining ``stresses`` [Pa]; a dict.

    ``tests``: of each stress the dict of :func:`biaxialTest`; ``frictionAngle`` [degrees] and ``cohesion`` [Pa] from
    the peaks; ``youngModulus`` [Pa] and ``poissonRatio``, means over the tests.
    """
    run = run or LabRun("biaxial", {})
    if len(set(stresses)) < 2:
        raise CaseError(f"stresses = {list(stresses)}, allowed: at least two different confining stresses")
    bonds = f"bonds {_exact(bondStrength)} Pa" if bondStrength > 0 else "no bonds"
    tests = [
        run.result(
            f"{_label(sample)}, {bonds}, confined at {_exact(stress)} Pa",
            lambda: biaxialTest(sample, stress, strain, bondStrength, inertialNumber, packing, run),
        )
        for stress in sorted(stresses)
    ]
    strength = mohrCoulomb([test["stress"] for test in tests], [test["peak"] for test in tests])
    return {
        "tests": tests,
        **strength,
        "youngModulus": float(np.mean([test["youngModulus"] for test in tests])),
        "poissonRatio": float(np.mean([test["poissonRatio"] for test in tests])),
    }


def _label(sample):
    """What tells samples of one run apart."""
    return (
        f"r_min {_exact(sample.rMin)} m, k_n {_exact(sample.normalStiffness)} N/m, "
        f"k_s {_exact(sample.shearStiffness)} N/m, mu {_exact(sample.friction)}, {sample.grainCount} grains, "
        f"seed {sample.seed}"
    )


def _exact(value):
    return exactText(value, "g")
