# SPDX-License-Identifier: GPL-2.0-or-later
"""Keys of case files and of tests: one list of them says what may be given, in which unit, and what the defaults are.

The reader, the checks and the help all come from that list. An unknown key, a value of the wrong kind or out of range
is refused by name, with what is allowed; all that is wrong is said at once.
"""

from dataclasses import dataclass

from capfrac.case import conditions
from capfrac.errors import CaseError
from capfrac.values import LARGEST_INT, asFloat, asInt, didYouMean, shown

REQUIRED = object()


@dataclass(frozen=True)
class Key:
    """One key: section and name, kind, unit, default and what it means."""

    section: str
    name: str
    kind: type
    unit: str
    default: object
    meaning: str
    low: float | None = None  #: lowest value
    openLow: bool = False  #: whether the lowest value itself is excluded
    high: float | None = None  #: highest value; of whole numbers LARGEST_INT unless given
    choices: tuple = ()
    demanded: str = (
        ""  #: condition (see :mod:`capfrac.case.conditions`) under which a key without default must be given
    )
    #: Condition without which the key would have no effect, so that another value than its default is refused.
    needs: str = ""
    #: The same for what describes rather than steers (a property of a fluid): ignored then, with a warning.
    usedWith: str = ""

    def __post_init__(self):
        if self.kind is int and self.high is None:
            object.__setattr__(self, "high", LARGEST_INT)

    @property
    def path(self):
        """section.name"""
        return f"{self.section}.{self.name}"

    def allowed(self):
        """What the key allows, in words."""
        if self.choices:
            return ", ".join(f"'{choice}'" for choice in self.choices)
        words = {int: "a whole number", float: "a number", str: "a text", bool: "true or false", list: "a list"}[
            self.kind
        ]
        number = "d" if self.kind is int else "g"
        if self.low is not None:
            words += f" {'>' if self.openLow else '>='} {self.low:{number}}"
        if self.high is not None:
            words += f"{' and' if self.low is not None else ''} <= {self.high:{number}}"
        return words + (f" [{self.unit}]" if self.unit != "-" else "")

    def checked(self, value):
        """``value`` as it is used, checked by itself.

        Raises :class:`CaseError` naming the key, the value and what is allowed.
        """
        if value is None:
            return None
        value = value.tolist() if hasattr(value, "tolist") else value  # numpy's numbers and arrays
        found = {int: asInt, float: asFloat}.get(self.kind, self._asItIs)(value)
        good = found is not None and (not self.choices or found in self.choices)
        if good and self.kind in (int, float):
            good &= self.low is None or found > self.low or (found == self.low and not self.openLow)
            good &= self.high is None or found <= self.high
        if not good:
            raise CaseError(f"{self.path} = {shown(value)}, allowed: {self.allowed()}")
        return found

    def _asItIs(self, value):
        if self.kind is list:
            return list(value) if isinstance(value, (list, tuple)) else None
        return value if isinstance(value, self.kind) else None


def positive(section, name, unit, default, meaning, **options):
    """A key for a number > 0."""
    return Key(section, name, float, unit, default, meaning, low=0, openLow=True, **options)


def notNegative(section, name, unit, default, meaning, **options):
    """A key for a number >= 0."""
    return Key(section, name, float, unit, default, meaning, low=0, **options)


class _Unsound(Exception):
    """A check asked for a key that was refused."""


class _Sound(dict):
    """The keys of a section that are good as such; who asks for another one cannot go on."""

    def __missing__(self, name):
        raise _Unsound(name)


