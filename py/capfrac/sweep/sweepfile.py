"""Sweep files: which injections a sweep is made of, and in which order.

A TOML file with a base case and lists of values::

    [sweep]
    title = "Grain size and cohesion"
    case = "figure16"                  # a case file or a shipped case: what no other line says is taken from there
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
list is a useful map: all points of the first seed before any of the second; among them one grid after the other; within a
grid first the corners, then the middles of its axes, then the quarters, and so on. A point that two grids have is run once.
"""

import itertools
import json
import math
import shlex
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from capfrac import keys, namedfiles, tomlfiles
from capfrac.case import KEYS, readCase, shippedCases
from capfrac.casepacking import checkPacking
from capfrac.errors import CaseError
from capfrac.runfolder import caseKey
from capfrac.sweep.formulas import Formula

#: Repeats of a sample: its axis is the slowest.
SEED = "grains.seed"
#: More points than this are a mistake in a list rather than a plan.
MAX_POINTS = 100_000
_SWEEP_KEYS = (
    keys.Key("sweep", "title", str, "-", "", "Title of pictures and reports."),
    keys.Key("sweep", "description", str, "-", "", "What the sweep is for, where its rules come from."),
    keys.Key("sweep", "case", str, "-", keys.REQUIRED, "The base: a case file (beside the sweep file) or a shipped case."),
    keys.Key("sweep", "figures", str, "-", "", "Figures that are drawn from the table.", choices=("", "regime_map", "hydrate_ridge_depth")),
)
_CASE_KEYS = {key.path: key for key in KEYS}


@dataclass(frozen=True)
class Point:
    """One injection of a sweep."""

    name: str  #: of its folder, from the values on the axes
    values: dict  #: axes, rules and keys set by them: name -> value
    case: dict  #: the resolved case
    arguments: tuple  #: case and overrides (``section.key=value``): what makes the same run with ``capfrac inject``
    files: dict  #: those that the case names (see :func:`capfrac.namedfiles.digests`)

    @property
    def key(self):
        """Tells the point's runs from those of other parameters or other contents of files."""
        return caseKey(self.case, self.files)

    def command(self, folder):
        """The command that runs the point into its place in the sweep's ``folder``, quoted for a shell."""
        case, *overrides = self.arguments
        sets = [word for text in overrides for word in ("-s", text)]
        return shlex.join(["capfrac", "inject", case, *sets, "-o", str(Path(folder) / "points" / self.name)])


@dataclass(frozen=True)
class Sweep:
    """A sweep file, read and checked."""

    name: str
    title: str
    description: str
    figures: str
    columns: dict  #: columns of the table that come from the file: name -> unit
    points: tuple  #: of :class:`Point`, in the order in which they are run


def shippedSweeps():
    """The sweeps that come with capfrac: name -> path."""
    return {path.stem: path for path in sorted((Path(__file__).parents[1] / "sweeps").glob("*.toml"))}


def readSweep(nameOrPath, overrides=()):
    """Read a sweep by path, or by name if it is one of :func:`shippedSweeps`; ``overrides``: texts ``section.key=value`` for [set].

    Every point's case is resolved and checked here, so a sweep that begins can be carried out as far as its file goes.
    Raises :class:`CaseError` naming the file, the entry, its value and what is allowed.
    """
    path = shippedSweeps().get(str(nameOrPath), Path(nameOrPath))
    try:
        raw = tomlfiles.readToml(path)
    except OSError as problem:
        raise CaseError(f"the sweep '{nameOrPath}' cannot be read ({problem.strerror}); shipped sweeps: {', '.join(shippedSweeps())}") from None
    return resolveSweep(raw, path.stem, path.resolve().parent, str(path), overrides)


def resolveSweep(raw, name, folder=".", source="sweep", overrides=()):
    """The :class:`Sweep` of a sweep file given as a dict; see :func:`readSweep`. ``folder``: where the base case's path begins."""
    unknown = sorted(set(raw) - {"sweep", "set", "units", "rules", "grid"})
    if unknown:
        raise CaseError(f"{source}: unknown section [{unknown[0]}]; known: sweep, set, units, rules, grid")
    head = keys.resolve({"sweep": raw.get("sweep", {})}, _SWEEP_KEYS, source)["sweep"]
    fixed = _flat(raw.get("set", {}), "set", source)
    for text in overrides:
        fixed.update(_override(text))
    units = _flat(raw.get("units", {}), "units", source)
    rules = {key: Formula(text, f"{source}: rules.{key}") for key, text in _flat(raw.get("rules", {}), "rules", source).items()}
    grids = _grids(raw.get("grid", []), source)
    for key in (*fixed, *(k for k in (*rules, *grids[0]) if "." in k)):
        if key not in _CASE_KEYS:
            raise CaseError(f"{source}: '{key}' is no key of a case{keys.didYouMean(key, _CASE_KEYS)}")
    for key in grids[0]:
        if key in rules or key in fixed:
            raise CaseError(f"{source}: '{key}' is an axis of the grid and in [{'rules' if key in rules else 'set'}], allowed: one of them")
        if "." not in key and key not in units:
            raise CaseError(f"{source}: the axis '{key}' has no unit; give one in [units], or take a key of a case")
    for key, unit in units.items():
        if not isinstance(unit, str) or (key not in rules and key not in grids[0]):
            raise CaseError(f"{source}: units.{key} = {unit!r}, allowed: a text for the name of a rule or an axis")
    beside = Path(folder) / head["case"]
    base = str(beside) if beside.is_file() else head["case"]
    points = [_point(base, fixed, rules, axes, source) for axes in _ordered(grids)]
    names = Counter(point.name.casefold() for point in points)  # some disks do not know capitals
    for folder in (point.name for point in points):
        if (count := names[folder.casefold()]) > 1:
            raise CaseError(f"{source}: {count} points would be called {folder}: values of an axis must differ in "
                            "their first six digits, or by more than capitals")
    _checkDifferent(points, source)
    columns = {key: units.get(key, getattr(_CASE_KEYS.get(key), "unit", "-")) for key in (*grids[0], *rules) if "." in key or key in units}
    return Sweep(name, head["title"], head["description"], head["figures"], columns, tuple(points))


