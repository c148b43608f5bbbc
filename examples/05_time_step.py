# SPDX-License-Identifier: GPL-2.0-or-later
"""The time step grows with the grains and falls with their stiffness (Figure 9 of Jain & Juanes 2008).

    capfrac python examples/05_time_step.py [folder]

delta t ~ r sqrt(rho/k_n), Eq. 7. Expect exponents of 1 and -1/2, within 1 %.
The same from the command line: `capfrac lab timestep`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-timestep", grainCount=300, radii=(1e-6, 1e-4, 1e-2), stiffnesses=(1e5, 1e7, 1e9)):
    values = parameters.resolve(
        "timestep",
        {
            "grains": {"count": grainCount},
            "timestep": {"radii": list(radii), "stiffnesses": list(stiffnesses), "seeds": 1},
        },
    )
    results = command.runTest("timestep", values, folder, report=print)
    for name in ("radius", "stiffness"):
        print(f"time step ~ {name}^{results[name]['exponent']:.4f} +- {results[name]['error']:.4f}")
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
