# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs that test_rate.py and the figure of the manual share: the sample of figure16_small under a ramp, and under
rates.

A run that is there already, of the shipped case as it is, is not made again. By itself this file makes all runs:
``capfrac python tests/validation/rate.py``.
"""

import json
import math
import sys

import capfrac

capfrac.load_engines()

from yade import O
from yade.wrapper import RateSupply

from runs import FOLDER

PLACE = FOLDER / "rate"
#: Where the injections begin [Pa]: below the first entry.
START = {"figure16_small": 125e3, "figure15": 140.0}
#: Volumes upstream of the inlet, over that of the pores [-], and the rise of the pressure within a period of a grain
#: [Pa].
SMALL, LARGE, RISE = 3, 300, 60.0
#: Large for a coarse sample: P_c is 150 Pa of 101 kPa.
LARGE_COARSE = 1e5
#: Kinds of runs: keywords of one().
RUNS = {
    "ramp": dict(),
    "ramp-ideal": dict(law="ideal"),
    "small": dict(volume=SMALL),
    "small-half-rate": dict(volume=SMALL, rise=RISE / 2),
    "small-half-step": dict(volume=SMALL, refine=2),
    "large": dict(volume=LARGE),
    "large-half-rate": dict(volume=LARGE, rise=RISE / 2),
    "large-half-step": dict(volume=LARGE, refine=2),
}
#: The same rate but for a billionth: what the accidents of one sample are, whatever the step.
NUDGED = {f"small-nudged{n}": dict(volume=SMALL, rise=RISE * (1 + n * 1e-9)) for n in (-2, -1, 1, 2)}
COARSE = {
    "coarse-ramp": dict(case="figure15"),
    "coarse-ramp-ideal": dict(case="figure15", law="ideal"),
    "coarse-large": dict(case="figure15", volume=LARGE_COARSE, rise=0.02),
}


def sampleOf(name, case):
    """Path of the saved sample of a resolved case of that name."""
    from capfrac.case.build import makeSample

    path = keptAs(name, case, "yade.gz")
    if not path.exists():
        PLACE.mkdir(parents=True, exist_ok=True)
        O.reset()
        makeSample(case, lambda *progress: None)
        O.save(str(path), quiet=True)
    return path


def keptAs(name, case, suffix):
    """Path of what is kept of a resolved case: a case that changed since has another."""
    from capfrac.run.folder import caseKey

    return PLACE / f"{name}-seed{case['grains']['seed']}-{caseKey(case, {})}.{suffix}"


def one(name, seed=1, case="figure16_small", law="incompressible", volume=None, rise=RISE, refine=1, after=3000):
    """One injection until some steps after the breakthrough: numbers, history and events as a dict, kept in a file.

    ``volume``: None for the ramp, else the dead volume of a supply whose rate lets the pressure rise by ``rise``.
    ``refine`` divides the time step and multiplies all that is counted in steps.
    """
    from capfrac import injection
    from capfrac.case import readCase

    parameters = readCase(case, [f"grains.seed={seed}"])
    path = keptAs(name, parameters, "json")
    if path.exists():
        return json.loads(path.read_text())
    sample = sampleOf(case, parameters)
    ramp = parameters["ramp"]
    O.reset()
    O.load(str(sample), quiet=True)
    O.dt /= refine
    gas = injection.startInjection(
        START[case],
        ramp["increment"],
        ramp["max"],
        parameters["inlet"]["pores"],
        checkInvariants=True,
        invasionInterval=ramp["invasionInterval"] * refine,
        historyInterval=10 * refine,
        minLevelSteps=100 * refine,
        gasLaw=law if volume is None else "ideal",
    )
    if volume is not None:
        gas.supply = RateSupply(rate=1e-6, reservoirVolume=volume * gas.initialVoid)
        gas.supply.rate *= rise / gas.risePerPeriod()
    begun, error = O.time, 0.0
    while gas.gasPressure < gas.maxPressure and (
        gas.breakthroughIter < 0 or O.iter < gas.breakthroughIter + after * refine
    ):
        O.run(100 * refine, True)
        error = max(error, gas.gasLedger()["error"], gas.volumes()["error"])
    found = {
        "name": name,
        "seed": seed,
        "begun": begun,
        "breakthrough": None if math.isnan(gas.breakthroughPressure) else gas.breakthroughPressure,
        "breakthroughIter": gas.breakthroughIter,
        "error": error,
        "rate": 0.0 if volume is None else gas.supply.rate,
        "reservoir": gas.supply.reservoirVolume,
        "void": gas.initialVoid,
        "detached": gas.nDetachedGas,
        "ledger": gas.gasLedger(),
        "events": gas.events(),
        "history": gas.history(),
        "levels": gas.levels(),
    }
    path.write_text(json.dumps(found))
    return found


def opening(run):
    """Gas pressure at the first opened throat [Pa], or None."""
    return next((p for p, opened in zip(run["events"]["gasPressure"], run["events"]["opened"]) if opened), None)


def highest(run):
    """Highest gas pressure until the breakthrough [Pa]."""
    return max(
        p
        for p, i in zip(run["history"]["gasPressure"], run["history"]["iteration"])
        if run["breakthroughIter"] < 0 or i <= run["breakthroughIter"] + 10
    )


def driving(run):
    """Gas pressure from which it did not rise again before the breakthrough [Pa]: what drove the gas to the outlet."""
    history = run["history"]
    row = max(k for k, iteration in enumerate(history["iteration"]) if iteration <= run["breakthroughIter"])
    pressure = max(history["gasPressure"][row], run["breakthrough"])
    while row > 0 and history["gasPressure"][row - 1] >= history["gasPressure"][row]:
        row -= 1
    return max(pressure, history["gasPressure"][row])


def table(runs):
    """Lines of numbers, for people."""
    lines = []
    for run in runs:
        at = run["breakthrough"]
        lines.append(
            f"{run['name']:20s} seed {run['seed']}: opened at {(opening(run) or math.nan) / 1e3:7.2f}, highest"
            f" {highest(run) / 1e3:7.2f}, driven to the outlet at {driving(run) / 1e3 if at else math.nan:7.2f}, there"
            f" at {math.nan if at is None else at / 1e3:7.2f} kPa, events {len(run['events']['time'])}, error"
            f" {run['error']:.1e}, detached {run['detached']}"
        )
    return lines


if __name__ == "__main__":
    seeds = [int(word) for word in sys.argv[2:]] or [1]
    for seed in seeds:
        for name, values in {**RUNS, **NUDGED, **COARSE}.items():
            if sys.argv[1:2] in ([], ["all"]) or name.startswith(sys.argv[1]):
                print(*table([one(name, seed, **values)]), sep="\n", flush=True)
