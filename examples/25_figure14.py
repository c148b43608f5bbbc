# SPDX-License-Identifier: GPL-2.0-or-later
"""Gas let in around the middle: under equal stresses it fractures the sediment in any direction (Figure 14 of Jain &
Juanes 2008), else upright.

    capfrac python examples/25_figure14.py [folder] [seed]

The same injection twice, with the same stress on all walls and with the vertical one 1.8 times as large. The run
folders hold fracture.png (gas, cracked throats, tips, rose of directions), stress.png and fracture.json. Expect some
branches each, those of the second nearer to the vertical (90 degrees); one sample is no proof: doc/fracture.md has
fifteen. A few minutes.
"""

import os
import sys

import capfrac

capfrac.load_engines()

from capfrac import injection
from capfrac.case import readCase


def main(folder="runs", seed=1, grainCount=800):
    results = {}
    for name in ("figure14", "figure14_vertical"):
        case = readCase(name, [f"grains.seed={seed}", f"grains.count={grainCount}", "output.fields=false"])
        summary = injection.inject(
            case, os.path.join(folder, f"{name}-{grainCount}-seed{seed}"), report=lambda text: None, replaceScene=True
        )
        found = results[name] = summary["fracture"]
        print(
            f"{summary['title']}: {summary['mode']['mode']} at {summary['mode']['breakthroughPressure']:.4g} Pa,"
            f" {found['branchCount']} branches"
        )
        for kind in ("extent", "branches", "apertures"):
            if found["orientation"][kind]["resultant"] is not None:
                print(
                    f"  direction by {kind}: {found['orientation'][kind]['mean [degrees]']:.0f} degrees, resultant"
                    f" {found['orientation'][kind]['resultant']:.2f}"
                )
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2], *(int(argument) for argument in sys.argv[2:3]))
