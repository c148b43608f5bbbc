# SPDX-License-Identifier: GPL-2.0-or-later
"""A water-filled layer is loaded and settles as its water leaves through the top (Terzaghi's consolidation).

    capfrac python examples/16_terzaghi.py [folder]

240 equal, bonded grains on a lattice, 36 rows. Expect the degree of consolidation and the pressure at the base on
Terzaghi's curves, times within 2 % from half of the settlement on (the drained top row settles at once, which counts at
first): stiffness, Biot's coefficient and permeability are measured on the same sample, nothing is fitted. Settled
samples (terzaghi.arrangement = "settled") of 300 grains scatter by what their top rows happen to be. The same from the
command line: `capfrac lab terzaghi`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-terzaghi", grainCount=240, steps=30_000):
    values = parameters.resolve(
        "terzaghi",
        {
            "grains": {"count": grainCount, "rMin": 1e-2, "rMax": 1e-2, "shearStiffness": 4e6, "aspect": 5.0},
            "terzaghi": {"steps": steps},
        },
    )
    results = command.runTest("terzaghi", values, folder, report=print)
    print(
        "time over Terzaghi's at 25, 50, 75, 90 % of the settlement: "
        + ", ".join(f"{ratio:.3f}" for ratio in results["timeRatios"])
    )
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