def _checkDifferent(points, source):
    """Refuse points that would be the same run: a value without effect looks like another sample in a table."""
    first = {}
    for point in points:
        other = first.setdefault((point.key, json.dumps(point.case["output"], sort_keys=True)), point)
        if other is not point:
            axes = ", ".join(key for key in point.values if point.values[key] != other.values[key])
            raise CaseError(f"{source}: the points {other.name} and {point.name} would be the same run: {axes} has no "
                            "effect in them; leave one value of it")


def _flat(table, section, source, prefix=""):
    """Nested tables as one with dotted names: ``ramp.start`` may be written with or without quotes."""
    if not isinstance(table, dict):
        raise CaseError(f"{source}: '{section}' stands outside of a section; allowed: a section [{section}]")
    found = {}
    for key, value in table.items():
        found.update(_flat(value, section, source, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value})
    return found


def _override(text):
    raw = {}
    tomlfiles.override(raw, text)
    return {f"{section}.{key}": value for section, entries in raw.items() for key, value in entries.items()}


def _grids(raw, source):
    """The grids as dicts axis -> values, all with the same axes."""
    if not isinstance(raw, list) or not raw or not all(isinstance(grid, dict) and grid for grid in raw):
        raise CaseError(f"{source}: no points; needed: at least one section [[grid]] with lists of values")
    grids = [_flat(grid, "grid", source) for grid in raw]
    for number, grid in enumerate(grids, start=1):
        if set(grid) != set(grids[0]):
            raise CaseError(f"{source}: grid {number} has the axes {', '.join(grid)}; allowed: those of the first grid, {', '.join(grids[0])}")
        for axis, values in grid.items():
            if not isinstance(values, list) or not values:
                raise CaseError(f"{source}: grid {number}: {axis} = {values!r}, allowed: a list of values")
            if len(set(map(repr, values))) < len(values):
                raise CaseError(f"{source}: grid {number}: {axis} = {values!r} has a value twice")
    axes = sorted(grids[0], key=lambda axis: axis == SEED)  # the file's order, the seed last
    grids = [{axis: grid[axis] for axis in axes} for grid in grids]
    count = sum(math.prod(len(values) for values in grid.values()) for grid in grids)
    if count > MAX_POINTS:
        raise CaseError(f"{source}: {count} points, allowed: up to {MAX_POINTS}")
    return grids


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


def _point(base, fixed, rules, axes, source):
    """Resolve one point: base case, then [set], then the axes, then the rules in the order in which they need each other."""
    given = {**fixed, **{key: value for key, value in axes.items() if "." in key}}
    try:
        numbers = {**_numbers(base, given, source), **axes}
        for key in _byNeed(rules, source):
            whole = getattr(_CASE_KEYS.get(key), "kind", float) is int
            numbers[key] = rules[key].wholeValue(numbers) if whole else float(rules[key].value(numbers))
        arguments = [f"{key}={_toml(value)}" for key, value in {**given, **{key: numbers[key] for key in rules if "." in key}}.items()]
        case = readCase(base, arguments)
        checkPacking(case)
        files = namedfiles.digests(case, case["case"]["folder"])
    except CaseError as problem:
        raise CaseError(f"{source}: point {_name(axes)}: {problem}") from None
    return Point(_name(axes), {key: numbers[key] for key in (*axes, *rules)}, case, (base, *arguments), files)


def _numbers(base, given, source):
    """What formulas may use of a case: its numbers, each checked by itself only, for rules may still change what does not fit together."""
    path = shippedCases().get(base, Path(base))
    if not path.is_file():
        readCase(base)  # says what is wrong
    raw = tomlfiles.readToml(path)
    for key, value in given.items():
        tomlfiles.override(raw, f"{key}={_toml(value)}")
    case, _, _ = keys.check(raw, KEYS)
    return {f"{section}.{key}": value for section, entries in case.items() for key, value in entries.items()
            if isinstance(value, (int, float)) and not isinstance(value, bool)}


def _byNeed(rules, source):
    """The rules' names, each after those that its formula needs."""
    order, open_ = [], list(rules)
    while open_:
        ready = [key for key in open_ if not (rules[key].names & set(open_))]
        if not ready:
            raise CaseError(f"{source}: the rules {', '.join(open_)} need each other in a circle")
        order += ready
        open_ = [key for key in open_ if key not in ready]
    return order


def _name(axes):
    return "_".join(f"{axis.rpartition('.')[2]}{value:g}" if isinstance(value, (int, float)) and not isinstance(value, bool) else f"{axis.rpartition('.')[2]}-{value}"
                    for axis, value in axes.items()).replace("/", "-")


def _toml(value):
    """A value as TOML (JSON's texts, lists, true and false are TOML, too)."""
    return repr(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False)
