# SPDX-License-Identifier: GPL-2.0-or-later
"""A sealed sample is compressed: total, dry and pore pressure, Biot coefficient (Figure 13 of Jain & Juanes 2008).

    capfrac python examples/15_undrained_compaction.py [folder]

100 grains, bonded, with the paper's soft fluid, and with real water at the same time step. Expect b = 0.86: the water
does not press where grains press each other, and at 100 kPa these soft contacts cover a seventh of a section. sigma - b
p is the dry curve within some per cent. The same from the command line: `capfrac lab undrained`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac import sediment
from capfrac.lab import undrained, undrained_figures


def main(folder=None, grainCount=100, bulkModuli=(1e7, 2.2e9), strain=0.01):
    sample, found = sediment.Sediment(grainCount=grainCount, rMin=1e-2, seed=1, shearStiffness=4e6), {}
    for bulkModulus in bulkModuli:
        result = found[bulkModulus] = undrained.undrained(sample, strain=strain, bulkModulus=bulkModulus)
        print(
            f"K_f = {bulkModulus:.3g} Pa: b = {result['biot']:.3f} +- {result['biotError']:.3f}, misfit"
            f" {result['misfit']:.1%}, water lost {result['ledger']:.1g}"
        )
        undrained_figures.drawUndrained(result, f"{folder or '.'}/undrained-{bulkModulus:g}.png")
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
