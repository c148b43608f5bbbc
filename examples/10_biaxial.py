# SPDX-License-Identifier: GPL-2.0-or-later
"""Biaxial tests of a bonded sample: Young's modulus, Poisson's ratio, friction angle, cohesion, Mohr circles.

    capfrac python examples/10_biaxial.py [folder]

Expect (300 grains, bonds of 100 kPa): E = 3-5 MPa rising with the confining stress, nu = 0.3-0.4, phi = 16 degrees, c =
18 kPa. The same from the command line: `capfrac lab biaxial`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac import sediment
from capfrac.lab import biaxial, strength_figures


def main(folder=None, grainCount=300, stresses=(20e3, 50e3, 100e3), strain=0.08):
    found = biaxial.biaxial(
        sediment.Sediment(grainCount=grainCount, rMin=1e-3, seed=1), stresses, strain, bondStrength=100e3
    )
    print(
        f"E = {found['youngModulus']:.4g} Pa, nu = {found['poissonRatio']:.3f}, phi ="
        f" {found['frictionAngle']:.1f} degrees, c = {found['cohesion']:.4g} Pa"
    )
    strength_figures.drawBiaxial(found, f"{folder or '.'}/biaxial.png")
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
