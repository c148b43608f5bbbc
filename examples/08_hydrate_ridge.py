# SPDX-License-Identifier: GPL-2.0-or-later
"""Hydrate Ridge: what of its reported compressibility can the model have, and what not? (Figure 10)

    capfrac python examples/08_hydrate_ridge.py [folder]

Expect (300 grains): k_n = 5.3 * 10^6 N/m for the reported average C_c; C_r of 0.1-0.33 against a reported 0.035-0.064:
as the paper says of its own model, unloading does not agree. A laboratory curve of yours (CSV with stress [Pa] and
strain [-]) is drawn in. Takes some ten minutes. The same from the command line: `capfrac lab hydrate-ridge`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-hydrate-ridge", grainCount=300, laboratory=""):
    values = parameters.resolve(
        "hydrate-ridge", {"grains": {"count": grainCount}, "hydrate-ridge": {"laboratory": laboratory}}
    )
    results = command.runTest("hydrate-ridge", values, folder, report=print)
    print(*results["verdict"], sep="\n")
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
