"""Keys of case files and of tests: one list of them says what may be given, in which unit, and what the defaults are.

The reader, the checks and the help all come from that list. An unknown key, a value of the wrong kind or out of range
is refused by name, with what is allowed.
"""

import difflib
import math
import tomllib
from dataclasses import dataclass

from capfrac.errors import CaseError

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
    high: float | None = None  #: highest value
    choices: tuple = ()

    @property
    def path(self):
        """section.name"""
        return f"{self.section}.{self.name}"

    def allowed(self):
        """What the key allows, in words."""
        if self.choices:
            return ", ".join(f"'{choice}'" for choice in self.choices)
        words = {int: "a whole number", float: "a number", str: "a text", bool: "true or false", list: "a list"}[self.kind]
        if self.low is not None:
            words += f" {'>' if self.openLow else '>='} {self.low:g}"
        if self.high is not None:
            words += f"{' and' if self.low is not None else ''} <= {self.high:g}"
        return words + (f" [{self.unit}]" if self.unit != "-" else "")


def positive(section, name, unit, default, meaning):
    """A key for a number > 0."""
    return Key(section, name, float, unit, default, meaning, low=0, openLow=True)


def notNegative(section, name, unit, default, meaning):
    """A key for a number >= 0."""
    return Key(section, name, float, unit, default, meaning, low=0)


def readToml(path):
    """The sections of a TOML file as dicts, unchecked. Raises :class:`CaseError` where it is not TOML; OSError passes.

    A byte order mark, which editors on Windows put in front, is not part of it.
    """
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError:
        raise CaseError(f"{path} is not a text in UTF-8") from None
    except tomllib.TOMLDecodeError as problem:
        raise CaseError(f"{path} is not valid TOML: {problem}") from None


def override(raw, text):
    """Put ``section.key=value`` (a TOML value) into unchecked sections."""
    name, equals, value = text.partition("=")
    section, dot, key = name.strip().partition(".")
    if not (equals and dot):
        raise CaseError(f"'{text}' is not of the form section.key=value, for example grains.seed=7")
    try:
        entries = raw.setdefault(section, {})
        if isinstance(entries, dict):  # else resolve() will say what is wrong with it
            entries[key] = tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        raise CaseError(f"{name.strip()} = {value}: not a TOML value (texts need quotes)") from None


def resolve(raw, keys, source):
    """Check sections against a list of keys and fill in the defaults: a dict of sections, each with every key of it.

    ``source`` names the file in messages. Raises :class:`CaseError` naming the key, the value and what is allowed.
    """
    known = sections(keys)
    for section, entries in raw.items():
        if section not in known:
            raise CaseError(f"{source}: unknown section [{section}]{didYouMean(section, known)}")
        if not isinstance(entries, dict):
            raise CaseError(f"{source}: '{section}' stands outside of a section; allowed sections: {', '.join(known)}")
        for name in entries:
            if name not in known[section]:
                raise CaseError(f"{source}: unknown key {section}.{name}{didYouMean(name, known[section])}")
    return {section: {name: _value(key, raw.get(section, {}).get(name, key.default), source) for name, key in entries.items()}
            for section, entries in known.items()}


def sections(keys):
    """Keys by section and name."""
    return {section: {key.name: key for key in keys if key.section == section} for section in dict.fromkeys(key.section for key in keys)}


def didYouMean(name, known):
    """End of a message about an unknown name: what it may have been meant to be, or what there is."""
    close = difflib.get_close_matches(name, known, n=1)
    return f"; did you mean '{close[0]}'?" if close else f"; known: {', '.join(known)}"


def _value(key, value, source):
    if value is REQUIRED:
        raise CaseError(f"{source}: {key.path} is missing; needed: {key.allowed()}")
    if value is None:
        return None
    good = isinstance(value, (int, float) if key.kind is float else (list, tuple) if key.kind is list else key.kind)
    good &= not (isinstance(value, bool) and key.kind is not bool)
    if good and key.kind in (int, float):
        good &= math.isfinite(value)
        good &= key.low is None or value > key.low or (value == key.low and not key.openLow)
        good &= key.high is None or value <= key.high
    if good and key.choices:
        good &= value in key.choices
    if not good:
        raise CaseError(f"{source}: {key.path} = {value!r}, allowed: {key.allowed()}")
    return float(value) if key.kind is float else list(value) if key.kind is list else value


def describe(keys):
    """All keys with unit, default and meaning, as text for people."""
    lines = []
    for section, entries in sections(keys).items():
        lines.append(f"[{section}]")
        for key in entries.values():
            default = "needed" if key.default is REQUIRED else "optional" if key.default is None else f"default {key.default!r}"
            lines.append(f"  {key.name} [{key.unit}]: {key.meaning} ({default}; {key.allowed()})")
        lines.append("")
    return "\n".join(lines)
