# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures and tables of doc/regime_map.md and doc/hydrate_ridge.md: capfrac python doc/make_regime.py [RUNS].

RUNS is a folder with the sweeps regime_map and hydrate_ridge_depth; their tables are copied to doc/data. Figures and
the tables between the marks <!-- table: NAME --> and <!-- end --> are made from there: nothing in them is not in a run.
"""

import csv
import re
import shutil
import sys
from pathlib import Path

import numpy as np

from capfrac import regime
from capfrac.sweep import depth_figures, regime_figures, regime_map

HERE = Path(__file__).parent
MAP, DEPTH = HERE / "data" / "regime_map.csv", HERE / "data" / "hydrate_ridge_depth_runs.csv"


def micrometres(value):
    return "-" if not np.isfinite(value) else f"{value * 1e6:.3g}" if value * 1e6 >= 0.1 else f"{value * 1e6:.2g}"


def criticalRadius(rows):
    """r* of each cohesion and stress, by both rules of the mode, by the displacement and by theory."""
    lines = [
        (
            "| cohesion χ | σ'_H [kPa] | runs | a / r̄ | all fracture up to [um] | none does from [um] | all capillary"
            " from [um] | r* by the modes [um] | by the older rule [um] | r* by displacement [um] | theory [um] |"
        ),
        "|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for entry in regime_map.changes(rows):
        change = entry["change"]
        radii = [
            micrometres(value)
            for value in (
                change.low,
                change.high,
                change.rigid,
                change.radius,
                entry["byThroats"].radius,
                entry["gaveWay"],
            )
        ]
        lines.append(
            f"| {entry['chi']:g} | {entry['stressH'] / 1e3:g} | {change.runs} | {entry['aOverR']:.1f} |"
            f" {' | '.join(radii)} | {micrometres(entry['theory']) if entry['theory'] else 'none'} |"
        )
    return lines


def exponents(rows):
    """Exponent of r* against sigma'_H, and sigma'_H r*/gamma of all stresses together."""
    lines = [
        (
            "| cohesion χ | exponent, by the modes | exponent, by displacement | σ'_H r*/γ, by the modes (bracket) |"
            " σ'_H r*/γ, by displacement | theory |"
        ),
        "|---|---|---|---|---|---|",
    ]
    fits, together = regime_map.laws(regime_map.changes(rows)), regime_map.numbers(rows)
    for chi, entry in together.items():
        cells = [
            (
                f"{fits[chi][o].exponent:.3f}"
                + (f" ± {fits[chi][o].error:.3f}" if np.isfinite(fits[chi][o].error) else " (two stresses)")
                if o in fits[chi]
                else "-"
            )
            for o in ("change", "gaveWay")
        ]
        a = float(np.median([row["aOverR"] for row in rows if row["cohesion.chi [-]"] == chi]))
        change = entry["change"]
        bracket = f"{change.low:.2g}-{change.high:.2g}" if np.isfinite(change.low) else f"up to {change.high:.2g}"
        lines.append(
            f"| {chi:g} | {' | '.join(cells)} | {change.radius:.2g} ({bracket}) | {entry['gaveWay']:.2g} |"
            f" {max(regime.RIGID - chi * (regime.ALPHA / a) ** 0.5, 0):.2g} |"
        )
    return lines


def depths(rows):
    """Theory and runs of Hydrate Ridge, depth by depth."""
    with open(HERE / "data" / "hydrate_ridge_depth.csv", newline="", encoding="utf-8") as stream:
        table = list(csv.DictReader(stream))
    lines = [
        (
            "| depth [m] | σ'_H [kPa] | threshold / σ'_H | fracture in that share of the ranges | P_c of theory [kPa] |"
            " P_c of the runs [kPa] | gas column, theory [m] | gas column, runs [m] | modes, best guess | modes"
            " elsewhere in the ranges |"
        ),
        "|---|---|---|---|---|---|---|---|---|---|",
    ]

    def span(row, name, unit, scale=1.0, form=".3g", middle=True):
        low, best, high = (float(row[f"{name}{end} [{unit}]"]) / scale for end in ("Low", "", "High"))
        return f"{best:{form}} ({low:{form}}-{high:{form}})"

    for row in table:
        run, column = (
            (
                [float(row[f"{name}{end} [{unit}]"]) / scale for end in ("Low", "High")]
                if row[f"{name}Low [{unit}]"]
                else []
            )
            for name, unit, scale in (("runPressure", "Pa", 1e3), ("runColumn", "m", 1))
        )
        between = [
            (
                "-"
                if not ends
                else f"{ends[0]:.0f}"
                if round(ends[0]) == round(ends[1])
                else f"{ends[0]:.0f}-{ends[1]:.0f}"
            )
            for ends in (run, column)
        ]
        lines.append(
            f"| {float(row['depth [m]']):.0f} | {span(row, 'stressH', 'Pa', 1e3, '.0f')} |"
            f" {span(row, 'ratio', '-', form='.2f')} | {float(row['fractureShare [-]']):.0%} |"
            f" {span(row, 'pressure', 'Pa', 1e3, '.0f')} | {between[0]} | {span(row, 'column', 'm', form='.0f')} |"
            f" {between[1]} | {row['modes'] or '-'} | {row['modesElsewhereInTheRanges'] or '-'} |"
        )
    return lines


def fill(path, tables):
    """Put tables into their places of a page."""
    text = path.read_text(encoding="utf-8")
    for name, lines in tables.items():
        filled = f"<!-- table: {name} -->\n" + "\n".join(lines) + "\n<!-- end -->"
        text = re.sub(rf"<!-- table: {name} -->.*?<!-- end -->", lambda _: filled, text, flags=re.DOTALL)
    path.write_text(text, encoding="utf-8")


def main(runs=None):
    for name, target in (("regime_map", MAP), ("hydrate_ridge_depth", DEPTH)) if runs else ():
        if (Path(runs) / name / "table.csv").exists():
            shutil.copy(Path(runs) / name / "table.csv", target)
    figures = HERE / "figures"
    if MAP.exists():
        rows = regime_map.read(MAP)
        regime_figures.drawRegimeMap(rows, figures / "regime_map.png")
        regime_figures.drawCollapse(rows, figures / "regime_collapse.png")
        regime_map.writeChanges(rows, HERE / "data" / "critical_radius.csv")
        fill(HERE / "regime_map.md", {"critical_radius": criticalRadius(rows), "exponents": exponents(rows)})
    if DEPTH.exists():
        rows = depth_figures.read(DEPTH)
        depth_figures.drawDepth(rows, figures / "hydrate_ridge_depth.png")
        depth_figures.writeSummary(rows, HERE / "data" / "hydrate_ridge_depth.csv")
        fill(HERE / "hydrate_ridge.md", {"depths": depths(rows)})


if __name__ == "__main__":
    main(*sys.argv[1:2])
