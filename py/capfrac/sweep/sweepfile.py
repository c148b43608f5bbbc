# SPDX-License-Identifier: GPL-2.0-or-later
"""Sweep files: which injections a sweep is made of, and in which order.

A TOML file with a base case and lists of values::

    [sweep]
    title = "Grain size and cohesion"
    case = "figure16_small"               # a case file or a shipped case: what no other line says is taken from there
    [set]                              # keys of a case that all points share
    ramp.endAt = "breakthrough"
    [units]                            # of names that are no keys of a case; those with a unit are columns of the table
    rMean = "m"
    [rules]                            # formulas (see capfrac.sweep.formulas) for names and for keys of a case
    rMean = "0.5 * (grains.rMin + grains.rMax)"
    ramp.start = "2.3 * gas.interfacialTension / rMean"
    [[grid]]                           # every combination of these values; any number of grids
    grains.rMin = [1e-6, 1e-5, 1e-4]
    cohesion.chi = [0, 10]
    grains.seed = [1, 2]

An axis may be a name of its own (with a unit), which rules then use. Points are ordered so that every beginning of the
list is a useful map: all points of the first seed before any of the second; among them one grid after the other; within
a grid first the corners, then the middles of its axes, then the quarters, and so on. A point that two grids have is run
once.
"""

import math
from dataclasses import dataclass
from pathlib import Path

from capfrac.case import schema
from capfrac.errors import CaseError
from capfrac.io import tomlfiles
from capfrac.sweep.formulas import Formula
from capfrac.sweep.points import CASE_KEYS, SEED, Point, refinementLevels, resolvePoints
from capfrac.values import asFloat, didYouMean, shown

__all__ = ["Point", "Sweep", "readSweep", "refinementLevels", "resolveSweep", "shippedSweeps"]

#: More points than this are a mistake in a list rather than a plan.
MAX_POINTS = 100_000
_SWEEP_KEYS = (
    schema.Key("sweep", "title", str, "-", "", "Title of pictures and reports."),
    schema.Key("sweep", "description", str, "-", "", "What the sweep is for, where its rules come from."),
    schema.Key(
        "sweep", "case", str, "-", schema.REQUIRED, "The base: a case file (beside the sweep file) or a shipped case."
    ),
    schema.Key(
        "sweep",
        "figures",
        str,
        "-",
        "",
        "Figures that are drawn from the table.",
        choices=("", "regime_map", "hydrate_ridge_depth"),
    ),
)


@dataclass(frozen=True)
class Sweep:
    """A sweep file, read and checked."""

    name: str
    title: str
    description: str
    figures: str
    columns: dict  #: columns of the table that come from the file: name -> unit
    points: tuple  #: of :class:`~capfrac.sweep.points.Point`, in the order in which they are run


def shippedSweeps():
    """The sweeps that come with capfrac: name -> path."""
    return {path.stem: path for path in sorted((Path(__file__).parents[1] / "sweeps").glob("*.toml"))}


def readSweep(nameOrPath, overrides=()):
    """Read a sweep by path, or by name if it is one of :func:`shippedSweeps`.

    ``overrides``: texts ``section.key=value`` for [set]. Every point's case is resolved and checked here, so a sweep
    that begins can be carried out as far as its file goes. Raises :class:`CaseError` with all problems, each naming the
    entry, its value and what is allowed.
    """
    path = shippedSweeps().get(str(nameOrPath), Path(nameOrPath))
    try:
        raw = tomlfiles.readToml(path)
    except OSError as problem:
        raise CaseError(
            f"the sweep '{nameOrPath}' cannot be read ({problem.strerror}); shipped sweeps:"
            f" {', '.join(shippedSweeps())}"
        ) from None
    return resolveSweep(raw, path.stem, path.resolve().parent, str(path), overrides)


