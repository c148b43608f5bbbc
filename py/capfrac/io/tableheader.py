# SPDX-License-Identifier: GPL-2.0-or-later
"""The header of a table that people bring: which columns it names, in which units (see :mod:`capfrac.io.tables`)."""

import csv
import re
from dataclasses import dataclass, field
from decimal import Decimal

from capfrac.errors import CaseError
from capfrac.units import UNITS, USUAL

#: Between fields, in the order in which they are tried; None: blanks.
_SEPARATORS = (";", "\t", ",", None)
_NUMBERS = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([ed][+-]?[0-9]+)?|[+-]?(nan|inf|infinity)", re.IGNORECASE)
_WITH_UNIT = re.compile(r"(.*?)\s*(?:\[(.*)\]|\((.*)\))")
#: A field where blanks separate them; a unit behind a name belongs to it.
_WORD = re.compile(r"\"[^\"]*\"|[^\s\[\]()\"]+(?:\s*(?:\[[^\]]*\]|\([^)]*\)))?|\S+")


@dataclass(frozen=True)
class Column:
    """A column that is looked for."""

    name: str
    unit: str  #: SI unit of the values, a key of :data:`UNITS`
    others: dict = field(default_factory=dict)  #: other names -> factor (text) that makes this column of what they hold
    low: float | None = None  #: lowest value, in ``unit``
    openLow: bool = False  #: whether the lowest value itself is excluded
    high: float | None = None  #: highest value, in ``unit``
    optional: bool = False  #: whether the table may do without

    def allowed(self):
        """What a field may hold, in words."""
        text = "a finite number"
        if self.low is not None:
            text += f" {'>' if self.openLow else '>='} {self.low:g}"
        if self.high is not None:
            text += f"{' and' if self.low is not None else ''} <= {self.high:g} [{self.unit}]"
        return text

    def keys(self):
        """Its names as they are compared -> factor."""
        return {compared(name): factor for name, factor in {self.name: "1", **self.others}.items()}


@dataclass(frozen=True)
class Header:
    """The header that a file has."""

    line: int  #: where it stands, counted from 1
    names: list  #: the fields of the header as they are written
    separator: str | None  #: between the fields of the rows; None: blanks

    def find(self, path, columns):
        """The columns that are there: a list of :class:`Found`.

        Raises :class:`CaseError` for one that is missing, given twice, or in an unknown unit.
        """
        found = []
        for column in columns:
            keys = column.keys()
            places = [place for place, name in enumerate(self.names) if _parts(name)[0] in keys]
            if len(places) > 1:
                twice = " and ".join(f"'{self.names[place]}'" for place in places)
                raise CaseError(f"{path}, line {self.line}: the columns {twice} both give {column.name}; allowed: one")
            if not places and not column.optional:
                named = ", ".join(f"'{name}'" for name in self.names) if any(self.names) else "none"
                raise CaseError(
                    f"{path}, line {self.line}: columns {named}; needed: {_described(columns)}; "
                    f"a unit may stand behind a name: {_example(columns)}"
                )
            for place in places:
                name = self.names[place]
                found.append(Found(column, place, name, self._factor(path, column, name)))
        return found

    def _factor(self, path, column, name):
        key, unit = _parts(name)
        known = UNITS[column.unit]
        if unit is not None and unit not in known:
            raise CaseError(f"{path}, line {self.line}: '{name}' has the unit '{unit}', allowed: {', '.join(known)}")
        return Decimal(column.keys()[key]) * Decimal(known[column.unit if unit is None else unit])


@dataclass(frozen=True)
class Found:
    """A column that a file has."""

    column: Column
    place: int  #: among the fields
    written: str  #: as the header calls it
    factor: Decimal  #: what its numbers are multiplied with


def readHeader(path, columns, comments, rows):
    """The :class:`Header` and the rows that are left; ``comments`` and ``rows``: lists of (line, text).

    It is the first row, or, where that holds numbers alone, the last comment before it that names the columns, as many
    as the row has fields. Raises :class:`CaseError` where there is none: which number is a radius is not to be guessed.
    """
    line, text = rows[0] if rows else (1, "")
    if not rows or not _isNumbers(text):
        separator = _separatorOf(text)
        separator, names = _coveringSplit(text, columns) or (separator, split(text, separator) or [text])
        return Header(line, names, separator), rows[1:]
    separator = _separatorOf(text)
    for number, comment in reversed([entry for entry in comments if entry[0] < line]):
        if comment.startswith("format "):  # of YADE's export: x_y_z_r
            comment = comment.removeprefix("format ").strip().replace("_", " ")
        found = _coveringSplit(comment, columns)
        if found and len(found[1]) == len(split(text, separator) or ()):
            return Header(number, found[1], separator), rows
    names = ", ".join(column.name for column in columns if not column.optional)
    raise CaseError(
        f"{path}, line {line}: numbers, but no line before them that names the columns; needed: a first "
        f"line '{names}', with the units where they are not SI units: {_example(columns)}"
    )


def split(text, separator):
    """The fields of a line; None where a quote in it does not end."""
    if separator is None:
        return [word.strip('"') for word in _WORD.findall(text)]
    try:
        fields = next(csv.reader([text], delimiter=separator, skipinitialspace=True, strict=True))
    except csv.Error:
        return None
    return [entry.strip() for entry in fields]


def compared(name):
    """A name as it is compared: without blanks and ``_``, in small letters."""
    return re.sub(r"[\s_]", "", name).casefold()


def _isNumbers(text):
    """Whether a line holds nothing but numbers, however they are separated."""
    return all(_NUMBERS.fullmatch(word) for word in re.split(r"[;,\s]+", text.replace('"', "").strip(";, \t")))


def _separatorOf(text):
    return next(separator for separator in _SEPARATORS if separator is None or separator in text)


def _coveringSplit(text, columns):
    """The separator, and the fields that it makes, with which all columns that are needed are there, or None."""
    for separator in _SEPARATORS:
        names = split(text, separator) if separator is None or separator in text else None
        keys = {_parts(name)[0] for name in names or ()}
        if names and all(column.optional or keys & set(column.keys()) for column in columns):
            return separator, names
    return None


def _parts(text):
    """A field of a header: its name as it is compared, and its unit (None without one)."""
    match = _WITH_UNIT.fullmatch(text.strip())
    if not match:
        return compared(text), None
    return compared(match[1]), (match[3] if match[2] is None else match[2]).strip()


def _described(columns):
    return ", ".join(
        f"{column.name} [{column.unit}]" + (f" (or {', '.join(column.others)})" if column.others else "")
        for column in columns
        if not column.optional
    )


def _example(columns):
    return ", ".join(f"'{column.name} [{USUAL[column.unit]}]'" for column in columns if not column.optional)
