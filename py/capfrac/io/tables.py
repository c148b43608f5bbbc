# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables that people bring: text files with numbers in columns, whatever program wrote them.

    from capfrac.tables import Column, readTable
    table = readTable("curve.csv", (Column("stress", "Pa", low=0), Column("strain", "-")), "the laboratory curve")
    table.values["stress"], table.where(0)

The names of the columns stand in the first line, or in a comment before the first numbers (``# x y r``, and the
``#format x_y_z_r`` of YADE's export); capitals, blanks and ``_`` in them do not count. A unit may stand behind a name,
``r [mm]`` or ``r (mm)``, and is converted; without one a column is in SI units. Columns may come in any order, with
others among them. Fields are separated by ``;``, tabs, commas or blanks, and may be quoted. Blank lines and what
follows ``#`` are passed over. Text is UTF-8, with or without a byte order mark, or UTF-16 with one, with the line ends
of any system. Decimal commas are read where fields are not separated by commas and no number of the file has a point.

What is not plain is refused and never guessed: a row with more or fewer fields than the header, a column given twice, a
name or unit that is missing or unknown, a field that is no finite number or out of range. Every message names the file,
the line in it (as an editor counts) and the column.
"""

import math
import re
from dataclasses import dataclass
from decimal import Decimal, DecimalException
from pathlib import Path

import numpy as np

from capfrac.errors import CaseError
from capfrac.io.tableheader import Column, readHeader, split

__all__ = ["Column", "Table", "readTable"]

_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eEdD][+-]?[0-9]+)?")
#: A line up to the comment in it: # behind a blank, outside of quotes.
_BEFORE_COMMENT = re.compile(r'(?:"[^"]*"|[^"#]|(?<=\S)#|"(?![^"]*"))*')


@dataclass(frozen=True)
class Table:
    """A table that was read."""

    path: Path
    values: dict  #: name of each column that is there -> its numbers in SI units (array)
    lines: tuple  #: where each row stands in the file, counted from 1

    def where(self, row):
        """File and line of a row (rows count from 0), for messages."""
        return f"{self.path}, line {self.lines[row]}"


def readTable(path, columns, what):
    """Read ``columns`` (of :class:`Column`) from the file at ``path``; returns a :class:`Table` with at least one row.

    ``what`` says in messages what the file is: "the packing". Raises :class:`CaseError` as in the module's text.
    """
    comments, rows = _sorted(_text(path, what))
    header, rows = readHeader(path, columns, comments, rows)
    found = header.find(path, columns)
    if not rows:
        raise CaseError(f"{path}: {what} has no rows of numbers, needed: at least one")
    fields = [_fields(path, line, text, header) for line, text in rows]
    lines = tuple(line for line, _ in rows)
    commas = _decimalCommas(path, lines, fields, found)
    values = {
        one.column.name: np.array([_value(path, line, one, row[one.place], commas) for line, row in zip(lines, fields)])
        for one in found
    }
    return Table(Path(path), values, lines)


def _text(path, what):
    """The file's text. A byte order mark tells UTF-16 from UTF-8, and is not part of it."""
    try:
        content = Path(path).read_bytes()
    except OSError as problem:
        raise CaseError(f"{what} {path} cannot be read: {problem.strerror}") from None
    try:
        return content.decode("utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except UnicodeDecodeError:
        raise CaseError(f"{what} {path} is not a text in UTF-8") from None


def _sorted(text):
    """Comments and rows: two lists of (line, text). Spreadsheets write separators alone for an empty row."""
    comments, rows = [], []
    for number, line in enumerate(re.split("\r\n|\r|\n", text), start=1):
        start = line.lstrip()
        if start.startswith("#"):
            comments.append((number, start.lstrip("#").strip(" ")))
        elif start.strip(";,\t "):
            rows.append((number, _BEFORE_COMMENT.match(line)[0].strip(" ")))
    return comments, rows


def _fields(path, line, text, header):
    """The fields of a row, as many as the header has: else it cannot be known which is which."""
    fields = split(text, header.separator)
    if fields is None:
        raise CaseError(f"{path}, line {line}: a quote does not end in: {text}")
    if len(fields) == len(header.names):
        return fields
    surplus = header.separator == "," and len(fields) > len(header.names) and "." not in text
    hint = "; where commas are decimal, separate the fields by ;" if surplus else ""
    raise CaseError(
        f"{path}, line {line}: {len(fields)} field{'s' * (len(fields) > 1)} ({_few(fields)}), allowed: "
        f"{len(header.names)}, one for each column of line {header.line} ({_few(header.names)}){hint}"
    )


def _few(fields):
    return " | ".join(fields[:8] + ["..."] * (len(fields) > 8))


def _decimalCommas(path, lines, fields, found):
    """Whether the numbers have decimal commas. Where there are points, too, either may be for thousands: refused."""
    first = {}
    for line, row in zip(lines, fields):
        for one in found:
            for mark in ",.":
                if mark in row[one.place]:
                    first.setdefault(mark, f"line {line}: {one.written} = '{row[one.place]}'")
    if len(first) == 2:
        raise CaseError(
            f"{path}, {first[',']} has a comma, but {first['.']} has a point; allowed: one of them, for "
            "decimals, and none for thousands"
        )
    return "," in first


def _value(path, line, one, text, commas):
    """A field as a number in the column's unit. Decimal until then: 0.94 mm and 0.00094 m are the same bits."""
    column, value = one.column, math.nan
    plain = text.replace(",", ".") if commas else text
    if _NUMBER.fullmatch(plain):
        try:
            value = float(Decimal(re.sub("[dD]", "e", plain)) * one.factor)
        except DecimalException:  # an exponent beyond all numbers
            pass
    good = math.isfinite(value)
    good = good and (column.low is None or value > column.low or (value == column.low and not column.openLow))
    if not good or (column.high is not None and value > column.high):
        raise CaseError(f"{path}, line {line}: {one.written} = '{text}', allowed: {column.allowed()}")
    return value
