# SPDX-License-Identifier: GPL-2.0-or-later
"""The tables that capfrac writes: CSV files in UTF-8, a header with units first.

Tables that people bring, whatever wrote them, are read by :mod:`capfrac.io.tables`.
"""

import csv

ENCODING = {"newline": "", "encoding": "utf-8"}


def writeColumns(path, columns, form=None):
    """Write equally long ``columns``, a dict of header -> values, to ``path``.

    ``form``: how floats are written (``".6g"``); None: as they are, so that they are read back as the same bits.
    """
    writeRows(path, columns, zip(*columns.values()), form)


def writeRows(path, header, rows, form=None, end="\r\n"):
    """Write a ``header`` and ``rows``, each with its values in the header's order; None is empty.

    ``form`` as in :func:`writeColumns`; ``end`` ends the lines.
    """
    with open(path, "w", **ENCODING) as stream:
        writer = csv.writer(stream, lineterminator=end)
        writer.writerow(header)
        for row in rows:
            writer.writerow([format(value, form) if form and isinstance(value, float) else value for value in row])


def readRows(path):
    """The rows of a table with a header, a list of dicts of texts; a byte order mark of a spreadsheet is passed over.

    OSError and UnicodeDecodeError go on to the caller, who knows what the file is.
    """
    with open(path, newline="", encoding="utf-8-sig") as stream:
        return list(csv.DictReader(stream))
