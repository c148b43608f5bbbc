# SPDX-License-Identifier: GPL-2.0-or-later
"""Fracture toughness: the gas pressure that drives a crack on, by its length, against linear elastic fracture
mechanics.

    capfrac python examples/26_toughness.py [folder]

Cracks of a few grains in a square lattice, where the answer is known, and in a settled sample. Expect the lattice
within 2 % of the linear lattice ("expected"), and some 1.5 sigma_c for a crack of one contact, twice LEFM's sigma_c
sqrt(r/a): short cracks are stronger, because a pressure inside does not stretch what lies ahead of them. Writes
toughness.png. The same from the command line: `capfrac lab toughness`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac import sediment
from capfrac.verification import toughness, toughness_figures


def main(folder=".", grainCount=300, columns=24, brokenContacts=(1, 3, 5), halfLengths=(3.0, 4.5, 7.0), seeds=1):
    found = toughness.toughness(
        sediment.Sediment(grainCount=grainCount, rMin=1e-3, seed=1),
        halfLengths,
        seeds,
        columns=columns,
        brokenContacts=brokenContacts,
    )
    for test in found["lattice"]["tests"]:
        print(
            f"lattice, a = {test['halfLength'] / test['radius']:.0f} r: {test['pressure'] / 1e3:.1f} kPa, linear"
            f" lattice {test['expected'] / 1e3:.1f} kPa"
        )
    for test in found["samples"]["tests"]:
        print(f"sample, a = {test['halfLength'] / test['radius']:.1f} r: {test['pressure'] / 1e3:.1f} kPa")
    toughness_figures.drawToughness(found, f"{folder}/toughness.png")
    return found


if __name__ == "__main__":
    main(*sys.argv[1:2])
