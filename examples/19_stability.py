# SPDX-License-Identifier: GPL-2.0-or-later
"""Real water at the time step of the dry grains, for a long time: energy, flips, and the books of the water.

    capfrac python examples/19_stability.py [folder]

60 grains are shaken in a sealed box without damping, with fluids from 10 MPa to incompressible: expect energies that
never exceed the one at the start. The paper's explicit scheme and a staggered implicit one blow up within ten steps
with water. Then a piston and a shear box go up and down with water flowing through the floor: expect thousands of
flipped edges and an error of the water's mass near 1e-14. The same from the command line: `capfrac lab stability`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-stability", grainCount=60, steps=20_000):
    values = parameters.resolve(
        "stability",
        {"grains": {"count": grainCount, "rMin": 1e-2, "shearStiffness": 4e6}, "stability": {"steps": steps}},
    )
    results = command.runTest("stability", values, folder, report=print)
    for name, one in results["shake"].items():
        print(
            f"shaken, {name}: {one['end'] if one['end'] == 'bounded' else 'blew up in step %d' % one['stepsDone']},"
            f" energy at most {one['energy']:.3g} of that at the start"
        )
    for name, one in results["stir"].items():
        print(f"{name}: {one['flipsTotal']} flips, error of the water's mass {one['ledger']:.1g}")
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
