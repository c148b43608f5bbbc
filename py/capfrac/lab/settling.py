# SPDX-License-Identifier: GPL-2.0-or-later
"""Sedimentation and its time step: Figures 7, 8 and 9 of Jain & Juanes (2008).

Grains fall from random places and come to rest. The time step is that of YADE's GlobalStiffnessTimeStepper, as in the
paper's code: a share of the shortest period of a grain on its contacts, delta t ~ sqrt(m/k) (Eq. 6). For disks of unit
thickness m = pi r^2 rho, so that delta t is proportional to r and to k_n^(-1/2) (Eq. 7; the paper prints r under the
root, against its own text).
"""

import math

import numpy as np

from capfrac.errors import CaseError, SampleError
from capfrac.lab.run import LabRun
from capfrac.results import snapshot
from capfrac.scene import sediment
from capfrac.values import exactText, isPositive, shown

#: Share of the grains with a contact at which the second stage, settling and rearrangement, begins [-].
SETTLING_SHARE = 0.5


def settle(sample, gravity=None, safety=0.6, run=None, unbalanced=0.01, every=100, maxSteps=2_000_000):
    """Let a sample settle with a time step that follows its contacts; returns a dict.

    ``gravity`` [m/s^2], by default that of :func:`sediment.settle`; ``safety`` of the time stepper. The dict has
    ``table``: time [s], timeStep [s], contacts per grain, share of grains with a contact, unbalanced force;
    ``freeFall`` and ``settled``: time steps in free fall and at rest [s], and ``settlingBegins``: when half of the
    grains touch [s]. Pictures are taken at the start, in free fall, as settling begins, and at rest.
    """
    from yade import O, utils

    run = run or LabRun("settle", {})
    run.stage("place", lambda: _place(sample, gravity, safety))
    run.stage("fall", lambda: _fall(sample, run, unbalanced, every, maxSteps))
    rows = run.data["rows"]
    begins = next(t for t, share in zip(rows["time [s]"], rows["shareTouching [-]"]) if share >= SETTLING_SHARE)
    return {
        "table": rows,
        "freeFall": rows["timeStep [s]"][0],
        "settled": O.dt,
        "settlingBegins": begins,
        "iterations": O.iter,
        "porosity": _porosity(),
        "unbalanced": utils.unbalancedForce(),
        "pictures": run.data["pictures"],
    }


def _place(sample, gravity, safety):
    from yade import O
    from yade.wrapper import GlobalStiffnessTimeStepper

    if gravity is not None and not isPositive(gravity):
        raise CaseError(f"gravity = {shown(gravity)} m/s^2, allowed: > 0")
    sediment.placeSample(sample)
    sediment.startSettling(sample, gravity)
    # A grain that falls free has no period. Its first contact gives it that of the smallest grain on one contact,
    # and the step must not be longer when it comes: so that is the time step of free fall.
    single = (
        math.sqrt(2)
        * safety
        * math.sqrt(
            math.pi
            * min(body.shape.radius for body in sediment.grainBodies()) ** 2
            * sample.density
            / sample.normalStiffness
        )
    )
    engines = list(O.engines)
    engines.insert(
        len(engines) - 1,
        GlobalStiffnessTimeStepper(
            active=True,
            timeStepUpdateInterval=1,
            timestepSafetyCoefficient=safety,
            defaultDt=single,
            maxDt=single,
            label="timeStepper",
        ),
    )
    O.engines = engines
    O.dt = single


def _fall(sample, run, unbalanced, every, maxSteps):
    from yade import O

    rows = run.data.setdefault(
        "rows",
        {
            name: []
            for name in ("time [s]", "timeStep [s]", "contactsPerGrain [-]", "shareTouching [-]", "unbalanced [-]")
        },
    )
    taken = run.data.setdefault("pictures", [])
    if not rows["time [s]"]:
        _picture(run, taken, "1-placed")
        _record(rows)
    while not (
        rows["shareTouching [-]"][-1] > SETTLING_SHARE
        and rows["unbalanced [-]"][-1] < unbalanced
        and rows["contactsPerGrain [-]"][-1] > 1.5
    ):
        sediment.runUntil(lambda: True, every, every, "", None, "settling")
        _record(rows)
        share = rows["shareTouching [-]"][-1]
        if share > 0.05:
            _picture(run, taken, "2-free-fall")
        if share > SETTLING_SHARE:
            _picture(run, taken, "3-settling")
        run.report(
            f"settling: {share:.0%} of the grains touch, time step {O.dt:.3g} s, unbalanced force"
            f" {rows['unbalanced [-]'][-1]:.2g}"
        )
        run.tick()
        if O.iter > maxSteps:
            raise SampleError(
                f"the grains did not come to rest: unbalanced force {rows['unbalanced [-]'][-1]:.3g} after"
                f" {O.iter} steps, wanted {unbalanced}"
            )
    _picture(run, taken, "4-at-rest")


