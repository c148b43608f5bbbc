# SPDX-License-Identifier: GPL-2.0-or-later
"""Conditions between keys, as the table of keys states them: ``"gas.trapping = true or water.flow = 'solved'"``.

Terms are ``key = value``, ``key != value`` (TOML values), ``key`` (it is set: not empty, none, zero or false) and
``no key``, joined by ``and`` and, more loosely, by ``or``.
"""

import functools
import tomllib

from capfrac.values import shown


@functools.cache
def parsed(text):
    """Alternatives of a condition, each a tuple of terms ``(path, relation, value)``.

    ``relation``: '=', '!=', 'set' or 'no'; the last two have no value.
    """
    return tuple(tuple(map(_term, alternative.split(" and "))) for alternative in text.split(" or "))


def _term(text):
    text = text.strip()
    for relation in ("!=", "="):
        path, found, value = text.partition(f" {relation} ")
        if found:
            return path, relation, tomllib.loads(f"value = {value}")["value"]
    return (text[3:], "no", None) if text.startswith("no ") else (text, "set", None)


def paths(text):
    """The keys that a condition asks for, ``section.name``."""
    return {path for alternative in parsed(text) for path, _, _ in alternative}


def holds(text, sections):
    """Whether a condition holds in ``sections`` (section -> name -> value)."""
    return any(all(_holds(term, sections) for term in alternative) for alternative in parsed(text))


def _valueOf(path, sections):
    section, _, name = path.partition(".")
    return sections[section][name]


def _isSet(value):
    return any(map(_isSet, value)) if isinstance(value, (list, tuple)) else bool(value)


def _holds(term, sections):
    path, relation, wanted = term
    value = _valueOf(path, sections)
    if relation in ("set", "no"):
        return _isSet(value) == (relation == "set")
    return (value == wanted) == (relation == "=")


def inWords(text):
    """A condition for people: ``with gas.trapping = true or with water.flow = 'solved'``."""
    return " or ".join(" and ".join(map(_termInWords, alternative)) for alternative in parsed(text))


def _termInWords(term):
    path, relation, value = term
    if relation in ("set", "no"):
        return f"with {path}" if relation == "set" else f"without {path}"
    return f"with {path} {relation} {_toml(value)}"


def asItIs(text, sections):
    """Why a condition does not hold, in words: ``with water.flow = 'drained'``, ``without gas.trapping``."""
    reasons = []
    for alternative in parsed(text):
        failing = next((term for term in alternative if not _holds(term, sections)), None)
        if failing is not None:
            path, value = failing[0], _valueOf(failing[0], sections)
            reasons.append(f"with {path} = {_toml(value)}" if _isSet(value) else f"without {path}")
    return " and ".join(dict.fromkeys(reasons))


def _toml(value):
    return str(value).lower() if isinstance(value, bool) else shown(value)
