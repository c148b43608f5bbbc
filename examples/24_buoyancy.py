# SPDX-License-Identifier: GPL-2.0-or-later
"""Buoyancy: gas that rises through a tall, rigid column fingers, gas that is pushed down from above does not.

    capfrac python examples/24_buoyancy.py [grainCount] [seeds]

The capillary pressure in a connected column of gas grows by (rho_w - rho_g) g per metre upwards. The same packings are
invaded from below and from above until the gas is through, with that gradient and without. Expect: gas saturations at
breakthrough of some 0.9 from above, 0.8 without gravity, 0.2 from below. Then the column of gas that opens a fine layer
by its buoyancy alone.
"""

import sys

import capfrac

capfrac.load_engines()

import numpy as np
from yade import O
from yade.wrapper import ForceResetter, GasInvasionEngine

from capfrac import buoyancy, sediment

WATER, GAS = 1024.0, 70.0  # kg/m^3: sea water, methane under some hundred metres of it


def column(count, seed, aspect=3.0, radius=2e-3):
    """A tall box of disks at random that do not touch, in an empty scene: its bottom and top [m]."""
    rng = np.random.default_rng(seed)
    width = 2.7 * radius * np.sqrt(count / aspect)
    disks = []
    while len(disks) < count:
        r = radius * rng.uniform(0.5, 1)
        x, y = rng.uniform(1.02 * r, width - 1.02 * r), rng.uniform(1.02 * r, aspect * width - 1.02 * r)
        if all(np.hypot(x - a, y - b) > 1.02 * (r + c) for a, b, c in disks):
            disks.append((x, y, r))
    x, y, r = np.array(disks).T
    sediment.buildScene(
        sediment.Sediment(grainCount=count, rMin=float(r.min()), rMax=float(r.max())),
        x,
        y,
        r,
        (0, width, 0, aspect * width),
    )
    return width


def saturationAtBreakthrough(count, seed, inlet, gravity):
    """Invade the column from ``inlet`` (bottom, top) until the gas is at the other end; gas saturation there [-]."""
    O.reset()
    width = column(count, seed)
    gas = GasInvasionEngine(
        inletWall=inlet,
        outletWall="top" if inlet == "bottom" else "bottom",
        inletFrom=0,
        inletTo=width,
        poreMode="triangle",
        fluidDensity=WATER,
        gasDensity=GAS,
        gravity=(0, -gravity),
        checkInvariants=True,
        invasionInterval=1,
    )
    O.engines = [ForceResetter(), gas]
    gas = O.engines[1]
    while gas.breakthroughIter < 0:
        pressure = gas.nextEntryPressure()  # at the inlet; it may fall while the gas rises
        gas.gasPressure = max(pressure, 0.0)
        O.step()
    return gas.gasSaturation


def main(count=120, seeds=3):
    results = {
        name: float(np.mean([saturationAtBreakthrough(count, seed, inlet, g) for seed in range(seeds)]))
        for name, inlet, g in (
            ("from below", "bottom", 9.81),
            ("from above", "top", 9.81),
            ("without gravity", "bottom", 0.0),
        )
    }
    for name, saturation in results.items():
        print(f"{name}: gas saturation at breakthrough {saturation:.2f}")
    height = buoyancy.criticalColumn(150e3, WATER, GAS)
    print(
        f"150 kPa, at which grains of 1 um are pushed apart, is the buoyancy of a column of {height:.1f} m; 160 Pa (1.5"
        f" mm) that of {buoyancy.criticalColumn(160, WATER, GAS) * 100:.1f} cm"
    )
    return {**results, "column": height}


if __name__ == "__main__":
    main(*(int(argument) for argument in sys.argv[1:3]))
