# SPDX-License-Identifier: GPL-2.0-or-later
"""Water between grains set by hand against formulas in closed form: two pores, series and parallel, lattices, a pulse,
other units.

    capfrac python examples/18_closed_forms.py [folder]

Expect: flows in series, in parallel and through lattices to round-off (1e-7 across the rows of triangles, where a layer
along the walls is left out by a difference); order 1 in time and 2 in the spacing of the pores; the same bits in units
that are powers of two of the SI's, and differences of 1e-10 in others as long as no grain is damped or hit. The same
from the command line: `capfrac lab closed-forms`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-closed-forms", grainCount=60):
    values = parameters.resolve("closed-forms", {"grains": {"count": grainCount}})
    results = command.runTest("closed-forms", values, folder, report=print)
    print(command.asText("closed-forms", results))
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
