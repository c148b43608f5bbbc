# SPDX-License-Identifier: GPL-2.0-or-later
"""Water diffuses into a sample: permeability, storage, pressure (Table 1, Figures 11 and 12 of Jain & Juanes 2008).

    capfrac python examples/14_pressure_diffusion.py [folder]

Expect (300 grains, r_min = 1 cm): k = 0.8-0.9e-2 r_min^2 with the throats of Eq. 9 (the paper: 0.29e-2, a factor of
0.32 on all conductances); c_v K_f within 2 % of the porosity between the pores of prescribed pressure. Single pores
scatter about Eq. 20 by what the throats around them differ, by half a grain: some 3-5 % of Delta p in the steady state,
more where the front is a few pores wide; layers of two grains lie within about 2 %. On another sample the explicit
scheme runs, too, with steps of half a nanosecond, and agrees with the implicit one as the steps of both get short. The
same from the command line: `capfrac lab diffusion -s diffusion.explicitGrains=150`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-diffusion", grainCount=300, steps=400, explicitGrains=150):
    grains, own = {"count": grainCount, "rMin": 1e-2, "aspect": 1 / 0.7}, {
        "steps": steps,
        "explicitGrains": explicitGrains,
    }
    results = command.runTest(
        "diffusion", parameters.resolve("diffusion", {"grains": grains, "diffusion": own}), folder, report=print
    )
    print(f"k = {results['permeability']:.4g} m^2 = {results['kOverR2']:.4g} r_min^2")
    print(
        f"c_v K_f = {results['storageTimesBulkModulus']:.3f}, porosity {results['porosityBetween']:.3f} (of the whole"
        f" box {results['porosity']:.3f})"
    )
    print(
        "tau         pore  layer  inflow outflow  place   off Eq. 20 (of Delta p), Eq. 21 (relative), Eq. 22 (of the"
        " steady flow), in grain diameters"
    )
    rates, places = results["rateErrors"], results["placeErrors"]["rms"]
    for tau, place, *errors in zip(
        rates["tau"], places, results["profileErrors"], results["layerErrors"], rates["inflow"], rates["outflow"]
    ):
        print(f"{tau:<9g}", *(f"{100 * error:6.2f}%" for error in errors), f"{place:6.2f}")
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
