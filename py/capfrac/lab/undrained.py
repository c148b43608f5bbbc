# SPDX-License-Identifier: GPL-2.0-or-later
"""Undrained uniaxial compaction of a sealed, water-filled sample (Figure 13): Biot's and Skempton's coefficients.

The sample is brought to an isotropic stress with its water drained, bonded where asked for, sealed, and compressed
between fixed side walls. The total stress sigma exceeds that of the same sample without water by the load that the
water bears, sigma - b p = sigma_dry (Eq. 25): b is the slope of a least-squares line through (p, sigma - sigma_dry) at
equal strains.

From the dry run follow the moduli in the plane, K = (sigma_V + sigma_H)/(2 eps) and G = (sigma_V - sigma_H)/(2 eps);
from the sealed one the Biot modulus M = dp/(b d eps) and Skempton's coefficient B = dp/d(mean stress). Theory
(Detournay & Cheng 1993, in two dimensions, where by Eq. 10 a grain's area gives way by 2/(3 K_s)):

    1/M = phi/K_f + (b - phi) 2/(3 K_s),    B = b M/(K + b^2 M),    b = b_rigid - 2 K/(3 K_s)

b_rigid, that of grains which no pressure compresses, would be 1 if grains touched in points.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.box import Box
from capfrac.lab.compaction import prepareSample
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import isPositive, shown

#: Rows of a compaction.
ROWS = 20


def undrained(
    sample,
    stress=100e3,
    strain=0.01,
    bulkModulus=1e7,
    viscosity=1e-3,
    bondStrength=1e6,
    grainBulkModulus=None,
    inertialNumber=5e-5,
    run=None,
):
    """Compress the same sample dry and sealed; a dict.

    ``stress`` of the preparation [Pa]; ``strain`` at the end; fluid ``bulkModulus`` [Pa] and ``viscosity`` [Pa s];
    ``bondStrength`` sigma_c = tau_c [Pa], 0: none; ``grainBulkModulus`` K_s [Pa]: if given, the sealed sample is
    compressed a second time with grains that the water compresses. The dict holds ``strain`` [-], ``total``, ``dry``,
    ``pressure`` (mean over the voids) and ``effective`` = sigma - b p [Pa]; ``biot`` b and ``biotError`` (standard
    error); ``misfit``, largest |sigma - b p - sigma_dry| over the largest sigma_dry; ``skempton`` B and
    ``skemptonExpected``, ``biotModulus`` M and ``biotModulusExpected`` [Pa], ``bulkModulusDry`` K and
    ``shearModulusDry`` G [Pa], ``porosity`` phi, ``ledger``, relative error of the water's mass; and with K_s under
    ``compressible`` the same of those grains, with ``biotExpected``. :class:`CaseError` for impossible values.
    """
    run = run or LabRun("undrained", {})
    for name, value in (
        ("strain", strain),
        ("bulkModulus", bulkModulus),
        ("viscosity", viscosity),
        ("grainBulkModulus", grainBulkModulus or 1.0),
    ):
        if not isPositive(value) and not (name == "bulkModulus" and value == math.inf):
            raise CaseError(f"{name} = {shown(value)}, allowed: > 0")
    fluids = {"dry": None, "sealed": {"bulkModulus": bulkModulus, "viscosity": viscosity}}
    if grainBulkModulus is not None:
        fluids["compressible"] = {**fluids["sealed"], "grainBulkModulus": grainBulkModulus}
    curves = {
        name: run.result(name, lambda: _compact(sample, stress, strain, bondStrength, inertialNumber, fluid, run))
        for name, fluid in fluids.items()
    }
    moduli = _moduli(curves["dry"])
    found = {**moduli, **_evaluate(curves["dry"], curves["sealed"], moduli, bulkModulus, math.inf)}
    if "compressible" in curves:
        found["compressible"] = _evaluate(curves["dry"], curves["compressible"], moduli, bulkModulus, grainBulkModulus)
        found["compressible"]["biotExpected"] = found["biot"] - 2 * moduli["bulkModulusDry"] / (3 * grainBulkModulus)
    return found


def _moduli(dry):
    """Moduli in the plane from stresses at the walls in a uniaxial compaction."""
    vertical, lateral = (_slope(dry["strain"], dry[name]) for name in ("stress", "lateral"))
    return {"bulkModulusDry": 0.5 * (vertical + lateral), "shearModulusDry": 0.5 * (vertical - lateral)}


def _slope(x, y):
    return float(np.polyfit(x, y, 1)[0])


def _evaluate(dryCurves, sealed, moduli, fluidModulus, grainModulus):
    # At the strains of the dry rows: the speed, and so the rows, differ in the last digits.
    at, dry = np.array(dryCurves["strain"]), np.array(dryCurves["stress"])
    total, lateral, pressure = (
        np.interp(at, sealed["strain"], sealed[name]) for name in ("stress", "lateral", "pressure")
    )
    excess = (total - total[0]) - (dry - dry[0])
    rise = pressure - pressure[0]
    biot = float((rise * excess).sum() / (rise * rise).sum())
    residual = excess - biot * rise
    error = math.sqrt((residual**2).sum() / max(len(at) - 1, 1) / (rise * rise).sum())
    effective = total - biot * pressure
    K, porosity = moduli["bulkModulusDry"], sealed["porosity"]
    expected = 1 / (porosity / fluidModulus + (biot - porosity) * 2 / (3 * grainModulus))
    return {
        "strain": at.tolist(),
        "total": total.tolist(),
        "dry": dry.tolist(),
        "pressure": pressure.tolist(),
        "effective": effective.tolist(),
        "biot": biot,
        "biotError": error,
        "misfit": float(np.max(np.abs(effective - dry)) / dry.max()),
        "skempton": _slope(0.5 * (total + lateral), pressure),
        "skemptonExpected": biot * expected / (K + biot**2 * expected),
        "biotModulus": _slope(at, pressure) / biot,
        "biotModulusExpected": expected,
        "ledger": sealed["ledger"],
        "porosity": porosity,
    }


def _compact(sample, stress, strain, bondStrength, inertialNumber, fluid, run):
    from yade.wrapper import SinglePhaseFlowEngine

    box = Box(sample, run, inertialNumber)

    def prepare():
        prepareSample(sample, stress, run)
        if bondStrength > 0:
            sediment.bond(tensileStrength=bondStrength, shearStrength=bondStrength)
        if fluid:
            sediment.insertFluid(SinglePhaseFlowEngine(label="flow", maxSizeRatio=100, **fluid)).prepare()
        box.setReference()
        box.mode("uniaxial")
        run.data.update(stress=[], lateral=[], strain=[], pressure=[])

    def measure():
        # A halt before each row: the stress on the walls is then that of grains and water at rest, not of waves.
        sediment.advance(200)
        lateral, vertical = sediment.wallStresses()
        pressure = meanPressure() if fluid else 0.0
        for name, value in (
            ("stress", vertical),
            ("lateral", lateral),
            ("strain", box.strain()),
            ("pressure", pressure),
        ):
            run.data[name].append(float(value))

    run.stage("sample", prepare)
    run.stage("start", measure)
    for number in range(1, ROWS + 1):
        run.stage(f"load {number}", lambda: (box.strainTo(strain * number / ROWS, spacing=strain / ROWS), measure()))
    volumes = sediment.engine("flow").volumes() if fluid else None
    width, height = box.lengths()
    return {
        **{name: run.data[name] for name in ("stress", "lateral", "strain", "pressure")},
        "ledger": volumes["error"] if fluid else 0.0,
        "porosity": volumes["void"] / (width * height) if fluid else math.nan,
    }


def meanPressure():
    """Mean over the voids of the pressure in the engine ``flow`` [Pa]."""
    pores = sediment.engine("flow").pores()
    return float(np.average(pores["pressure"], weights=pores["volume"]))
