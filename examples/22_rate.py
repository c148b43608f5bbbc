# SPDX-License-Identifier: GPL-2.0-or-later
"""Gas at a constant rate instead of a constant pressure: the pressure that follows, and what a dead volume does to it.

    capfrac python examples/22_rate.py [grainCount] [seed] [FOLDER]

Methane flows into the fine sediment of Figure 16 from dead volumes of one and of a hundred times its pores; the rates
let the pressure rise equally fast. A large volume acts like a prescribed pressure: what opens runs through. A small one
loses its pressure to each pore that fills, and the gas has to be pressed up again: a sawtooth, and more gas is needed
at the end. Expect: the first opened throat at the same pressure, some 140 kPa; from the large volume gas at the top at
once, from the small one drops of ten kPa and more. The gas is accounted for to 1e-10 of its mass. Some minutes.
"""

import math
import os
import sys
import tempfile

import capfrac

capfrac.load_engines()

from yade import O
from yade.wrapper import RateSupply

from capfrac import history, injection, sediment

#: Rise of the pressure within a period of a grain [Pa]: less than a thousandth of the 140 kPa at which the gas enters.
RISE = 100.0


def main(grainCount=300, seed=1, folder="runs/22_rate", volumes=(1, 100), start=100e3, rise=RISE):
    os.makedirs(folder, exist_ok=True)
    sediment.makeSample(
        sediment.Sediment(grainCount=grainCount, rMin=1e-6, rMax=2e-6, seed=seed), stressV=10e3, stressH=8e3
    )
    sediment.bond(capillaryStrength=10 * 0.05)
    sediment.relax()
    results = {}
    with tempfile.TemporaryDirectory() as scratch:
        saved = os.path.join(scratch, "sample.yade.gz")
        O.save(saved, quiet=True)
        for volume in volumes:
            O.reset()
            O.load(saved, quiet=True)
            results[volume] = inject(volume, start, rise, folder, pores=max(1, round(0.35 * math.sqrt(grainCount))))
    return results


def inject(volume, start, rise, folder, pores):
    """From a dead volume of `volume` times the pores until the gas is at the top; a dict of numbers.

    The inlet is ``pores`` wide, a third of the bottom: 6 of 300 grains.
    """
    gas = injection.startInjection(
        start, increment=1e3, max=250e3, pores=pores, gasLaw="ideal", invasionInterval=50, historyInterval=20
    )
    gas.supply = RateSupply(rate=1e-6, reservoirVolume=volume * gas.initialVoid)
    gas.supply.rate *= rise / gas.risePerPeriod()  # in proportion
    begun = O.time
    while gas.breakthroughIter < 0 and gas.gasPressure < 250e3:
        O.run(200, True)
    course, ledger = gas.history(), gas.gasLedger()
    history.drawHistory(
        course,
        os.path.join(folder, f"history-{volume}.png"),
        events=gas.events(),
        breakthroughIter=gas.breakthroughIter,
        startTime=begun,
        title=f"dead volume: {volume} times the pores",
    )
    # Between two rows of the history the pressure may have been higher when gas entered a pore.
    found = {
        "highest": max([*course["gasPressure"], *gas.events()["gasPressure"]]),
        "breakthrough": gas.breakthroughPressure,
        "rate": gas.supply.rate,
        "supplied": ledger["supplied"],
        "ledger": ledger["error"],
        "lowestAfter": min(course["gasPressure"][course["gasPressure"].index(max(course["gasPressure"])) :]),
    }
    print(
        f"dead volume {volume} times the pores, {gas.supply.rate * 1e6:.3g} mg/s: highest pressure"
        f" {found['highest'] / 1e3:.1f} kPa, at the top at {found['breakthrough'] / 1e3:.1f} kPa, down to"
        f" {found['lowestAfter'] / 1e3:.1f} kPa; error of the mass {found['ledger']:.0e}"
    )
    return found


if __name__ == "__main__":
    main(*(int(argument) for argument in sys.argv[1:3]), *sys.argv[3:4])
