# SPDX-License-Identifier: GPL-2.0-or-later
"""One-dimensional flow through a sample: permeability, storage and the diffusion of pressure (Table 1, Figures 11 and
12).

The grains stand still. The pores along the bottom are held at pressure 0, those along the top are set to a pressure at
time 0, and the pressure diffuses downwards, c_v dp/dt = (k/mu) d2p/dx2 (Eq. 17). H is the distance between the pores at
which the pressures are prescribed, which is a pore less than the box. Permeability (Eq. 23) follows from the steady
flow,

    k = mu H Q/(W w Delta p),

and the storage c_v [1/Pa] from the outflow, as in the paper (Eq. 24): by Eq. 22 the flow that is missing on the way to
the steady state, the integral of 1 - Q_out/Q over tau = t/T_c, T_c = c_v mu H^2/k, is 1/6. The integral is taken
because steps of time do not change it; the time at which half of the flow has come, tau = 0.1388, is late by half a
step. In a network it is a sum over the pores, too,

    T_c = 6 (Delta p/(K_f Q)) sum V p (1 - p),      p: steady pressure over Delta p,

so T_c is known before the diffusion is run. In rigid grains c_v K_f is the porosity (the paper's Table 1 prints the
header c_v/K_f, which has no dimension of its own): that between the pores with prescribed pressures, which are
reservoirs and store nothing; and along walls a sample has more void than inside.

How pores and layers are compared with Eq. 20 is told in :mod:`capfrac.lab.profiles`.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab import schemes
from capfrac.lab.compaction import prepareSample
from capfrac.lab.profiles import HALF_TIME, PROFILE_TIMES, profileAt, profileErrors, rateErrors, withEquations
from capfrac.lab.run import LabRun
from capfrac.lab.transient import steadyFlow, stepEnds, transient
from capfrac.scene import sediment
from capfrac.values import requirePositive


def diffusion(
    sample,
    stress=100e3,
    pressure=1e3,
    bulkModulus=1e7,
    viscosity=1e-3,
    conductanceFactor=1.0,
    timeIntegration="implicit",
    steps=400,
    halvings=0,
    explicitGrains=0,
    run=None,
):
    """Measure permeability and storage of a new sample and follow the diffusion of pressure; a dict. The scene is
    replaced.

    ``stress`` of the (isotropic) preparation [Pa]; ``pressure`` Delta p [Pa]; the fluid's ``bulkModulus`` [Pa] and
    ``viscosity`` [Pa s], finite; ``timeIntegration`` 'implicit' or 'explicit'; ``steps`` >= 50 of time up to tau = 1.5,
    longer as time goes on, and shorter where 'explicit' asks for it. With ``halvings`` 2 to 5 the steps are halved as
    often to see how the implicit scheme converges, 0: not. On a second sample, of ``explicitGrains`` >= 10 grains, the
    explicit scheme runs beside the implicit one, 0: not. :class:`CaseError` for impossible values.

    Of the sample: ``permeability`` k [m^2], ``kOverR2`` (over r_min^2), ``porosity`` of the box, ``porosityBetween``
    the pores of prescribed pressure, ``height`` H and ``width`` [m], mean ``diameter`` [m], ``steadyFlow`` [m^3/s],
    ``grains`` and ``pores``. Of the storage: ``characteristicTime`` T_c [s], ``storage`` c_v [1/Pa],
    ``storageTimesBulkModulus``, ``storageOfNetwork`` (c_v from the sum over the pores) and ``storageAtHalf`` (from the
    time of half the outflow) [1/Pa]. Of the diffusion: ``rates`` (tau, in- and outflow over the steady flow, and Eqs.
    21, 22), ``rateErrors`` (see :func:`capfrac.lab.profiles.rateErrors`), ``profiles`` (:func:`profiles.profileAt` at
    each of :data:`capfrac.lab.profiles.PROFILE_TIMES`), ``profileErrors``, ``layerErrors``, ``scatterErrors`` and
    ``placeErrors`` (see :func:`capfrac.lab.profiles.profileErrors`), ``ledger`` (relative error of the fluid's mass),
    ``convergence`` and ``schemes`` (of :func:`schemes.convergence` and :func:`schemes.compareSchemes`, or None).
    """
    run = run or LabRun("diffusion", {})
    requirePositive(
        pressure=pressure, bulkModulus=bulkModulus, viscosity=viscosity, conductanceFactor=conductanceFactor
    )
    if timeIntegration not in ("implicit", "explicit"):
        raise CaseError(f"timeIntegration = {timeIntegration!r}, allowed: 'implicit', 'explicit'")
    if steps < 50:
        raise CaseError(f"steps = {steps}, allowed: >= 50")
    if halvings != 0 and not 2 <= halvings <= 5:
        raise CaseError(f"halvings = {halvings}, allowed: 0, or 2 to 5")
    if explicitGrains != 0 and explicitGrains < 10:
        raise CaseError(f"explicitGrains = {explicitGrains}, allowed: 0, or >= 10")
    walls = [math.nan, math.nan, 0.0, pressure]
    fluid = {
        "bulkModulus": bulkModulus,
        "viscosity": viscosity,
        "conductanceFactor": conductanceFactor,
        "wallPressures": walls,
    }

    def measure():
        run.stage("sample", lambda: prepareSample(sample, stress, run))
        steady, ends = steadyFlow(fluid), stepEnds(steps)
        run.report("diffusion")
        found = _evaluate(steady, transient(fluid, steady, timeIntegration, ends), fluid)
        found["kOverR2"] = found["permeability"] / sample.rMin**2
        found["convergence"] = (
            schemes.convergence(fluid, steady, ends, halvings) if halvings and timeIntegration == "implicit" else None
        )
        return found

    def compare():
        return schemes.compareSchemes(sediment.changed(sample, grainCount=explicitGrains), stress, fluid, run)

    found = run.result("diffusion", measure)
    return {**found, "schemes": run.result("schemes", compare) if explicitGrains else None}


def _evaluate(steady, found, fluid):
    rates = withEquations(found["rates"])
    expected, measured = steady["characteristicTime"], 6 * steady["characteristicTime"] * found["missing"]
    half = expected * float(np.interp(0.5, rates["outflow"], rates["tau"])) / HALF_TIME
    perTime = steady["permeability"] / (fluid["viscosity"] * steady["height"] ** 2)  # c_v/T_c
    profiles = [profileAt(tau, pressure, steady) for tau, pressure in zip(PROFILE_TIMES, found["pressures"])]
    sample = {name: value for name, value in steady.items() if not isinstance(value, np.ndarray)}
    return {
        **sample,
        "characteristicTime": measured,
        "storage": perTime * measured,
        "storageTimesBulkModulus": perTime * measured * fluid["bulkModulus"],
        "storageOfNetwork": perTime * expected,
        "storageAtHalf": perTime * half,
        "steps": found["steps"],
        "rates": rates,
        "rateErrors": rateErrors(rates),
        "profiles": profiles,
        **profileErrors(profiles),
        "ledger": found["ledger"],
    }
