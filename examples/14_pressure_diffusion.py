"""Water diffuses into a sample: permeability, storage, pressure (Table 1, Figures 11 and 12 of Jain & Juanes 2008).

    capfrac python examples/14_pressure_diffusion.py [folder]

Expect (300 grains, r_min = 1 cm): k = 0.8-0.9e-2 r_min^2 with the throats of Eq. 9 (the paper: 0.29e-2, a factor of 0.32 on
all conductances); c_v K_f within 3 % of the porosity; flows within some per cent of Eqs. 21 and 22 once the front is wider than
a few pores.
The same from the command line: `capfrac lab diffusion`.
"""

import sys

import capfrac

capfrac.load_engines()

from capfrac.lab import command, parameters


def main(folder="runs/example-diffusion", grainCount=300, steps=400):
    values = parameters.resolve("diffusion", {"grains": {"count": grainCount, "rMin": 1e-2, "aspect": 1 / 0.7}, "diffusion": {"steps": steps}})
    results = command.runTest("diffusion", values, folder, report=print)
    print(f"k = {results['permeability']:.4g} m^2 = {results['kOverR2']:.4g} r_min^2; c_v K_f = {results['storageTimesBulkModulus']:.3f}, porosity {results['porosity']:.3f}")
    return results


if __name__ == "__main__":
    main(*sys.argv[1:2])
