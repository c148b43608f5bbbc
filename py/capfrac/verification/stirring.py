# SPDX-License-Identifier: GPL-2.0-or-later
"""Samples that are stirred with water in them: flips, and the books of the mass."""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.compaction import prepareSample
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.verification.shaking import ROWS

MOTIONS = ("piston", "shear")


def stir(
    sample,
    motion="piston",
    steps=100_000,
    strain=0.25,
    stress=100e3,
    bulkModulus=2.2e9,
    viscosity=1e-3,
    inertialNumber=1e-2,
    localFlips=True,
    run=None,
):
    """Move the roof up and down between 0 and ``strain`` for ``steps`` of time, water flowing through the floor; a
    dict.

    ``motion``: one of :data:`MOTIONS`; isotropic ``stress`` of the preparation, and of the sides in shear [Pa]. The
    dict holds lists ``steps``, ``strain``, ``ledger`` (relative error of the water's mass), ``flips``, ``smallest``
    (smallest pore over the mean one), ``pressure`` (largest magnitude [Pa]), and ``flipsTotal``, ``rebuilds``,
    ``negativeCells`` (void below zero in a single cell, at the rows), ``massDefect`` (sum of in - out - stored over the
    water there is).
    """
    run = run or LabRun("stir", {})
    if motion not in MOTIONS:
        raise CaseError(f"motion = {motion!r}, allowed: {', '.join(MOTIONS)}")
    if not 0 < strain < 0.4:
        raise CaseError(f"strain = {strain}, allowed: 0 < strain < 0.4")
    run.stage("sample", lambda: prepareSample(sample, stress, run))
    run.stage(
        "start", lambda: _startStirring(sample, motion, stress, bulkModulus, viscosity, inertialNumber, localFlips, run)
    )
    data = run.data

    def go():
        from yade import O

        while O.iter - data["begin"] < steps:
            servo = sediment.engine("servo")
            now = 1 - sediment.boxSize()[1] / data["height"]
            if now >= strain or now <= 0:
                servo.driveVelocity = math.copysign(data["speed"], strain / 2 - now)
            sediment.advance(min(50, steps - (O.iter - data["begin"])))
            if (O.iter - data["begin"]) % (max(1, round(steps / ROWS / 50)) * 50) == 0:
                _rowOfStirring(data)
                run.report(
                    f"{motion}: step {data['steps'][-1]}, strain {data['strain'][-1]:.1%}, flips {data['flips'][-1]}"
                )
                run.tick()

    run.stage("stir", go)
    flow = sediment.engine("flow")
    return {name: data[name] for name in ("steps", "strain", "ledger", "flips", "smallest", "pressure")} | {
        "flipsTotal": flow.nFlips,
        "rebuilds": flow.nRebuilds,
        "negativeCells": data["negativeCells"],
        "massDefect": flow.massDefect / flow.initialWater,
    }


def _startStirring(sample, motion, stress, bulkModulus, viscosity, inertialNumber, localFlips, run):
    from yade import O
    from yade.wrapper import SinglePhaseFlowEngine

    sediment.insertFluid(
        SinglePhaseFlowEngine(
            label="flow",
            maxSizeRatio=100,
            bulkModulus=bulkModulus,
            viscosity=viscosity,
            localFlips=localFlips,
            wallPressures=[math.nan, math.nan, 0.0, math.nan],
        )
    )
    servo = sediment.engine("servo")
    servo.drivenWalls, servo.fixedWalls = ["top"], ["bottom", "left", "right"] if motion == "piston" else ["bottom"]
    rate = inertialNumber / (sample.rMin + sample.rMax) * math.sqrt(stress / sample.density)
    servo.driveVelocity = rate * sediment.boxSize()[1]
    run.data.update(
        begin=O.iter,
        height=sediment.boxSize()[1],
        speed=servo.driveVelocity,
        steps=[],
        strain=[],
        ledger=[],
        flips=[],
        smallest=[],
        pressure=[],
        negativeCells=0,
    )


def _rowOfStirring(data):
    from yade import O

    flow = sediment.engine("flow")
    pores, cells = flow.pores(), flow.cells()
    volume = np.array(pores["volume"])
    for name, value in (
        ("steps", O.iter - data["begin"]),
        ("strain", 1 - sediment.boxSize()[1] / data["height"]),
        ("ledger", flow.volumes()["error"]),
        ("flips", flow.nFlips),
        ("smallest", volume.min() / volume.mean()),
        ("pressure", np.max(np.abs(pores["pressure"]))),
    ):
        data[name].append(float(value))
    data["negativeCells"] += int((np.array(cells["void"]) < 0).sum())
