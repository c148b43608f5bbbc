# SPDX-License-Identifier: GPL-2.0-or-later
"""Samples that are shaken with water in them: their energy."""

import math

import numpy as np

from capfrac.lab.compaction import prepareSample
from capfrac.lab.run import LabRun
from capfrac.scene import sediment

#: Rows of a run.
ROWS = 200

#: Energy over that at the start beyond which a run counts as blown up.
BLOWN_UP = 1e3


def energy():
    """Energy of motion and of the contacts' normal and shear springs in the current scene [J]."""
    from yade import O

    motion = sum(
        0.5 * body.state.mass * body.state.vel.squaredNorm() + 0.5 * body.state.inertia[2] * body.state.angVel[2] ** 2
        for body in sediment.grainBodies()
    )
    springs = 0.0
    for contact in O.interactions:
        if contact.isReal:
            phys = contact.phys
            springs += 0.5 * phys.normalForce.squaredNorm() / phys.kn + (
                0.5 * phys.shearForce.squaredNorm() / phys.ks if phys.ks > 0 else 0.0
            )
    return motion, springs


def shake(
    sample,
    bulkModulus,
    scheme="undrainedStable",
    steps=100_000,
    stress=100e3,
    bondStrength=1e6,
    speed=0.1,
    viscosity=1e6,
    run=None,
):
    """Shake a sealed sample with water of ``bulkModulus`` [Pa], None: dry; a dict.

    ``scheme``: timeIntegration of the engine; ``speed`` of the grains at the start [m/s], in random directions; the
    bonds of ``bondStrength`` [Pa] hold, so the contacts are springs. The dict holds ``steps`` (at the rows), ``energy``
    and ``motion`` (over the energy of motion at the start; the springs' without those of the preload), ``ledger``
    (relative error of the water's mass), ``pressure`` (largest magnitude [Pa]), ``end``: 'bounded', 'blown up' or the
    error that ended it, and ``stepsDone``.
    """
    run = run or LabRun("shake", {})
    run.stage("sample", lambda: _bonded(sample, stress, bondStrength, run))
    run.stage("start", lambda: _startShaking(sample, bulkModulus, scheme, speed, viscosity, run))
    data = run.data

    def go():
        from yade import O

        # Rows at times that grow geometrically: what blows up does so in the first steps.
        ends = np.unique(np.geomspace(1, steps, ROWS).astype(int))
        for end in ends[len(data["steps"]) - 1 :]:
            if data["end"] != "":
                return
            try:
                sediment.advance(int(data["begin"] + end - O.iter))
                _rowOfShaking(bulkModulus, data)
            except (RuntimeError, ValueError) as problem:  # a grain has left the box: the network says which
                data["end"], data["stepsDone"] = str(problem), O.iter - data["begin"]
                return
            run.report(
                f"shaking, K_f = {bulkModulus}: step {data['steps'][-1]}, energy {data['energy'][-1]:.4g} of that at"
                " the start"
            )
            run.tick()

    run.stage("shake", go)
    # A grain that flies off is refused by the network: unbounded, too.
    end = data["end"] or ("blown up" if not max(data["energy"]) < BLOWN_UP else "bounded")
    return {name: data[name] for name in ("steps", "energy", "motion", "ledger", "pressure")} | {
        "end": end,
        "stepsDone": data.get("stepsDone", data["steps"][-1]),
    }


def _bonded(sample, stress, bondStrength, run):
    prepareSample(sample, stress, run)
    sediment.bond(tensileStrength=bondStrength, shearStrength=bondStrength)
    sediment.relax(unbalanced=1e-6)


def _startShaking(sample, bulkModulus, scheme, speed, viscosity, run):
    from yade import O
    from yade.wrapper import SinglePhaseFlowEngine

    servo = sediment.engine("servo")
    servo.fixedWalls = ["left", "right", "bottom", "top"]
    sediment.advance(1)
    sediment.engine("newton").damping = 0.0
    random = np.random.default_rng(sample.seed)
    for body in sediment.grainBodies():
        vx, vy = random.normal(0, speed / math.sqrt(2), 2)
        body.state.vel = (vx, vy, 0)
    if bulkModulus is not None:
        sediment.insertFluid(
            SinglePhaseFlowEngine(
                label="flow", maxSizeRatio=100, bulkModulus=bulkModulus, viscosity=viscosity, timeIntegration=scheme
            )
        )
    motion, springs = energy()
    run.data.update(
        scale=motion,
        springs=springs,
        begin=O.iter,
        steps=[0],
        energy=[1.0],
        motion=[1.0],
        ledger=[0.0],
        pressure=[0.0],
        end="",
    )


def _rowOfShaking(bulkModulus, data):
    from yade import O

    motion, springs = energy()
    data["steps"].append(O.iter - data["begin"])
    data["energy"].append((motion + springs - data["springs"]) / data["scale"])
    data["motion"].append(motion / data["scale"])
    flow = sediment.engine("flow") if bulkModulus is not None else None
    data["ledger"].append(float(flow.volumes()["error"]) if flow else 0.0)
    data["pressure"].append(float(np.max(np.abs(flow.pores()["pressure"]))) if flow else 0.0)
    if not data["energy"][-1] < BLOWN_UP:
        data["end"] = "blown up"