def check(raw, keys, checks=(), tolerated=()):
    """Check sections against a list of keys: ``(sections, problems, warnings)``, a dict of sections and lists of texts.

    Sections have every key, with its default where it is not given, but for those that are refused. ``checks``:
    functions (sections) -> texts, what does not fit together; one that asks for a refused key is left where it asks.
    Keys without effect get their default: where they are ``usedWith`` something that is not there with a warning, where
    they have ``needs`` only if their path is among ``tolerated``, else they are a problem.
    """
    known = sections(keys)
    sound = {section: _Sound() for section in known}
    if not isinstance(raw, dict):
        return sound, [f"{shown(raw)}, needed: a dict of sections"], []
    problems, warnings = list(_unknown(raw, known)), []
    for key in keys:
        value = _given(key, raw)
        try:
            if value is not REQUIRED and isinstance(raw.get(key.section, {}), dict):
                sound[key.section][key.name] = key.checked(value)
        except CaseError as problem:
            problems += problem.problems
    idle = {}
    for key in keys:
        problems += collected(_missing, key, raw, sound)
        for refusal, warning in collected(_idle, key, sound):
            if key.usedWith or key.path in tolerated:
                idle[key] = warning
            else:
                problems.append(refusal)
    for key, warning in idle.items():
        warnings.append(warning)
        sound[key.section][key.name] = key.checked(key.default)
    for check in checks:
        problems += collected(check, sound)
    return sound, problems, warnings


def resolve(raw, keys, source, checks=()):
    """Check sections (see :func:`check`) and fill in the defaults: a dict of sections, each with every key of it.

    ``source`` names the file in messages. Raises :class:`CaseError` with all problems, each naming the key, the value
    and what is allowed.
    """
    sound, problems, _ = check(raw, keys, checks)
    if problems:
        raise CaseError(*problems, source=source)
    return {section: dict(entries) for section, entries in sound.items()}


def _unknown(raw, known):
    for section, entries in raw.items():
        if section not in known:
            yield f"unknown section [{section}]{didYouMean(section, known)}"
        elif not isinstance(entries, dict):
            yield f"'{section}' stands outside of a section; allowed sections: {', '.join(known)}"
        else:
            for name in entries:
                if name not in known[section]:
                    yield f"unknown key {section}.{name}{didYouMean(name, known[section])}"


def collected(check, *arguments):
    """What a check finds until it asks for a key that was refused."""
    found = []
    try:
        for problem in check(*arguments):
            found.append(problem)
    except _Unsound:
        pass
    return found


def _given(key, raw):
    """What the sections say of a key; its default where they say nothing, or None (as a Python dict may)."""
    entries = raw.get(key.section, {})
    value = entries.get(key.name) if isinstance(entries, dict) else None
    return key.default if value is None else value


def _missing(key, raw, sound):
    demanded = key.demanded and sound[key.section][key.name] is None and conditions.holds(key.demanded, sound)
    if demanded or _given(key, raw) is REQUIRED:
        yield f"{key.path} is missing; needed: {key.allowed()}"


def _idle(key, sound):
    """Of a key that has no effect: what is allowed, and how a warning says it."""
    condition, value = key.needs or key.usedWith, sound[key.section][key.name]
    if condition and value != key.checked(key.default) and not conditions.holds(condition, sound):
        why = conditions.asItIs(condition, sound)
        value = str(value).lower() if isinstance(value, bool) else shown(value)
        only = f"it has an effect only {conditions.inWords(condition)}"
        yield (
            f"{key.path} = {value}, allowed: {_asText(key.default)} {why}; {only}",
            f"{key.path} = {value} is ignored {why}: {only}",
        )


def _asText(default):
    if default is None or default == () or default == "":
        return "none"
    if isinstance(default, bool):
        return str(default).lower()
    return f"{default:g}" if isinstance(default, float) else shown(default)


def sections(keys):
    """Keys by section and name."""
    return {
        section: {key.name: key for key in keys if key.section == section}
        for section in dict.fromkeys(key.section for key in keys)
    }


def describe(keys):
    """All keys with unit, default and meaning, as text for people."""
    lines = []
    for section, entries in sections(keys).items():
        lines.append(f"[{section}]")
        for key in entries.values():
            use = f"; only {conditions.inWords(key.needs or key.usedWith)}" if key.needs or key.usedWith else ""
            lines.append(f"  {key.name} [{key.unit}]: {key.meaning} ({_defaultInWords(key)}; {key.allowed()}{use})")
        lines.append("")
    return "\n".join(lines)


def _defaultInWords(key):
    if key.default is REQUIRED:
        return "needed"
    if key.default is not None:
        return f"default {key.default!r}"
    return f"needed {conditions.inWords(key.demanded)}" if key.demanded else "optional"
