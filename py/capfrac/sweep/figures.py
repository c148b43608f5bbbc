# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of sweeps, by the name that a sweep file gives; drawn from the table alone."""

from pathlib import Path


def draw(name, table, folder):
    """Draw the figures called ``name`` (as in ``sweep.figures``) from a table into a folder; returns the paths of what
    was written.
    """
    folder = Path(folder)
    if not name:
        return []
    folder.mkdir(parents=True, exist_ok=True)
    return {"regime_map": _regimeMap, "hydrate_ridge_depth": _depth}[name](table, folder)


def _regimeMap(table, folder):
    from capfrac.sweep import regime_figures, regime_map

    rows = regime_map.read(table)
    regime_figures.drawRegimeMap(rows, folder / "regime_map.png")
    regime_figures.drawCollapse(rows, folder / "regime_collapse.png")
    regime_map.writeChanges(rows, folder / "critical_radius.csv")
    return [folder / name for name in ("regime_map.png", "regime_collapse.png", "critical_radius.csv")]


def _depth(table, folder):
    from capfrac.sweep import depth_figures

    rows = depth_figures.read(table)
    depth_figures.drawDepth(rows, folder / "hydrate_ridge_depth.png")
    depth_figures.writeSummary(rows, folder / "hydrate_ridge_depth.csv")
    return [folder / name for name in ("hydrate_ridge_depth.png", "hydrate_ridge_depth.csv")]