def resolveSweep(raw, name, folder=".", source="sweep", overrides=()):
    """The :class:`Sweep` of a sweep file given as a dict; see :func:`readSweep`. ``folder``: where paths begin."""
    problems = _Problems(_unknown(raw))
    head, found, _ = schema.check({"sweep": raw.get("sweep", {})}, _SWEEP_KEYS)
    problems += found
    head = head["sweep"]
    fixed = problems.collect(_flat, raw.get("set", {}), "set") or {}
    for text in overrides:
        fixed.update(problems.collect(_override, text) or {})
    units = problems.collect(_flat, raw.get("units", {}), "units") or {}
    texts = problems.collect(_flat, raw.get("rules", {}), "rules") or {}
    rules = {key: problems.collect(Formula, text, f"rules.{key}") for key, text in texts.items()}
    grids = problems.collect(_grids, raw.get("grid", []))
    axes = grids[0] if grids else {}
    problems += _namesAmiss(fixed, units, rules, axes)
    points = []
    if grids and "case" in head and None not in rules.values():
        beside = Path(folder) / head["case"]
        known = {key: value for key, value in fixed.items() if key in CASE_KEYS}
        base = str(beside) if beside.is_file() else head["case"]
        points = problems.collect(resolvePoints, base, known, rules, grids)
    if problems:
        raise CaseError(*problems, source=source)
    columns = {
        key: units.get(key, getattr(CASE_KEYS.get(key), "unit", "-"))
        for key in (*axes, *rules)
        if "." in key or key in units
    }
    return Sweep(name, head["title"], head["description"], head["figures"], columns, tuple(points))


class _Problems(list):
    """What is wrong with a sweep file, a text each."""

    def collect(self, work, *arguments):
        """What ``work`` returns; None where it raises :class:`CaseError`, whose problems are kept."""
        try:
            return work(*arguments)
        except CaseError as problem:
            self += problem.problems
            return None


def _unknown(raw):
    known = ("sweep", "set", "units", "rules", "grid")
    return [f"unknown section [{section}]; known: {', '.join(known)}" for section in raw if section not in known]


def _namesAmiss(fixed, units, rules, axes):
    """Names that stand where they must not."""
    for key in (*fixed, *(k for k in (*rules, *axes) if "." in k)):
        if key not in CASE_KEYS:
            yield f"'{key}' is no key of a case{didYouMean(key, CASE_KEYS)}"
    for key in axes:
        if key in rules or key in fixed:
            yield (
                f"'{key}' is an axis of the grid and in [{'rules' if key in rules else 'set'}], allowed: one of them"
            )
        if "." not in key and key not in units:
            yield f"the axis '{key}' has no unit; give one in [units], or take a key of a case"
    for key, unit in units.items():
        if not isinstance(unit, str) or (axes and key not in rules and key not in axes):
            yield f"units.{key} = {shown(unit)}, allowed: a text for the name of a rule or an axis"


def _flat(table, section, prefix=""):
    """Nested tables as one with dotted names: ``ramp.start`` may be written with or without quotes."""
    if not isinstance(table, dict):
        raise CaseError(f"'{section}' stands outside of a section; allowed: a section [{section}]")
    found = {}
    for key, value in table.items():
        name = f"{prefix}{key}"
        found.update(_flat(value, section, f"{name}.") if isinstance(value, dict) else {name: value})
    return found


def _override(text):
    raw = {}
    tomlfiles.override(raw, text)
    return {f"{section}.{key}": value for section, entries in raw.items() for key, value in entries.items()}


def _grids(raw):
    """The grids as dicts axis -> values, all with the same axes."""
    if not isinstance(raw, list) or not raw or not all(isinstance(grid, dict) and grid for grid in raw):
        raise CaseError("no points; needed: at least one section [[grid]] with lists of values")
    grids = [_flat(grid, "grid") for grid in raw]
    problems = [text for number, grid in enumerate(grids, start=1) for text in _axesAmiss(number, grid, grids[0])]
    if problems:
        raise CaseError(*problems)
    axes = sorted(grids[0], key=lambda axis: axis == SEED)  # the file's order, the seed last
    grids = [{axis: grid[axis] for axis in axes} for grid in grids]
    count = sum(math.prod(len(values) for values in grid.values()) for grid in grids)
    if count > MAX_POINTS:
        raise CaseError(f"{count} points, allowed: up to {MAX_POINTS}")
    return grids


def _axesAmiss(number, grid, first):
    """What is wrong with the axes of a grid."""
    if set(grid) != set(first):
        yield f"grid {number} has the axes {', '.join(grid)}; allowed: those of the first grid, {', '.join(first)}"
    for axis, values in grid.items():
        if not isinstance(values, list) or not values:
            yield f"grid {number}: {axis} = {shown(values)}, allowed: a list of values"
            continue
        beyond = [
            value
            for value in values
            if isinstance(value, (int, float)) and not isinstance(value, bool) and asFloat(value) is None
        ]
        if beyond:
            yield f"grid {number}: {axis} holds {shown(beyond[0])}, allowed: finite numbers"
        elif len(set(map(repr, values))) < len(values):
            yield f"grid {number}: {axis} = {shown(values)} has a value twice"
