# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the pictures of the README and the manual from finished runs: capfrac python doc/make_figures.py RUNS.

RUNS is the folder that scripts/demo filled. Nothing is drawn that is not in a run.
"""

import json
import sys
from pathlib import Path

from capfrac import figures, snapshot

#: The two moments that each picture shows, where the run has them.
PANELS = {
    "figure15": ("170Pa", "200Pa"),
    "figure16": ("initiation", "breakthrough"),
    "hydrate_ridge_1248C": ("start", "breakthrough"),
}


def pair(runs, name, first, second, path):
    shots = [snapshot.load(runs / name / "snapshots" / f"{moment}.npz") for moment in (first, second)]
    figures.drawPair(shots, path)


def main(runs):
    runs, folder = Path(runs), Path(__file__).parent / "figures"
    folder.mkdir(exist_ok=True)
    for name, (first, second) in PANELS.items():
        taken = [entry["name"] for entry in json.loads((runs / name / "summary.json").read_text())["snapshots"]]
        pair(
            runs,
            name,
            first if first in taken else "start",
            second if second in taken else "end",
            folder / f"{name}.png",
        )


if __name__ == "__main__":
    main(sys.argv[1])