def _record(rows):
    from yade import O, utils

    contacts, share = _contacts()
    for name, value in zip(rows, (O.time, O.dt, contacts, share, utils.unbalancedForce() if share > 0 else 1.0)):
        rows[name].append(float(value))


def _contacts():
    """Contacts per grain, walls included, and share of the grains that have one."""
    from yade import O

    touching, number = set(), 0
    for contact in O.interactions:
        if contact.isReal:
            number += 1
            touching.update((contact.id1, contact.id2))
    grains = [body.id for body in sediment.grainBodies()]
    return number / len(grains), sum(1 for i in grains if i in touching) / len(grains)


def _picture(run, taken, name):
    """One of the four pictures of Figure 7, once."""
    if name in [entry["name"] for entry in taken]:
        return
    from yade import O
    from yade.wrapper import PoreNetworkEngine

    taken.append({"name": name, "time [s]": O.time})
    if run.folder is not None:
        shot = snapshot.takeSnapshot(PoreNetworkEngine(maxSizeRatio=1e3))
        shot.save(run.folder.sub("snapshots") / f"{name}.npz")


def _porosity():
    walls = sediment.wallBodies()
    top = max(body.state.pos[1] + body.shape.radius for body in sediment.grainBodies())
    area = (walls["right"].state.pos[0] - walls["left"].state.pos[0]) * (top - walls["bottom"].state.pos[1])
    return 1 - math.pi * sum(body.shape.radius**2 for body in sediment.grainBodies()) / area


# --- scaling -------------------------------------------------------------------------------------


def scaling(sample, radii, stiffnesses, seeds=2, safety=0.6, run=None):
    """The time step at rest against grain radius and stiffness (Figure 9): a dict.

    Each radius [m] (smallest of the sample, with the sample's k_n) and each stiffness [N/m] (with the sample's radius)
    is settled anew for each of ``seeds`` seeds. ``radius`` and ``stiffness`` each hold ``x``, ``timeStep`` [s],
    ``exponent`` and ``error`` (standard error of a least-squares line through the logarithms of all points). Raises
    :class:`CaseError` for fewer than three radii or stiffnesses.
    """
    run = run or LabRun("timestep", {})
    for name, values in (("radii", radii), ("stiffnesses", stiffnesses)):
        if len(values) < 3 or len(set(values)) != len(values):
            raise CaseError(f"{name} = {list(values)}, allowed: at least three different numbers")
    result = {}
    for name, values, make in (
        ("radius", radii, lambda r: {"rMin": r, "rMax": r * sample.rMax / sample.rMin}),
        (
            "stiffness",
            stiffnesses,
            lambda k: {"normalStiffness": k, "shearStiffness": k * sample.shearStiffness / sample.normalStiffness},
        ),
    ):
        points = [(float(value), sample.seed + seed) for value in values for seed in range(seeds)]
        steps = [
            _settledStep(
                sediment.changed(sample, seed=seed, **make(value)),
                safety,
                run,
                f"{name} {exactText(value, 'g')}, seed {seed}",
            )
            for value, seed in points
        ]
        exponent, error = powerLaw([value for value, _ in points], steps)
        result[name] = {"x": [value for value, _ in points], "timeStep": steps, "exponent": exponent, "error": error}
    return result


def _settledStep(sample, safety, run, name):
    return run.result(name, lambda: {"timeStep": settle(sample, safety=safety, run=run)["settled"]})["timeStep"]


def powerLaw(x, y):
    """Exponent of y ~ x^n by least squares through the logarithms, and its standard error."""
    x, y = np.log(x), np.log(y)
    x = x - x.mean()
    exponent = float((x * y).sum() / (x * x).sum())
    residual = y - y.mean() - exponent * x
    return exponent, float(math.sqrt((residual**2).sum() / (len(x) - 2) / (x * x).sum()))
