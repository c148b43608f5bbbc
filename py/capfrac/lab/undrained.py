"""Undrained uniaxial compaction of a sealed, water-filled sample (Figure 13) and its Biot coefficient.

The sample is brought to an isotropic stress with its water drained, bonded where asked for, sealed, and compressed between
fixed side walls. The total stress sigma exceeds that of the same sample without water by the load that the water bears,
sigma - b p = sigma_dry (Eq. 25): b is the slope of a least-squares line through (p, sigma - sigma_dry) at equal strains.
"""

import math

import numpy as np

from capfrac import sediment
from capfrac.errors import CaseError
from capfrac.lab.box import Box
from capfrac.lab.compaction import prepareSample
from capfrac.lab.run import LabRun


def undrained(sample, stress=100e3, strain=0.01, bulkModulus=1e7, viscosity=1e-3, bondStrength=1e6, inertialNumber=5e-5, run=None):
    """Compress the same sample dry and sealed; a dict.

    ``stress`` of the preparation [Pa]; ``strain`` at the end; fluid ``bulkModulus`` [Pa] and ``viscosity`` [Pa s]; ``bondStrength``
    sigma_c = tau_c [Pa], 0: none. The dict holds ``strain`` [-], ``total``, ``dry``, ``pressure`` (mean over the voids) and ``effective`` =
    sigma - b p [Pa]; ``biot`` b and ``biotError`` (standard error); ``misfit``, largest |sigma - b p - sigma_dry| over the largest sigma_dry;
    ``ledger``, relative error of the water's mass. :class:`CaseError` for impossible values.
    """
    run = run or LabRun("undrained", {})
    for name, value in (("strain", strain), ("bulkModulus", bulkModulus), ("viscosity", viscosity)):
        if not (value > 0 and (math.isfinite(value) or name == "bulkModulus")):
            raise CaseError(f"{name} = {value}, allowed: > 0")
    curves = {}
    for name, fluid in (("dry", None), ("sealed", {"bulkModulus": bulkModulus, "viscosity": viscosity})):
        curves[name] = run.result(name, lambda: _compact(sample, stress, strain, bondStrength, inertialNumber, fluid, run))
    # At the strains of the dry rows: the speed, and so the rows, differ in the last digits.
    at = np.array(curves["dry"]["strain"])
    dry = np.array(curves["dry"]["stress"])
    total, pressure = (np.interp(at, curves["sealed"]["strain"], curves["sealed"][name]) for name in ("stress", "pressure"))
    excess = (total - total[0]) - (dry - dry[0])
    rise = pressure - pressure[0]
    biot = float((rise * excess).sum() / (rise * rise).sum())
    residual = excess - biot * rise
    error = math.sqrt((residual**2).sum() / max(len(at) - 1, 1) / (rise * rise).sum())
    effective = total - biot * pressure
    return {"strain": at.tolist(), "total": total.tolist(), "dry": dry.tolist(), "pressure": pressure.tolist(), "effective": effective.tolist(), "biot": biot,
            "biotError": error, "misfit": float(np.max(np.abs(effective - dry)) / dry.max()), "ledger": curves["sealed"]["ledger"],
            "porosity": curves["sealed"]["porosity"]}


def _compact(sample, stress, strain, bondStrength, inertialNumber, fluid, run):
    from yade import O
    from yade.wrapper import SinglePhaseFlowEngine

    box = Box(sample, run, inertialNumber)

    def prepare():
        prepareSample(sample, stress, run)
        if bondStrength > 0:
            sediment.bond(tensileStrength=bondStrength, shearStrength=bondStrength)
        if fluid:
            flow = SinglePhaseFlowEngine(label="flow", maxSizeRatio=100, **fluid)
            engines = list(O.engines)
            engines.insert(engines.index(sediment.engine("servo")), flow)
            O.engines = engines
            flow.prepare()
        box.setReference()
        box.mode("uniaxial")
        run.data.update(stress=[], strain=[], pressure=[])

    def measure(row=None):
        # A halt before each row: the stress on the walls is then that of grains and water at rest, not of waves.
        sediment.advance(200)
        pressure = _meanPressure() if fluid else 0.0
        servo = sediment.engine("servo")
        for name, value in (("stress", 0.5 * (servo.stress[2] + servo.stress[3])), ("strain", box.strain()), ("pressure", pressure)):
            run.data[name].append(float(value))

    run.stage("sample", prepare)
    run.stage("start", measure)
    for number in range(1, 21):
        run.stage(f"load {number}", lambda: (box.strainTo(strain * number / 20, spacing=strain / 20), measure()))
    flow = sediment.engine("flow") if fluid else None
    volumes = flow.volumes() if fluid else None
    width, height = box.lengths()
    return {"stress": run.data["stress"], "strain": run.data["strain"], "pressure": run.data["pressure"], "ledger": volumes["error"] if fluid else 0.0,
            "porosity": volumes["void"] / (width * height) if fluid else math.nan}


def _meanPressure():
    pores = sediment.engine("flow").pores()
    return float(np.average(pores["pressure"], weights=pores["volume"]))
