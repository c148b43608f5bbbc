# SPDX-License-Identifier: GPL-2.0-or-later
"""Coarse grains: gas slips between them (Figure 15 of Jain & Juanes 2008), driven step by step from Python.

    capfrac python examples/01_capillary_invasion.py [grainCount] [seed]

Shows the calls behind `capfrac inject figure15`: a sample from nothing, bonds, the gas engine, a loop of your own.
Expect (300 grains): breakthrough between 145 and 190 Pa, 97 % gas by 170-215 Pa, no loaded grain moved by more than a
few per cent of its radius, mode capillary.
"""

import sys

import capfrac

capfrac.load_engines()

from yade import O

from capfrac import injection, mode, sediment, snapshot


def main(grainCount=300, seed=1):
    tension = 0.05  # N/m
    sample = sediment.Sediment(grainCount=grainCount, rMin=1e-3, rMax=2e-3, seed=seed)
    sediment.makeSample(sample, stressV=10e3, stressH=8e3)
    sediment.bond(capillaryStrength=10 * tension)  # sigma_c = 10 gamma/r
    sediment.relax()

    gas = injection.startInjection(
        start=100, increment=1, max=215, pores=3, interfacialTension=tension, checkInvariants=True
    )
    start = snapshot.takeSnapshot(gas)
    while not gas.rampDone:
        O.run(500, True)
    levels = gas.levels()
    reached97 = next((p for p, s in zip(levels["pressure"], levels["gasSaturation"]) if s >= 0.97), None)
    measured = mode.measureMode(gas, start)
    print(mode.asText(measured))
    print(f"97 % gas at {reached97} Pa")
    return measured, reached97


if __name__ == "__main__":
    main(*(int(argument) for argument in sys.argv[1:3]))
