# SPDX-License-Identifier: GPL-2.0-or-later
"""Long runs of grains and water together: does energy stay bounded, does water stay?

*shake*: grains on springs that nothing damps, in a sealed rigid box, begin with random velocities. The time step is
that of the dry grains. Dry, the energy of motion and contacts is kept; with water it may only fall, for what flows or
waits an implicit step loses energy. A scheme that is unstable there gains energy without limit. The viscosity is so
high that pores cannot exchange water: each is a spring of its own, the hardest case. (Water itself, between grains of a
micrometre or more, spreads over many pores in a time step.)

*stir*: a drained sample whose roof goes up and down many times by strains of 10 % and more, as a *piston* between fixed
sides or in *shear* between sides that keep their stress; contacts open and close, edges flip by the thousand, and the
water's books are checked.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.compaction import prepareSample
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import exactText, isPositive, shown

#: Rows of a run.
ROWS = 200
#: Energy over that at the start beyond which a run counts as blown up.
BLOWN_UP = 1e3
MOTIONS = ("piston", "shear")


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


def stability(sample, bulkModuli=(1e7, 2.2e9), steps=100_000, stress=100e3, strain=0.25, run=None):
    """Shake a sample with each fluid and an incompressible one, with each scheme, and stir one; a dict of ``shake`` and
    ``stir``, results by name.
    """
    run = run or LabRun("stability", {})
    if not all(map(isPositive, bulkModuli)):
        raise CaseError(f"bulkModuli = {shown(list(bulkModuli))}, allowed: > 0")
    stiffest = max(bulkModuli)
    name = f"{exactText(stiffest, '.3g')} Pa"
    shaken = [("dry", None, "undrainedStable")]
    shaken += [(f"{exactText(value, '.3g')} Pa", value, "undrainedStable") for value in bulkModuli]
    shaken += [("incompressible", math.inf, "undrainedStable")]
    shaken += [(f"{name}, {scheme}", stiffest, scheme) for scheme in ("implicit", "explicit")]
    found = {
        "shake": {
            name: run.result(f"shake {name}", lambda: shake(sample, value, scheme, steps, stress, run=run))
            for name, value, scheme in shaken
        }
    }
    found["stir"] = {
        motion: run.result(motion, lambda: stir(sample, motion, steps, strain, stress, run=run)) for motion in MOTIONS
    }
    return found
