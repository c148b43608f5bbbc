# SPDX-License-Identifier: GPL-2.0-or-later
"""Puts the results of `scripts/laboratory` into the manual: capfrac python doc/make_laboratory.py [RUNS].

Copies pictures, draws those that come from a summary alone, and writes the tables of doc/laboratory.md between its
marks.
"""

import json
import re
import shutil
import sys
from pathlib import Path

from capfrac.lab import strength_figures

HERE = Path(__file__).parent
PICTURES = {
    "settle": ("figure7", "figure8"),
    "timestep": ("figure9",),
    "hydrate-ridge": ("figure10",),
    "compact": ("compaction",),
    "biaxial-bonded": ("biaxial",),
    "contacts": ("contacts",),
    "diffusion": ("figure11", "figure12"),
    "closed-forms": ("closed-forms",),
    "undrained": ("figure13",),
    "terzaghi": ("terzaghi",),
    "mandel": ("mandel",),
    "stability": ("stability",),
    "percolation": ("percolation",),
    "displacement": ("displacement",),
}
#: Tables that the manual offers as files.
DATA = {"percolation": ("percolation",)}
UNITS = {
    "youngModulus": ("E [MPa]", 1e-6),
    "poissonRatio": ("ν", 1),
    "frictionAngle": ("φ [°]", 1),
    "cohesion": ("c [kPa]", 1e-3),
}


def results(runs, name):
    return json.loads((runs / name / "summary.json").read_text())["results"]


def table(header, rows):
    return [f"| {' | '.join(header)} |", "|" + "---|" * len(header), *(f"| {' | '.join(row)} |" for row in rows)]


def properties(found, digits=3):
    return [f"{found[name] * scale:.{digits}g}" for name, (_, scale) in UNITS.items()]


def biaxial(runs):
    header = ["sample", *(label for label, _ in UNITS.values())]
    return table(
        header,
        [
            [name, *properties(results(runs, f"biaxial-{key}"))]
            for name, key in (("no bonds", "unbonded"), ("bonds of 100 kPa", "bonded"))
        ],
    )


def sizes(runs):
    found = results(runs, "sizes")["table"]
    header = ["r_min [m]", *(label for label, _ in UNITS.values())]
    return table(
        header,
        [
            [f"{r:.4g}", *properties({name: found[name][k] for name in UNITS}, 5)]
            for k, r in enumerate(found["rMin [m]"])
        ],
    )


def sensitivity(runs):
    found = results(runs, "sensitivity")["exponent"]
    header = ["parameter", *(label.split(" ")[0] for label, _ in UNITS.values())]
    return table(
        header, [[parameter, *(f"{exponents[name]:+.2f}" for name in UNITS)] for parameter, exponents in found.items()]
    )


def loops(runs):
    found = results(runs, "hydrate-ridge")
    rows = [
        [
            f"{found['stiffness'][name]:.3g}",
            f"{found['Cc'][name]:.3f}",
            *(f"{loop['Cr']:.3f}" for loop in found["loops"][name]),
        ]
        for name in found["stiffness"]
    ]
    return table(["k_n [N/m]", "C_c", "C_r at 5 %", "at 10 %", "at 15 %", "at 20 %"], rows)


TABLES = {"biaxial": biaxial, "sizes": sizes, "sensitivity": sensitivity, "loops": loops}


def main(runs):
    runs, folder = Path(runs), HERE / "figures"
    for test, names in PICTURES.items():
        for name in names:
            shutil.copy(runs / test / "pictures" / f"{name}.png", folder / f"{name}.png")
    for test, names in DATA.items():
        for name in names:
            shutil.copy(runs / test / "tables" / f"{name}.csv", HERE / "data" / f"{name}.csv")
    strength_figures.drawSensitivity(results(runs, "sensitivity"), folder / "sensitivity.png")
    path = HERE / "laboratory.md"
    text = path.read_text(encoding="utf-8")
    for name, make in TABLES.items():
        text = re.sub(
            rf"<!-- table: {name} -->\n.*?<!-- end -->",
            "\n".join([f"<!-- table: {name} -->", *make(runs), "<!-- end -->"]),
            text,
            flags=re.DOTALL,
        )
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else HERE.parent / "build" / "laboratory")
