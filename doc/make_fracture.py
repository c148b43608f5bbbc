# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws Figure 14 for the manual, and writes its table and tests: capfrac python doc/make_fracture.py RUNS [TOUGHNESS].

RUNS is the folder of `scripts/test --validation` (with figure14-seed1 …), TOUGHNESS the run folder of `capfrac lab
toughness`. Nothing is drawn that is not in a run.
"""

import json
import shutil
import sys
from pathlib import Path

from capfrac import fracture, snapshot
from capfrac.plot import fracture as figures
from capfrac.verification.toughness_figures import drawToughness

HERE = Path(__file__).parent


def load(runs, case):
    """Summaries, and pairs (snapshot, fracture) at the breakthrough, of all seeds of a case."""
    folders = sorted(folder for folder in runs.glob(f"{case}-seed*") if (folder / "summary.json").exists())
    done = [
        (folder, summary)
        for folder in folders
        if (summary := json.loads((folder / "summary.json").read_text()))["state"] == "finished"
    ]
    panels = []
    for folder, summary in done:
        start, now = (
            snapshot.load(folder / "snapshots" / f"{name}.npz") for name in ("start", summary["fracture"]["moment"])
        )
        panels.append((now, fracture.findFracture(now, start)))
    return [summary for _, summary in done], panels


def main(runs, toughness=None):
    (HERE / "figures").mkdir(exist_ok=True)
    for case in ("figure14", "figure14_vertical"):
        summaries, panels = load(Path(runs), case)
        titles = [
            f"seed {s['parameters']['grains']['seed']}: {s['mode']['breakthroughPressure'] / 1e3:.0f} kPa,"
            f" {figures.branchText(found)}"
            for s, (_, found) in zip(summaries, panels)
        ]
        figures.drawFractures(panels, HERE / "figures" / f"{case}.png", titles=titles)
        print(case, fracture.orientationOfRuns(summaries))
    if (Path(runs) / "figure14.csv").exists():
        shutil.copy(Path(runs) / "figure14.csv", HERE / "data")
    if toughness:
        drawToughness(
            json.loads((Path(toughness) / "summary.json").read_text())["results"], HERE / "figures" / "toughness.png"
        )


if __name__ == "__main__":
    main(*sys.argv[1:3])
