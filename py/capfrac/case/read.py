# SPDX-License-Identifier: GPL-2.0-or-later
"""Case files: everything an injection needs to know, one TOML file, every key with its unit.

What may be in one is told by the keys in :mod:`capfrac.case.keys`.
An unknown key, a value of the wrong kind or out of range is refused by name, with what is allowed; so is a key that has
no effect because what it belongs to is off. All that is wrong is said at once.
"""

import copy
import os
from pathlib import Path

from capfrac.case import checks, schema
from capfrac.case.keys import KEYS
from capfrac.case.packing import checkPacking
from capfrac.errors import CaseError
from capfrac.io import tomlfiles
from capfrac.values import shown

#: What a resolved case says beside its keys: name, kind, what is allowed.
_MARKS = (("name", str, "a text"), ("folder", str, "a text"), ("warnings", list, "a list of texts"))


def shippedCases():
    """The cases that come with capfrac: name -> path."""
    folder = Path(__file__).parents[1] / "cases"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def readCase(nameOrPath, overrides=()):
    """Read a case by path, or by name if it is one of :func:`shippedCases`.

    ``overrides`` are texts ``section.key=value`` (TOML values) that replace what the file says. Returns the resolved
    case: a dict of sections, each a dict with every key of ``KEYS``, plus ``case.name``, ``case.folder`` and
    ``case.warnings``, texts on what is ignored. Raises :class:`CaseError` with all problems, each naming the key, the
    value and what is allowed. A key that an override leaves without effect, as it switches off what the key belongs to,
    is ignored with a warning.
    """
    if not isinstance(nameOrPath, (str, os.PathLike)):
        raise CaseError(
            f"case = {shown(nameOrPath)}, allowed: the name of a shipped case, a path, or a dict of sections"
        )
    path = shippedCases().get(str(nameOrPath), Path(nameOrPath))
    try:
        raw = tomlfiles.readToml(path)
    except OSError as problem:
        shipped = ", ".join(shippedCases())
        raise CaseError(
            f"the case '{nameOrPath}' cannot be read ({problem.strerror}); shipped cases: {shipped}"
        ) from None
    used = _used(raw)
    problems = []
    for override in overrides:
        try:
            used.discard(tomlfiles.override(raw, override))
        except CaseError as problem:
            problems += problem.problems
    folder = str(path.resolve().parent)
    case = _resolve(raw, str(path), folder, problems, used)
    case["case"].update(name=path.stem, folder=folder)
    return case


def resolveCase(raw, source="case"):
    """Check a case given as a dict of sections and fill in the defaults; see :func:`readCase`. Returns a new dict.

    A resolved case comes out as it is. ``case.name``, ``case.folder`` (where paths of files begin) and
    ``case.warnings`` may be given, too.
    """
    raw = copy.deepcopy(raw)
    marks, problems = {}, []
    entries = raw.get("case") if isinstance(raw, dict) else None
    for name, kind, allowed in _MARKS:
        if isinstance(entries, dict) and name in entries:
            marks[name] = entries.pop(name)
            if not isinstance(marks[name], kind):
                problems.append(f"case.{name} = {shown(marks[name])}, allowed: {allowed}")
    case = _resolve(raw, source, marks.get("folder", "."), problems)
    warnings = [*marks.pop("warnings", []), *case["case"]["warnings"]]
    case["case"].update(marks, warnings=list(dict.fromkeys(warnings)))
    return case


def _used(raw):
    """Paths of the keys of a case file that steer something, as the file is."""
    sound = schema.check(raw, KEYS)[0]
    return {key.path for key in KEYS if key.needs and sound[key.section].get(key.name) != key.checked(key.default)}


def _resolve(raw, source, folder, problems, tolerated=()):
    sound, found, warnings = schema.check(raw, KEYS, checks.CHECKS, tolerated)
    if problems or found:
        raise CaseError(*problems, *found, *schema.collected(_packingAmiss, sound, folder), source=source)
    case = {section: dict(entries) for section, entries in sound.items()}
    _complete(case)
    case["case"]["warnings"] = warnings
    return case


def _packingAmiss(sound, folder):
    """What is wrong with the packing of a case that is refused anyway; that of a good one is read when it is run."""
    if sound["grains"]["packing"]:
        try:
            checkPacking({"grains": sound["grains"], "case": {"folder": folder}})
        except CaseError as problem:
            yield from problem.problems


def _complete(case):
    """Fill in the defaults that follow from other keys; lists of numbers become floats."""
    grains, ramp, supply = case["grains"], case["ramp"], case["supply"]
    if grains["rMax"] is None and grains["rMin"] is not None:
        grains["rMax"] = 2 * grains["rMin"]
    if grains["shearStiffness"] is None:
        grains["shearStiffness"] = grains["normalStiffness"]
    if ramp["start"] is None:
        ramp["start"] = 0.0
    if ramp["endAt"] is None:
        endless = supply["control"] == "rate" and ramp["max"] is supply["maxMass"] is supply["maxTime"] is None
        ramp["endAt"] = "breakthrough" if endless else "max"
    for section, name in (("gas", "gravity"), ("supply", "program"), ("output", "pressures")):
        case[section][name] = list(map(float, case[section][name]))
    for section, name in (("gas", "table"), ("inlet", "points")):
        case[section][name] = [list(map(float, pair)) for pair in case[section][name]]


def describeKeys():
    """All keys with unit, default and meaning, as text for people."""
    return schema.describe(KEYS)
