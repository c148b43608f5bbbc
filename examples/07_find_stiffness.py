# SPDX-License-Identifier: GPL-2.0-or-later
"""Which contact stiffness gives a sediment its compressibility? The one free parameter of Figure 10.

    capfrac python examples/07_find_stiffness.py [folder]

Searches k_n for a compression index. Expect (300 grains, C_c = 0.5 between 100 kPa and 1 MPa for a sediment of void
ratio 1.5): a k_n near 6 * 10^6 N/m, found in two or three compactions, C_c within 2 % of the request. The same from the
command line: `capfrac lab fit`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac import sediment
from capfrac.lab import stiffness


def main(folder=None, grainCount=300, compressionIndex=0.5):
    found = stiffness.findStiffness(
        sediment.Sediment(grainCount=grainCount, rMin=1e-3, seed=1), compressionIndex, voidRatio=1.5, tolerance=0.02
    )
    print(
        f"k_n = {found['normalStiffness']:.4g} N/m has C_c = {found['Cc']:.4f} ({found['error']:+.2%}); tried:"
        f" {found['tried']}"
    )
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
