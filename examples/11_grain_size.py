# SPDX-License-Identifier: GPL-2.0-or-later
"""With strengths by Eq. 5 and a constant k_n the macroscopic properties do not depend on the grain size.

    capfrac python examples/11_grain_size.py [folder]

Expect: E, nu, phi and c of grains of 1.2 um and 1 cm equal to the last digit. Sizes that are no power of two apart
differ by the scatter of a sample of 300 grains, some 10 %, because rounding then differs and sliding grains amplify it.
The same from the command line: `capfrac lab sizes`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac import sediment
from capfrac.lab import properties


def main(folder=None, grainCount=300, radii=(1e-2 / 2**13, 1e-2), stresses=(20e3, 50e3, 100e3), strain=0.08):
    found = properties.sizes(
        sediment.Sediment(grainCount=grainCount, rMin=1e-3, seed=1), radii, stresses, strain, bondStrength=100e3
    )
    for name, share in found["spread"].items():
        print(f"{name}: {found['table'][name]}, spread {share:.2%}")
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
