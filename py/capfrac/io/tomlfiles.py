# SPDX-License-Identifier: GPL-2.0-or-later
"""TOML: the files of cases, sweeps and tests as dicts, unchecked, and single values that replace what they say."""

import re
import sys
import tomllib

from capfrac.errors import CaseError


def readToml(path):
    """The sections of a TOML file as dicts, unchecked. Raises :class:`CaseError` where it is not TOML; OSError passes.

    A byte order mark, which editors on Windows put in front, is not part of it.
    """
    try:
        return parseToml(path.read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError:
        raise CaseError(f"{path} is not a text in UTF-8") from None
    except CaseError as problem:
        raise CaseError(f"{path} is not valid TOML: {problem}") from None


def parseToml(text):
    """The tables of a TOML text.

    Raises :class:`CaseError` saying where it is none, and for numbers with more digits than Python reads.
    """
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as problem:
        raise CaseError(str(problem)) from None
    except RecursionError:
        raise CaseError("lists in lists, too many of them") from None
    except ValueError as problem:  # Python's own limit on the digits of whole numbers
        limit = sys.get_int_max_str_digits()
        for number, line in enumerate(text.splitlines(), start=1):
            digits = max(map(len, re.findall(r"\d+", line.replace("_", ""))), default=0)
            if digits > limit:
                name = line.partition("=")[0].strip()
                raise CaseError(f"line {number}, {name}: a number of {digits} digits, allowed: up to {limit}") from None
        raise CaseError(str(problem)) from None


def override(raw, text):
    """Put ``section.key=value`` (a TOML value) into unchecked sections; returns ``section.key``."""
    name, equals, value = text.partition("=")
    section, dot, key = name.strip().partition(".")
    if not (equals and dot):
        raise CaseError(f"'{text}' is not of the form section.key=value, for example grains.seed=7")
    try:
        found = parseToml(f"value = {value}")
        if set(found) != {"value"}:
            raise CaseError("several values")
    except CaseError as problem:
        digits = "digits" in str(problem)
        reason = str(problem).partition(": ")[2] if digits else "not a TOML value (texts need quotes)"
        raise CaseError(f"{name.strip()} = {value if len(value) < 60 else value[:60] + ' …'}: {reason}") from None
    entries = raw.setdefault(section, {})
    if isinstance(entries, dict):  # else resolve() will say what is wrong with it
        entries[key] = found["value"]
    return f"{section}.{key}"
