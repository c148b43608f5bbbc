"""One-dimensional flow through a sample: permeability, storage and the diffusion of pressure (Table 1, Figures 11 and 12).

The grains stand still. The pores along the bottom are held at pressure 0, those along the top are set to a pressure at
time 0, and the pressure diffuses downwards, c_v dp/dt = (k/mu) d2p/dx2 (Eq. 17). H is the distance between the pores at which the
pressures are prescribed, which is a pore less than the box. Permeability (Eq. 23) follows from the steady flow,

    k = mu H Q/(W w Delta p),

and the storage c_v [1/Pa] from the time at which the outflow is half of the steady one, tau = t k/(c_v mu H^2) = 0.1388. In
rigid grains c_v K_f is the porosity (the paper's Table 1 prints the header c_v/K_f, which has no dimension of its own).
"""

import math

import numpy as np

from capfrac import sediment
from capfrac.errors import CaseError
from capfrac.lab.compaction import prepareSample
from capfrac.lab.run import LabRun

#: Times at which Figure 12 shows the pressure, in units of T_c = c_v mu H^2/k [-].
PROFILE_TIMES = (0.000242, 0.00671, 0.0275, 0.0829, 0.175, 1.404)
#: Time at which Eq. 22 has reached half of the steady outflow [-].
HALF_TIME = 0.13879
_TERMS = np.arange(1, 2001)


def pressureProfile(xi, tau):
    """Eq. 20: pressure over Delta p at the distance ``xi`` (over H, from the end at pressure 0) and time ``tau``."""
    xi = np.atleast_1d(np.asarray(xi, dtype=float))[:, None]
    series = (-1.0) ** _TERMS / _TERMS * np.sin(_TERMS * math.pi * xi) * np.exp(-((_TERMS * math.pi) ** 2) * tau)
    return xi[:, 0] + 2 / math.pi * series.sum(axis=1)


def flowRates(tau):
    """Eqs. 21 and 22: inflow and outflow over the steady flow at time ``tau`` > 0."""
    decay = np.exp(-((_TERMS * math.pi) ** 2) * tau)
    return 1 + 2 * float(decay.sum()), 1 + 2 * float(((-1.0) ** _TERMS * decay).sum())


def diffusion(sample, stress=100e3, pressure=1e3, bulkModulus=1e7, viscosity=1e-3, conductanceFactor=1.0, timeIntegration="implicit", steps=400, run=None):
    """Measure permeability and storage of a new sample and follow the diffusion of pressure; a dict.

    ``stress`` of the (isotropic) preparation [Pa]; ``pressure`` Delta p [Pa]; the fluid's ``bulkModulus`` [Pa] and ``viscosity``
    [Pa s]; ``steps`` of time up to tau = 1.5 for the scheme 'implicit', longer as time goes on. The dict holds ``permeability`` [m^2], ``kOverR2``
    (over r_min^2), ``storage`` c_v [1/Pa], ``storageTimesBulkModulus``, ``porosity``, ``height`` H and ``width`` [m], ``rates`` (tau, in- and outflow over
    the steady flow, and Eqs. 21, 22), ``profiles`` (for each of :data:`PROFILE_TIMES` the pores' xi and pressure over Delta p, and Eq. 20's),
    ``profileErrors`` (largest difference, over Delta p), ``ledger`` (relative error of the fluid's mass). :class:`CaseError` for impossible values.
    """
    run = run or LabRun("diffusion", {})
    if steps < 50:
        raise CaseError(f"steps = {steps}, allowed: >= 50")
    run.stage("sample", lambda: prepareSample(sample, stress, run))
    fluid = {"bulkModulus": bulkModulus, "viscosity": viscosity, "conductanceFactor": conductanceFactor, "wallPressures": [math.nan, math.nan, 0.0, pressure]}
    steady = _steady(fluid, pressure, viscosity)
    rates, profiles, ledger = _transient(fluid, steady, pressure, bulkModulus, viscosity, timeIntegration, steps)
    unit = steady["porosity"] / bulkModulus * viscosity * steady["height"] ** 2 / steady["permeability"]  # T_c if c_v were porosity/K_f
    half = float(np.interp(0.5, rates["outflow"], np.array(rates["tau"]) * unit))
    storage = steady["permeability"] * half / HALF_TIME / (viscosity * steady["height"] ** 2)
    return {**steady, "kOverR2": steady["permeability"] / sample.rMin**2, "storage": storage, "storageTimesBulkModulus": storage * bulkModulus, "rates": rates,
            "profiles": profiles, "profileErrors": [float(np.max(np.abs(np.subtract(p["pressure"], p["expected"])))) for p in profiles], "ledger": ledger}


def _flowAlone(fluid, scheme):
    from yade import O
    from yade.wrapper import SinglePhaseFlowEngine

    engine = SinglePhaseFlowEngine(timeIntegration=scheme, maxSizeRatio=100, **fluid)
    O.engines = [engine]
    return engine


def _steady(fluid, pressure, viscosity):
    """Geometry, permeability and porosity, from one step that is longer than any diffusion."""
    from yade import O

    flow = _flowAlone({**fluid, "bulkModulus": math.inf}, "implicit")
    O.step()
    pores, walls = flow.pores(), sediment.wallBodies()
    width = walls["right"].state.pos[0] - walls["left"].state.pos[0]
    y, p, volume = (np.array(pores[name]) for name in ("y", "pressure", "volume"))
    low, high = (float(np.average(y[at], weights=volume[at])) for at in (p == 0.0, p == pressure))
    box = width * (walls["top"].state.pos[1] - walls["bottom"].state.pos[1])
    flux = flow.inflow()["top"]
    return {"permeability": viscosity * (high - low) * flux / (width * pressure), "porosity": float(volume.sum() / box), "height": high - low, "width": width,
            "bottom": low, "steadyFlow": flux, "grains": len(sediment.grainBodies()), "pores": len(y)}


def _transient(fluid, steady, pressure, bulkModulus, viscosity, scheme, steps):
    from yade import O

    unit = steady["porosity"] / bulkModulus * viscosity * steady["height"] ** 2 / steady["permeability"]
    flow = _flowAlone(fluid, scheme)
    rates = {name: [] for name in ("tau", "inflow", "outflow", "expectedInflow", "expectedOutflow")}
    profiles, tau = [], 0.0
    ends = sorted(set(np.geomspace(1e-5, 1.5, steps)) | set(PROFILE_TIMES))
    for end in ends:
        substeps = 1
        if scheme == "explicit":
            substeps = max(1, math.ceil((end - tau) * unit / (0.9 * flow.explicitTimeStepLimit())))
        O.dt = (end - tau) * unit / substeps
        sediment.advance(substeps)
        tau = end
        inflow = flow.inflow()
        for name, value in zip(rates, (tau, inflow["top"] / steady["steadyFlow"], -inflow["bottom"] / steady["steadyFlow"], *flowRates(tau))):
            rates[name].append(float(value))
        if end in PROFILE_TIMES:
            pores = flow.pores()
            xi = (np.array(pores["y"]) - steady["bottom"]) / steady["height"]
            profiles.append({"tau": tau, "xi": xi.tolist(), "pressure": (np.array(pores["pressure"]) / pressure).tolist(),
                             "expected": pressureProfile(np.clip(xi, 0, 1), tau).tolist()})
    return rates, profiles, float(flow.volumes()["error"])
