# SPDX-License-Identifier: GPL-2.0-or-later
"""Invasion percolation in rigid networks of 1e5 pores: how gas fills a coarse sediment, with and without trapping.

    capfrac python examples/21_percolation.py [folder]

Grains that cannot move leave the invasion to the throats alone. Expect fractal dimensions of 1.90 without trapping
(91/48 in theory) and 1.82 with it, within the standard errors that are printed, about 0.02 for these sizes; on square
lattices and triangulations of random points alike. The picture shows the gas and the water that it traps. A minute or
two; at full size: see doc/percolation.md. The same from the command line: `capfrac lab percolation`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-percolation", **own):
    results = command.runTest(
        "percolation", parameters.resolve("percolation", {"percolation": own}), folder, report=print
    )
    for network in ("square", "delaunay"):
        for kind, one in results[network].items():
            print(
                f"{network}, {kind}: D = {one['dimension']:.3f} +- {one['dimensionError']:.3f}, expected"
                f" {results['literature'][kind]:.3f}"
            )
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
