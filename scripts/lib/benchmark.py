# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of a coupled step over a dry one: see scripts/benchmark."""

import json
import statistics
import sys
import time

import capfrac

capfrac.load_engines()

from yade import O

from yade.wrapper import SinglePhaseFlowEngine

from capfrac import injection, sediment

STEPS, ROUNDS = 300, 5


def timeSteps():
    start = time.process_time()
    sediment.advance(STEPS)
    return (time.process_time() - start) / STEPS


def makeSample(grainCount):
    """A bonded sample of fine grains, at rest but for small motions, in the scene."""
    O.reset()
    sample = sediment.Sediment(grainCount=grainCount, rMin=1e-6, rMax=2e-6, seed=1)
    sediment.placeSample(sample)
    sediment.settle(sample, unbalanced=0.05)
    sediment.compress(sample, 10e3, 8e3, tolerance=0.05, unbalanced=0.01)
    sediment.bond(capillaryStrength=0.5)


def compare(engine, name):
    """Processor times of dry and coupled steps [s], and the median of their ratios.

    The engine is switched off and on in turn.
    """
    dry, coupled = [], []
    for _ in range(ROUNDS):
        engine.dead = True
        dry.append(timeSteps())
        engine.dead = False
        coupled.append(timeSteps())
    return {
        "engine": name,
        "cells": engine.nCells,
        "dryStep [s]": statistics.median(dry),
        "coupledStep [s]": statistics.median(coupled),
        "ratio": statistics.median(c / d for c, d in zip(coupled, dry)),
    }


def measure(grainCount):
    """All engines on one sample: a list of :func:`compare`."""
    makeSample(grainCount)
    found = []
    for name, more in (
        ("GasInvasionEngine", {}),
        (
            "ViscousInvasionEngine",
            dict(waterFlow="solved", gasLaw="ideal", poreMode="triangle", closedPore=0.03),
        ),
    ):
        gas = injection.startInjection(start=90e3, increment=0, max=90e3, pores=3, **more)
        found.append(compare(gas, name))
        O.engines = [engine for engine in O.engines if engine.label != gas.label]
    for scheme in ("undrainedStable", "implicit"):
        flow = sediment.insertFluid(SinglePhaseFlowEngine(timeIntegration=scheme, label=scheme))
        found.append(compare(flow, f"SinglePhaseFlowEngine, {scheme}"))
        flow.dead = True
    return {"grains": grainCount, "engines": found}


if __name__ == "__main__":
    print(json.dumps([measure(int(n)) for n in sys.argv[1:] or (300, 2000)], indent=2))
