# SPDX-License-Identifier: GPL-2.0-or-later
"""The kept references: written by ``capfrac python tests/reference/references.py [CASE ...]``, read by the tests.

One folder a case in ``data``, one CSV a table, numbers in 17 digits, which give back every bit. They are
what the program gave at the time; a change of the physics changes them, and says why; a change of the code does not.
"""

import csv
import sys
from pathlib import Path

import numpy as np

DATA = Path(__file__).parent / "data"


def write(case, tables):
    """Keep the tables of a case; tables without rows are kept as their header."""
    folder = DATA / case
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.csv"):
        old.unlink()
    for name, table in tables.items():
        with open(folder / f"{name}.csv", "w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(table)
            writer.writerows([f"{number:.17g}" for number in row] for row in zip(*table.values()))


def read(case):
    """The tables of a case as ``cases.finite`` gives them."""
    tables = {}
    for path in sorted((DATA / case).glob("*.csv")):
        with open(path, newline="", encoding="utf-8") as stream:
            header, *rows = csv.reader(stream)
        columns = np.array(rows, dtype=float).reshape(len(rows), len(header)).T
        tables[path.stem] = dict(zip(header, columns))
    return tables


def main():
    sys.path.insert(0, str(Path(__file__).parents[1]))
    from settled import O, buildSettled

    from cases import MOVING, STILL

    def build(rMin):
        O.reset()
        buildSettled(rMin)

    for name, run in {**STILL, **MOVING}.items():
        if not sys.argv[1:] or name in sys.argv[1:]:
            tables = run(build)
            write(name, tables)
            print(name, {table: len(next(iter(columns.values()), ())) for table, columns in tables.items()}, flush=True)


if __name__ == "__main__":
    main()
