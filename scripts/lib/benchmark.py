"""Cost of a coupled step over a dry one: see scripts/benchmark."""

import json
import statistics
import sys
import time

import capfrac

capfrac.load_engines()

from yade import O

from capfrac import injection, sediment

STEPS, ROUNDS = 500, 7


def timeSteps():
    start = time.perf_counter()
    O.run(STEPS, True)
    return (time.perf_counter() - start) / STEPS


def measure(grainCount):
    """Times of dry and coupled steps of a bonded sample at rest [s], and the median of their ratios."""
    O.reset()
    sample = sediment.Sediment(grainCount=grainCount, rMin=1e-6, seed=1)
    radii = sediment.drawRadii(sample)
    x, y, width, height = sediment.placeGrains(sample, radii)
    sediment.buildScene(sample, x, y, radii, (0, width, 0, height))
    sediment.settle(sample, unbalanced=0.05)
    sediment.compress(sample, 10e3, 8e3, tolerance=0.05, unbalanced=0.01)
    sediment.bond(capillaryStrength=0.5)
    gas = injection.startInjection(start=90e3, increment=0, max=90e3, pores=3)
    dry, coupled = [], []
    for _ in range(ROUNDS):
        gas.dead = True
        dry.append(timeSteps())
        gas.dead = False
        coupled.append(timeSteps())
    return {"grains": grainCount, "cells": gas.nCells, "dryStep [s]": statistics.median(dry), "coupledStep [s]": statistics.median(coupled),
            "ratio": statistics.median(c / d for c, d in zip(coupled, dry))}


if __name__ == "__main__":
    print(json.dumps([measure(int(n)) for n in sys.argv[1:] or (300, 3000)], indent=2))
