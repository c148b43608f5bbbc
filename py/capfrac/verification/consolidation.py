# SPDX-License-Identifier: GPL-2.0-or-later
"""Consolidation of a water-filled sample in one and in two dimensions, against Terzaghi's and Mandel's solutions.

A bonded sample under an isotropic stress is loaded suddenly by a small additional stress on its roof. *Terzaghi*: fixed
sides, drained roof; it settles as its water leaves. *Mandel*: between tight plates, drained at its sides, which stay at
their stress; in the middle the pressure first rises, because the sides soften and hand load over. The solutions
(:mod:`~capfrac.theory.poroelasticity`) have no free number: stiffnesses, Biot's coefficients, Biot's modulus and
permeabilities are measured on the very sample (:func:`measureMaterial`).

The fluid's viscosity follows from ``steps``, the number of time steps in which the sample is to consolidate: it has to
be slow against the waves that run through the grains.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.compaction import prepareSample
from capfrac.lab.fluid import drainedAt
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.scene.packing import hexagonal
from capfrac.theory.poroelasticity import (
    Material,
    mandel,
    mandelPeak,
    mandelPressure,
    terzaghi,
    terzaghiDegree,
    terzaghiPressure,
)
from capfrac.values import isPositive, shown
from capfrac.verification.material import measureMaterial

#: Time factor c t/H^2 at which the tests end.
LAST_TIME = {"terzaghi": 2.0, "mandel": 0.4}

#: Share of the steps over which the load is put on, evenly; time counts from the middle of it. A sudden one makes
#: waves, which in a block that is free at its sides swing on until the pressure is at its peak.
RAMP = {"terzaghi": 0.0, "mandel": 0.015}

#: Rows of a test, at times that grow geometrically.
ROWS = 120

#: The pressure is averaged over this share of the length from the base or the middle: pores differ from their
#: neighbours, because a load changes the shape of each in its own way.
WINDOW = {"terzaghi": 0.1, "mandel": 0.2}

#: Pressures in the middle, over p0, at which times are compared as they fall.
FALLEN = (0.95, 0.9, 0.85, 0.8)

#: Degrees of consolidation at which time factors are compared.
DEGREES = (0.25, 0.5, 0.75, 0.9)


def consolidation(
    sample,
    kind="terzaghi",
    stress=100e3,
    load=5e3,
    bulkModulus=2.2e9,
    bondStrength=1e6,
    arrangement="hexagonal",
    steps=60_000,
    run=None,
):
    """Measure a new sample's material, load it, and compare with theory; a dict.

    ``kind`` 'terzaghi' or 'mandel'; isotropic ``stress`` [Pa] of the preparation; additional ``load`` [Pa]; fluid
    ``bulkModulus`` [Pa]; ``bondStrength`` sigma_c = tau_c [Pa]; ``arrangement`` of the grains: 'settled' by gravity, or
    'hexagonal', equal grains of radius rMin on a lattice, whose pores all answer alike; ``steps`` of time until the
    time factor of :data:`LAST_TIME`. The dict holds ``material`` (see :class:`Material`), ``viscosity`` [Pa s],
    ``diffusivity`` c [m^2/s], ``length`` of drainage [m], ``p0`` [Pa], lists ``T``, ``pressure`` (over p0: at the base,
    or in the middle) and ``pressureExpected``, ``ledger`` (relative error of the water's mass); for 'terzaghi'
    ``degree`` and ``degreeExpected``, ``timeRatios`` (measured over theoretical time at :data:`DEGREES`) and
    ``settlement`` and ``settlementExpected`` at the end [m]; for 'mandel' ``kappa``, ``undrainedRatio`` (undrained
    pressure in the middle, measured over p0), ``peak`` (over the measured undrained pressure), ``peakTime`` and both
    ``Expected``, and ``timeRatios`` as the pressure falls to :data:`FALLEN`. :class:`CaseError` for impossible values.
    """
    run = run or LabRun(kind, {})
    if kind not in LAST_TIME:
        raise CaseError(f"kind = {kind!r}, allowed: {', '.join(LAST_TIME)}")
    for name, value in (("load", load), ("bulkModulus", bulkModulus)):
        if not isPositive(value):
            raise CaseError(f"{name} = {shown(value)}, allowed: > 0")
    if arrangement not in ("settled", "hexagonal"):
        raise CaseError(f"arrangement = {arrangement!r}, allowed: 'settled', 'hexagonal'")
    if steps < 1000:
        raise CaseError(f"steps = {steps}, allowed: >= 1000")

    def prepare():
        prepareSample(
            sample,
            stress,
            run,
            hexagonal(sample.grainCount, sample.rMin, sample.aspect) if arrangement == "hexagonal" else None,
        )
        sediment.bond(tensileStrength=bondStrength, shearStrength=bondStrength)
        sediment.relax(unbalanced=1e-6)

    material = Material(
        **run.result("material", lambda: (run.stage("sample", prepare), measureMaterial(load, bulkModulus))[1])
    )
    return run.result(
        kind, lambda: (run.stage("sample", prepare), _load(kind, material, load, bulkModulus, steps, run))[1]
    )


def _load(kind, material, load, bulkModulus, steps, run):
    from yade import O
    from yade.wrapper import SinglePhaseFlowEngine

    drained = ("top",) if kind == "terzaghi" else ("left", "right")
    pressures = [0.0 if name in drained else math.nan for name in ("left", "right", "bottom", "top")]

    def begin():
        flow = sediment.insertFluid(
            SinglePhaseFlowEngine(label="flow", maxSizeRatio=100, bulkModulus=bulkModulus, wallPressures=pressures)
        )
        servo = sediment.engine("servo")
        servo.fixedWalls = ["bottom", "left", "right"] if kind == "terzaghi" else ["bottom"]
        sediment.advance(1)
        run.data.update(T=[], pressure=[], settlement=[], **_geometry(kind, flow))
        theory = _theory(kind, material, 1.0, load, run.data)
        # At viscosity 1 the diffusivity is c_1: c = c_1/viscosity, and T_end = c steps dt/H^2.
        flow.viscosity = theory["diffusivity"] * steps * O.dt / (LAST_TIME[kind] * run.data["length"] ** 2)
        run.data.update(viscosity=flow.viscosity, height0=float(sediment.boxSize()[1]))
        parts = 200 if RAMP[kind] > 0 else 1
        for _ in range(parts):
            servo.stressY += load / parts
            sediment.advance(round(RAMP[kind] * steps / parts))
        run.data["start"] = O.iter - round(0.5 * RAMP[kind] * steps)

    run.stage("load", begin)
    theory = _theory(kind, material, run.data["viscosity"], load, run.data)
    ends = np.unique(np.geomspace(max(10, steps // 4000, 0.6 * RAMP[kind] * steps), steps, ROWS).astype(int))

    def consolidate():
        for end in ends[len(run.data["T"]) :]:
            sediment.advance(int(run.data["start"] + end - O.iter))
            _record(kind, theory, run.data)
            run.report(
                f"{kind}: time factor {run.data['T'][-1]:.3f} of {LAST_TIME[kind]}, pressure"
                f" {run.data['pressure'][-1]:.4g} Pa"
            )
            run.tick()

    run.stage("consolidate", consolidate)
    found = {
        "material": material.asDict(),
        "viscosity": run.data["viscosity"],
        "length": run.data["length"],
        **theory,
        "T": run.data["T"],
        "pressure": (np.array(run.data["pressure"]) / theory["p0"]).tolist(),
        "ledger": float(sediment.engine("flow").volumes()["error"]),
    }
    return {**found, **(_evaluateTerzaghi if kind == "terzaghi" else _evaluateMandel)(found, theory, run.data)}


def _geometry(kind, flow):
    """Length of drainage, and for Mandel's problem the middle and the half-width of the plates [m]."""
    walls = sediment.wallBodies()
    if kind == "terzaghi":
        return {
            "length": drainedAt(flow, 1, 0.0) - walls["bottom"].state.pos[1],
            "height": float(sediment.boxSize()[1]),
        }
    pores = flow.pores()
    x, volume, drained = np.array(pores["x"]), np.array(pores["volume"]), np.array(pores["pressure"]) == 0.0
    middle = 0.5 * (walls["left"].state.pos[0] + walls["right"].state.pos[0])
    return {
        "length": float(np.average(np.abs(x - middle)[drained], weights=volume[drained])),
        "middle": middle,
        "halfWidth": 0.5 * float(sediment.boxSize()[0]),
    }


def _theory(kind, material, viscosity, load, geometry):
    if kind == "terzaghi":
        return terzaghi(material, viscosity, geometry["length"], load, geometry["height"])
    return mandel(material, viscosity, geometry["halfWidth"], load, geometry["length"])


def _record(kind, theory, data):
    """A row: time factor, pressure at the base or in the middle, settlement."""
    from yade import O

    pores, walls = sediment.engine("flow").pores(), sediment.wallBodies()
    distance = (
        np.array(pores["y"]) - walls["bottom"].state.pos[1]
        if kind == "terzaghi"
        else np.abs(np.array(pores["x"]) - data["middle"])
    )
    near = distance < WINDOW[kind] * data["length"]
    data["T"].append(float(theory["diffusivity"] * (O.iter - data["start"]) * O.dt / data["length"] ** 2))
    data["pressure"].append(
        float(np.average(np.array(pores["pressure"])[near], weights=np.array(pores["volume"])[near]))
    )
    data["settlement"].append(data["height0"] - float(sediment.boxSize()[1]))


def _evaluateTerzaghi(found, theory, data):
    T, settlement = np.array(found["T"]), np.array(data["settlement"])
    degree = (settlement - theory["settlement0"]) / (theory["settlement"] - theory["settlement0"])
    fine = np.geomspace(1e-4, 3, 20_000)
    times = [float(np.interp(U, degree, T) / np.interp(U, terzaghiDegree(fine), fine)) for U in DEGREES]
    return {
        "degree": degree.tolist(),
        "degreeExpected": terzaghiDegree(T).tolist(),
        "timeRatios": times,
        "settlementMeasured": float(settlement[-1]),
        "settlementExpected": float(
            theory["settlement0"] + terzaghiDegree(T[-1])[0] * (theory["settlement"] - theory["settlement0"])
        ),
        "pressureExpected": [float(terzaghiPressure(1 - np.linspace(0, WINDOW["terzaghi"], 11), t).mean()) for t in T],
    }


def _evaluateMandel(found, theory, data):
    # The edges of a sample of some ten grains across are softer than its middle, which then bears more than its share
    # from the beginning: the rise is compared with the undrained pressure that the first rows show.
    T, p = np.array(found["T"]), np.array(found["pressure"])
    expected = mandelPressure(np.linspace(0, WINDOW["mandel"], 11), T, theory["kappa"]).mean(axis=0)
    early = T < 0.3 * mandelPeak(theory["kappa"])[1]
    ratio = float((p[early] / expected[early]).mean())
    peak, peakTime = mandelPeak(theory["kappa"])
    return {
        "pressureExpected": expected.tolist(),
        "undrainedRatio": ratio,
        "peak": float(p.max() / ratio),
        "peakTime": float(T[int(p.argmax())]),
        "peakExpected": peak,
        "peakTimeExpected": peakTime,
        "timeRatios": _fallTimes(T, p / ratio, expected),
    }


def _fallTimes(T, measured, expected):
    """Measured over theoretical time at which the pressure in the middle has fallen to :data:`FALLEN` of p0, after its
    peak; those reached by both.
    """
    ratios = []
    for level in FALLEN:
        curves = [np.array(curve)[int(np.argmax(curve)) :] for curve in (measured, expected)]
        if all(curve[-1] <= level for curve in curves):
            times = [float(np.interp(-level, -curve, T[len(T) - len(curve) :])) for curve in curves]
            ratios.append(times[0] / times[1])
    return ratios
