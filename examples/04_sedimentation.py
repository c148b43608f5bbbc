# SPDX-License-Identifier: GPL-2.0-or-later
"""Sedimentation: grains fall at random places and come to rest (Figures 7 and 8 of Jain & Juanes 2008).

    capfrac python examples/04_sedimentation.py [folder]

Pictures of the two stages, free fall and rearrangement, and the time step on the way. Expect (300 grains): the time
step falls from 24.6 us in free fall to 8.7 us at rest, a factor of 0.35, and stays there; porosity about 0.26. The same
from the command line: `capfrac lab settle`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-settle", grainCount=300):
    values = parameters.resolve("settle", {"grains": {"count": grainCount, "rMin": 1e-3}})
    results = command.runTest("settle", values, folder, report=print)
    print(
        f"time step: {results['freeFall']:.3g} s in free fall, {results['settled']:.3g} s at rest; half of the grains"
        f" touch after {results['settlingBegins']:.3g} s"
    )
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
