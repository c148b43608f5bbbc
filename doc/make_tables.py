# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the tables of doc/validation.md and README.md from the runs: python3 doc/make_tables.py [RUNS].

RUNS is the folder of `scripts/test --validation` with its CSV files; they are copied to doc/data, and the tables
between the marks <!-- table: NAME --> and <!-- end --> are made anew from there.
"""

import csv
import re
import shutil
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).parent
STUDIES = ("figure15", "figure16", "figure16_small", "inlet", "stiffness")


def rows(study):
    with open(HERE / "data" / f"{study}.csv", newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def pressure(text, unit):
    return "-" if text == "" else f"{float(text) / {'Pa': 1, 'kPa': 1e3}[unit]:.0f}"


def perSeed(study, unit):
    lines = [
        (
            f"| seed | inlet width / r_min | initiation [{unit}] | breakthrough [{unit}] | 97 % gas [{unit}] | opened /"
            " invaded throats | broken bonds | displacement / r | at the end | opened / all throats on the way | room"
            " made | median displacement / r | mode | by the older rule |"
        ),
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for r in rows(study):
        way = int(r["openedOnWay"]), int(r["openedOnWay"]) + int(r["rigidOnWay"])
        lines.append(
            f"| {r['seed']} | {float(r['inletWidth [rMin]']):.1f} | {pressure(r['initiation [Pa]'], unit)} |"
            f" {pressure(r['breakthrough [Pa]'], unit)} | {pressure(r['P97 [Pa]'], unit)} | {r['openedThroats']} /"
            f" {r['invadedThroats']} | {r['brokenBonds']} | {float(r['displacement [r]']):.4f} |"
            f" {float(r['displacementAtEnd [r]']):.3g} | {way[0]} / {way[1]} | {float(r['madeRoom']):.3f} |"
            f" {float(r['medianDisplacement [r]']):.3g} | {r['mode']} | {r['modeByThroats']} |"
        )
    return lines


def perParameter(study, key, label, form):
    groups = {}
    for r in rows(study):
        groups.setdefault(float(r[key]), []).append(r)
    lines = [
        (
            f"| {label} | inlet width / r_min | initiation [kPa], median (range) | propagation to the outlet [kPa],"
            " median (range) | displacement / r, median | modes | by the older rule |"
        ),
        "|---|---|---|---|---|---|---|",
    ]

    def spread(group, column):
        values = sorted(float(r[column]) / 1e3 for r in group if r[column] != "")
        return (
            f"{statistics.median(values):.0f} ({values[0]:.0f}-{values[-1]:.0f}), {len(values)} of {len(group)}"
            if values
            else "none"
        )

    for value, group in sorted(groups.items()):
        named = [_count([r[rule] for r in group]) for rule in ("mode", "modeByThroats")]
        width = statistics.median(float(r["inletWidth [rMin]"]) for r in group)
        moved = statistics.median(float(r["displacement [r]"]) for r in group)
        lines.append(
            f"| {value:{form}} | {width:.0f} | {spread(group, 'initiation [Pa]')} |"
            f" {spread(group, 'breakthrough [Pa]')} | {moved:.2f} | {named[0]} | {named[1]} |"
        )
    return lines


def _count(modes):
    return (
        ", ".join(f"{modes.count(name)} {name}" for name in ("fracture", "mixed", "capillary", "none") if name in modes)
        or "-"
    )


TABLES = {
    "figure15": lambda: perSeed("figure15", "Pa"),
    "figure16": lambda: perSeed("figure16", "kPa"),
    "figure16_small": lambda: perSeed("figure16_small", "kPa"),
    "inlet": lambda: perParameter("inlet", "inletPores", "inlet [pores]", ".0f"),
    "stiffness": lambda: perParameter("stiffness", "normalStiffness [N/m]", "k_n [N/m]", ".0e"),
}


def main(runs=None):
    (HERE / "data").mkdir(exist_ok=True)
    for study in STUDIES if runs else ():
        if (Path(runs) / f"{study}.csv").exists():
            shutil.copy(Path(runs) / f"{study}.csv", HERE / "data")
    path = HERE / "validation.md"
    text = path.read_text(encoding="utf-8")
    for name, table in TABLES.items():
        if (HERE / "data" / f"{name}.csv").exists():
            filled = f"<!-- table: {name} -->\n" + "\n".join(table()) + "\n<!-- end -->"
            text = re.sub(rf"<!-- table: {name} -->.*?<!-- end -->", lambda _: filled, text, flags=re.DOTALL)
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:2])
