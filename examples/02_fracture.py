# SPDX-License-Identifier: GPL-2.0-or-later
"""Fine grains: gas pushes them apart (Figure 16 of Jain & Juanes 2008), and how the width of the inlet decides when.

    capfrac python examples/02_fracture.py [grainCount] [seed]

The same sample is opened from inlets of 1, 3 and 5 pores. A bonded sediment is a material with a toughness: the wider
the gas-filled flaw, the lower the pressure that drives it on (doc/validation.md has the table over seeds).
Expect: entry through opened throats from 120-170 kPa on, at or below the rigid threshold of about 4.65 gamma/r = 155
kPa.
"""

import os
import sys
import tempfile

import capfrac

capfrac.load_engines()

from yade import O

from capfrac import injection, mode, sediment, snapshot
from capfrac.errors import CaseError


def main(grainCount=300, seed=1, inlets=(1, 3, 5)):
    tension = 0.05  # N/m
    sediment.makeSample(
        sediment.Sediment(grainCount=grainCount, rMin=1e-6, rMax=2e-6, seed=seed), stressV=10e3, stressH=8e3
    )
    sediment.bond(capillaryStrength=10 * tension)
    sediment.relax()
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        saved = os.path.join(folder, "sample.yade.gz")
        O.save(saved, quiet=True)
        for pores in inlets:
            O.reset()
            O.load(saved, quiet=True)
            try:
                gas = injection.startInjection(
                    start=80e3, increment=1e3, max=250e3, pores=pores, interfacialTension=tension
                )
            except CaseError as problem:  # a small sample may have fewer pores along the bottom
                print(problem)
                continue
            start = snapshot.takeSnapshot(gas)
            while gas.breakthroughIter < 0 and not gas.rampDone:
                O.run(200, True)
            results[pores] = mode.measureMode(gas, start)
            print(f"inlet of {pores} pores, {gas.inletWidth * 1e6:.0f} um wide")
            print(mode.asText(results[pores]))
    return results


if __name__ == "__main__":
    main(*(int(argument) for argument in sys.argv[1:3]))
