# SPDX-License-Identifier: GPL-2.0-or-later
"""Which microscopic parameter turns which macroscopic property? A table to calibrate a sediment with.

    capfrac python examples/12_calibration.py [folder]

Each parameter is halved and doubled; the exponents say how a property answers. Takes some minutes.
The same from the command line: `capfrac lab sensitivity`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac import sediment
from capfrac.lab import properties


def main(folder=None, grainCount=300, stresses=(20e3, 50e3, 100e3), strain=0.08):
    found = properties.sensitivity(
        sediment.Sediment(grainCount=grainCount, rMin=1e-3, seed=1), 2.0, stresses, strain, bondStrength=100e3
    )
    for parameter, exponents in found["exponent"].items():
        print(parameter, {name: round(n, 2) for name, n in exponents.items()})
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
