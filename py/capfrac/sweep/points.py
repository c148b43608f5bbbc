# SPDX-License-Identifier: GPL-2.0-or-later
"""The points of a sweep: their order, and the case of each."""

import itertools
import json
import shlex
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from capfrac.case import schema
from capfrac.case.packing import checkPacking
from capfrac.case.read import KEYS, readCase, shippedCases
from capfrac.errors import CaseError
from capfrac.io import namedfiles, tomlfiles
from capfrac.run.folder import caseKey
from capfrac.values import asFloat, shown

#: Repeats of a sample: its axis is the slowest.
SEED = "grains.seed"
#: Problems of points that are told at most.
MOST_TOLD = 20
CASE_KEYS = {key.path: key for key in KEYS}


@dataclass(frozen=True)
class Point:
    """One injection of a sweep."""

    name: str  #: of its folder, from the values on the axes
    values: dict  #: axes, rules and keys set by them: name -> value
    case: dict  #: the resolved case
    arguments: tuple  #: case and overrides (``section.key=value``): what makes the same run with ``capfrac inject``
    files: dict  #: those that the case names (see :func:`capfrac.io.namedfiles.digests`)

    @property
    def key(self):
        """Tells the point's runs from those of other parameters or other contents of files."""
        return caseKey(self.case, self.files)

    def command(self, folder):
        """The command that runs the point into its place in the sweep's ``folder``, quoted for a shell."""
        case, *overrides = self.arguments
        sets = [word for text in overrides for word in ("-s", text)]
        return shlex.join(["capfrac", "inject", case, *sets, "-o", str(Path(folder) / "points" / self.name)])


def resolvePoints(base, fixed, rules, grids):
    """All points, in order: those of the base case with the values ``fixed``, the ``rules`` and the axes of ``grids``.

    Raises :class:`CaseError` with what is wrong with any of them; what several have in common is told once.
    """
    rules = {key: rules[key] for key in _byNeed(rules)}
    points, amiss = [], {}
    for axes in _ordered(grids):
        try:
            points.append(_point(base, fixed, rules, axes))
        except CaseError as problem:
            for text in problem.problems:
                amiss.setdefault(text, []).append(_name(axes))
    problems = [
        f"point {names[0]}: {text}{f' (and {len(names) - 1} more points)' if len(names) > 1 else ''}"
        for text, names in amiss.items()
    ]
    if len(problems) > MOST_TOLD:
        problems[MOST_TOLD:] = [f"and {len(problems) - MOST_TOLD} more problems of points"]
    problems += _sameNames(points)
    problems += _sameRuns(points)
    if problems:
        raise CaseError(*problems)
    return points


def _sameNames(points):
    names = Counter(point.name.casefold() for point in points)  # some disks do not know capitals
    for folder in {point.name.casefold(): point.name for point in reversed(points)}.values():
        if (count := names[folder.casefold()]) > 1:
            yield (
                f"{count} points would be called {folder}: values of an axis must differ in their first six digits, "
                "or by more than capitals"
            )


def _sameRuns(points):
    """Points that would be the same run: a value without effect looks like another sample in a table."""
    first = {}
    for point in points:
        other = first.setdefault((point.key, json.dumps(point.case["output"], sort_keys=True)), point)
        if other is not point:
            axes = ", ".join(key for key in point.values if point.values[key] != other.values[key])
            yield (
                f"the points {other.name} and {point.name} would be the same run: {axes} has no effect in them; "
                "leave one value of it"
            )
            return


def refinementLevels(count):
    """At which halving of an axis with that many values each of them is first met: 0 for the ends, then 1, 2, ..."""
    levels = [0] * count
    stretches, level = [(0, count - 1)], 1
    while stretches:
        halves = []
        for low, high in stretches:
            if high - low > 1:
                middle = (low + high) // 2
                levels[middle] = level
                halves += [(low, middle), (middle, high)]
        stretches, level = halves, level + 1
    return levels


def _ordered(grids):
    """The axes' values of all points in the order of the runs (see the module)."""
    ranked = []
    for number, grid in enumerate(grids):
        levels = {axis: refinementLevels(len(values)) for axis, values in grid.items() if axis != SEED}
        for indices in itertools.product(*(range(len(values)) for values in grid.values())):
            place = dict(zip(grid, indices))
            level = [levels[axis][k] for axis, k in place.items() if axis != SEED]
            rank = place.get(SEED, 0), number, max(level, default=0), sum(level), indices
            ranked.append((rank, {axis: grid[axis][k] for axis, k in place.items()}))
    found = {}
    for _, axes in sorted(ranked, key=lambda entry: entry[0]):
        found.setdefault(tuple(map(repr, axes.values())), axes)
    return list(found.values())


def _point(base, fixed, rules, axes):
    """Resolve one point: base case, then [set], then the axes, then the rules, in the order in which they come."""
    given = {**fixed, **{key: value for key, value in axes.items() if "." in key}}
    numbers = {**_numbers(base, given), **axes}
    for key, rule in rules.items():
        whole = getattr(CASE_KEYS.get(key), "kind", float) is int
        numbers[key] = rule.wholeValue(numbers) if whole else float(rule.value(numbers))
    values = {**given, **{key: numbers[key] for key in rules if "." in key}}
    arguments = [f"{key}={_toml(value)}" for key, value in values.items()]
    case = readCase(base, arguments)
    checkPacking(case)
    files = namedfiles.digests(case, case["case"]["folder"])
    return Point(_name(axes), {key: numbers[key] for key in (*axes, *rules)}, case, (base, *arguments), files)


def _numbers(base, given):
    """What formulas may use of a case: its numbers, each checked by itself only.

    For rules may still change what does not fit together.
    """
    path = shippedCases().get(base, Path(base))
    if not path.is_file():
        readCase(base)  # says what is wrong
    raw = tomlfiles.readToml(path)
    for key, value in given.items():
        tomlfiles.override(raw, f"{key}={_toml(value)}")
    case, _, _ = schema.check(raw, KEYS)
    return {
        f"{section}.{key}": value
        for section, entries in case.items()
        for key, value in entries.items()
        if isinstance(value, (int, float)) and not isinstance(value, bool)
    }


def _byNeed(rules):
    """The rules' names, each after those that its formula needs."""
    order, open_ = [], list(rules)
    while open_:
        ready = [key for key in open_ if not (rules[key].names & set(open_))]
        if not ready:
            raise CaseError(f"the rules {', '.join(open_)} need each other in a circle")
        order += ready
        open_ = [key for key in open_ if key not in ready]
    return order


def _name(axes):
    parts = [(axis.rpartition(".")[2], value) for axis, value in axes.items()]
    return "_".join(
        f"{name}-{value}" if asFloat(value) is None else f"{name}{value:g}" for name, value in parts
    ).replace("/", "-")


def _toml(value):
    """A value as TOML (JSON's texts, lists, true and false are TOML, too)."""
    try:
        return repr(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False, default=str)
    except ValueError:
        raise CaseError(f"{shown(value)}: no value of a case") from None
