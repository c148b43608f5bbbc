# SPDX-License-Identifier: GPL-2.0-or-later
"""Many injections from one file: the beginning of the regime map, and where the mode changes.

    capfrac python examples/20_regime_map.py [folder] [points] [processes]

Expect, with the first 27 points (some ten minutes on one core): fracture at the fine end and capillary invasion at the
coarse end of each stress, with a change of mode near r = 4.65 gamma / sigma'_H without cohesion: 29 um at 8 kPa.
Interrupted, the same command goes on. The same from the command line: `capfrac sweep regime_map -n 27`; leave out `-n
27` for all of it.
"""

import sys

from capfrac.sweep import figures, readSweep, regime_map, runSweep


def main(folder="runs/example-regime-map", points=27, processes=1, grainCount=200):
    sweep = readSweep("regime_map", [f"grains.count={grainCount}"])
    result = runSweep(sweep, folder, int(processes), int(points), report=print)
    drawn = figures.draw(sweep.figures, result["table"], result["table"].parent / "figures")
    rows = regime_map.read(result["table"])
    for entry in regime_map.changes(rows):
        print(
            f"chi = {entry['chi']:g}, sigma'_H = {entry['stressH'] / 1e3:g} kPa: r* ="
            f" {entry['change'].radius * 1e6:.3g} um by the modes, {entry['gaveWay'] * 1e6:.3g} um by the displacement"
            f" of the grains, by theory {entry['theory'] * 1e6:.3g} um"
        )
    print(*drawn, sep="\n")
    return rows


if __name__ == "__main__":
    main(*sys.argv[1:4])
