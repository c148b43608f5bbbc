# SPDX-License-Identifier: GPL-2.0-or-later
"""Dry uniaxial compaction with unload-reload loops (the model's part of Figure 10 of Jain & Juanes 2008).

    capfrac python examples/06_compaction.py [folder]

Driven step by step: any sample, any strains. Expect (300 grains, k_n = 10^7 N/m): 25 % strain at about 1.7 MPa; C_c =
0.27 over the last decade of stress at the pack's own void ratio of 0.28; about 70 % of the strain recovered on
unloading. The same from the command line: `capfrac lab compact`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac import sediment
from capfrac.lab import compaction, figures


def main(folder=None, grainCount=300, strain=0.25, loops=(0.05, 0.10, 0.15, 0.20)):
    found = compaction.compact(sediment.Sediment(grainCount=grainCount, rMin=1e-3, seed=1), strain=strain, loops=loops)
    print(
        f"C_c = {found.Cc:.3f} between {found.fitFrom:.3g} and {found.fitTo:.3g} Pa, void ratio"
        f" {found.voidRatio:.3f} at the preload"
    )
    for loop in found.loops:
        print(
            f"unloaded from {loop['strain']:.0%}: C_r = {loop['Cr']:.3f}, {loop['recovered']:.0%} of the strain"
            " recovered"
        )
    figures.drawCompaction(found.asDict(), f"{folder or '.'}/compaction.png")
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
