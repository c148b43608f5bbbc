# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the pressure cycles of the manual and draws them: capfrac python doc/make_cycle.py [grains].

The sample of Figure 15 (coarse), inlet of six pores, drained to 215 Pa, imbibed to nothing, drained again, with
snap-off at contact angles of 0 and 30 degrees and without. Writes doc/data/cycle.csv and doc/figures/cycle.png: about a
minute a cycle.
"""

import csv
import math
import sys
from pathlib import Path

import capfrac

capfrac.load_engines()

from yade import O

from capfrac import cycles, injection, sediment

STAGES = [("drainage", 215), ("imbibition", 0, 5.0), ("second drainage", 100, 10.0), ("second drainage", 215)]
#: Whether throats snap off, contact angle [degrees], number of seeds.
CASES = [(True, 0, 5), (False, 0, 3), (True, 30, 3)]


def run(seed, snapOff, degrees=0.0, grainCount=300, increment=2.0):
    """One cycle; returns its table, its measures, a map after the imbibition and the books' error."""
    O.reset()
    sediment.makeSample(
        sediment.Sediment(grainCount=grainCount, rMin=1e-3, rMax=2e-3, seed=seed), stressV=10e3, stressH=8e3
    )
    sediment.bond(capillaryStrength=0.5)
    sediment.relax()
    gas = injection.startInjection(
        start=100,
        increment=0,
        max=101,
        pores=6,
        imbibition=True,
        snapOff=snapOff,
        contactAngle=math.radians(degrees),
        checkInvariants=True,
        minLevelSteps=50,
    )
    maps, errors = [], []

    def watch(stage, pressure, saturation):
        errors.append(gas.volumes()["error"])
        if stage == "imbibition" and pressure == 0:
            maps.append(cycles.cellMap(gas))

    table = cycles.pressureCycle(gas, STAGES, increment, watch)
    return table, cycles.measure(table), maps[0], max(errors)


def row(seed, snapOff, degrees, found, error):
    first, second = found["drainage"], found["second drainage"]
    return {
        "seed": seed,
        "snapOff": snapOff,
        "contactAngle [degrees]": degrees,
        "maximum [-]": found["maximum"],
        "residual [-]": found["residual"],
        "trapped [-]": found["trapped"],
        "lost [Pa]": found["area"],
        "advance1 [Pa]": first["advance"],
        "advance2 [Pa]": second["advance"],
        "breakthrough1 [Pa]": first["breakthrough"],
        "breakthrough2 [Pa]": second["breakthrough"],
        "ledger [-]": error,
    }


def main(grainCount=300, cases=CASES):
    folder, rows, tables, maps = Path(__file__).parent, [], {}, []
    for snapOff, degrees, nSeeds in cases:
        for seed in range(1, nSeeds + 1):
            table, found, one, error = run(seed, snapOff, degrees, grainCount)
            rows.append(row(seed, snapOff, degrees, found, error))
            print(rows[-1], flush=True)
            tables.setdefault((snapOff, degrees), []).append(table)
            if seed == 1 and degrees == 0:
                maps.append(("seed 1 after imbibition, with snap-off" if snapOff else "the same without snap-off", one))
            with open(folder / "data" / "cycle.csv", "w", newline="") as file:
                writer = csv.DictWriter(file, rows[0].keys())
                writer.writeheader()
                writer.writerows({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in r.items()} for r in rows)
        cycles.drawCycle(tables[True, 0], folder / "figures" / "cycle.png", maps)
    return rows


if __name__ == "__main__":
    main(*(int(argument) for argument in sys.argv[1:2]))
