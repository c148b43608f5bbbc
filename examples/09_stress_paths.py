# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress paths in the servo-controlled box: isotropic, K0, uniaxial, biaxial, constant mean stress.

    capfrac python examples/09_stress_paths.py [folder]

Expect (300 grains): sigma_H/sigma_V of 0.77 at 40 kPa without lateral strain, falling to 0.5 at high stress; walls
within 0.5 % of their stresses. The same from the command line: `capfrac lab path`.
"""

import sys

import capfrac

capfrac.load_engines()

from yade import O

from capfrac import sediment
from capfrac.lab import box, compaction
from capfrac.lab.run import LabRun


def main(folder=None, grainCount=300, strain=0.02):
    sample, last = sediment.Sediment(grainCount=grainCount, rMin=1e-3, seed=1), {}
    for mode in box.MODES:
        O.reset()
        test = box.Box(sample)
        compaction.prepareSample(sample, 10e3, LabRun("path", {}))
        test.setReference()
        test.mode(mode, stressH=10e3, meanStress=10e3)
        if mode in box.STRAIN_DRIVEN:
            test.strainTo(strain, spacing=strain / 20)
        else:
            test.stressTo([20e3, 40e3])
        last[mode] = {name: values[-1] for name, values in test.rows.items()}
        print(
            f"{mode}: strain {last[mode]['strain [-]']:.2%}, sigma_V = {last[mode]['stressV [Pa]']:.4g} Pa, sigma_H ="
            f" {last[mode]['stressH [Pa]']:.4g} Pa, servo error {max(test.rows['servoError [-]']):.2%}"
        )
    return last


if __name__ == "__main__":
    main(*sys.argv[1:2])
