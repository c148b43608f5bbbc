# SPDX-License-Identifier: GPL-2.0-or-later
"""A water-filled block is loaded between tight plates and drained at its sides: the pressure in its middle rises first
(Mandel).

    capfrac python examples/17_mandel.py [folder]

500 equal, bonded grains on a lattice, 60 of them side by side. Expect a peak of 1.13 times the undrained pressure, as
in Mandel's solution, and falling pressures within 5 % of its times. A settled sample shows the mean pressure of the
solution, too, but pores of a disordered pack differ from their neighbours by more than the rise (set mandel.arrangement
to "settled"). The same from the command line: `capfrac lab mandel`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-mandel", grainCount=500, steps=40_000):
    grains = {"count": grainCount, "rMin": 1e-2, "rMax": 1e-2, "shearStiffness": 4e6, "aspect": 0.15}
    values = parameters.resolve("mandel", {"grains": grains, "mandel": {"steps": steps}})
    results = command.runTest("mandel", values, folder, report=print)
    print(
        f"peak {results['peak']:.3f} at T = {results['peakTime']:.3f}; Mandel {results['peakExpected']:.3f} at"
        f" {results['peakTimeExpected']:.3f}"
    )
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
