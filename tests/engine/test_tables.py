# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables that people bring: all ways of writing the same numbers give the same bits; what is not plain is refused."""

import itertools
import re

import numpy as np
import pytest

from capfrac import packing
from capfrac.errors import CaseError
from capfrac.io.tables import Column, readTable

#: Three grains: x, y, r [m], as texts of as many digits as a double holds.
GRAINS = [
    ("0.001002", "0.00173751491", "0.000991938145"),
    ("3.006e-3", "1.002E-03", "9.4915397e-4"),
    ("-0.00501", "+.0447302982", "9.54173523e-004"),
]
VALUES = np.array([[float(text) for text in row] for row in GRAINS]).T


def write(path, text, encoding="utf-8"):
    path.write_bytes(text.encode(encoding))
    return path


def read(path):
    return packing.readPacking(path)


def refused(path, text, message):
    write(path, text)
    with pytest.raises(CaseError, match=f"^{re.escape(f'{path}, {message}')}$"):
        read(path)


# ---- read


SEPARATORS = {
    "comma": ",",
    "comma and blank": ", ",
    "semicolon": ";",
    "tab": "\t",
    "blank": " ",
    "blanks": "   ",
    "mixed blanks": " \t ",
}
HEADERS = {
    "plain": "{}",
    "capitals": "{}",
    "in a comment": "# {}",
    "in a bare comment": "#{}",
    "after comments and blank lines": "# made by hand\n\n{}\n\n",
}
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16")
LINE_ENDS = ("\n", "\r\n", "\r")


@pytest.mark.parametrize("separator", SEPARATORS)
@pytest.mark.parametrize("header", HEADERS)
def test_sameNumbersHoweverTheyAreWritten(tmp_path, separator, header):
    mark, line = SEPARATORS[separator], HEADERS[header]
    saved = itertools.cycle(itertools.product(ENCODINGS, LINE_ENDS))
    ways = itertools.product(("xyr", "rxy", "yrx", "ryx"), ("", " [m]", "(m)"), (False, True))
    for (order, unit, more), (encoding, end) in zip(ways, saved):
        names = [name + unit for name in (order if not more else ("id", *order, "z"))]
        if header == "capitals":
            names = [name.upper().replace("[M]", "[m]").replace("(M)", "(m)") for name in names]
        rows = [[row["xyr".index(name)] for name in order] for row in GRAINS]
        rows = [[str(number), *row, "0"] for number, row in enumerate(rows)] if more else rows
        lines = [line.format(mark.join(names)), *(mark.join(row) for row in rows), ""]
        path = write(tmp_path / "packing.csv", "\n".join(lines).replace("\n", end), encoding)
        assert np.array_equal(read(path), VALUES), path.read_bytes()


@pytest.mark.parametrize(
    "unit, shift", [("m", 0), ("dm", 1), ("cm", 2), ("mm", 3), ("um", 6), ("µm", 6), ("μm", 6), ("nm", 9)]
)
def test_unitsAreConvertedToTheLastBit(tmp_path, unit, shift):
    # The same decimal number, its point moved: 991.938145e-3 mm. Binary factors would miss the last bit of many.
    def moved(text):
        number, _, exponent = text.lower().partition("e")
        return f"{number}e{int(exponent or 0) + shift}"

    rows = "\n".join(";".join(map(moved, row)) for row in GRAINS)
    path = write(tmp_path / "packing.csv", f"x [{unit}];y ({unit});r [ {unit} ]\n{rows}")
    assert np.array_equal(read(path), VALUES)
    # Each column in a unit of its own.
    path = write(tmp_path / "packing.csv", f"x,y,r[{unit}]\n" + "\n".join(f"{x},{y},{moved(r)}" for x, y, r in GRAINS))
    assert np.array_equal(read(path), VALUES)


@pytest.mark.parametrize(
    "name, share", [("radius", 1), ("Radius [m]", 1), ("d", 2), ("D", 2), ("diameter", 2), ("Diameter (m)", 2)]
)
def test_radiusOrDiameter(tmp_path, name, share):
    rows = "\n".join(f"{x}\t{y}\t{float(r) * share!r}" for x, y, r in GRAINS)
    path = write(tmp_path / "packing.csv", f"x\ty\t{name}\n{rows}")
    assert np.array_equal(read(path), VALUES)  # twice and half are exact


@pytest.mark.parametrize("separator", [";", "\t", " ", " ; "])
def test_decimalCommas(tmp_path, separator):
    rows = "\n".join(separator.join(row).replace(".", ",") for row in GRAINS)
    assert np.array_equal(read(write(tmp_path / "packing.csv", f"x{separator}y{separator}r\n{rows}")), VALUES)


def test_whatOtherProgramsWrite(tmp_path):
    rows = "\n".join("\t".join((x, y, "0", r)) for x, y, r in GRAINS)
    # Fortran
    for text in (
        f"#format x_y_z_r\n{rows}\n",  # yade.export.text
        f"# x y z r\n{rows}\n",  # numpy.savetxt
        '"","x","y","r"\n' + "\n".join(f'"{n}","{x}",{y},{r}' for n, (x, y, r) in enumerate(GRAINS)),  # R
        ",x,y,r\n" + "\n".join(f"{n},{x},{y},{r}" for n, (x, y, r) in enumerate(GRAINS)),  # pandas
        # a spreadsheet with empty cells
        "x;y;r;\n" + "\n".join(f"{x};{y};{r};" for x, y, r in GRAINS) + "\n;;;\n;;;\n",
        "x,y,r,note\n" + "\n".join(f'{x},{y},{r},"large, round # {x}"' for x, y, r in GRAINS),
        "x y r  # in metres\n" + "\n".join(f"  {x}  {y}  {r}  # {x}" for x, y, r in GRAINS),
        "  x,  y,  r\n" + "\n".join(f"  {x},  {y},  {r.replace('e', 'D')}" for x, y, r in GRAINS),
    ):
        assert np.array_equal(read(write(tmp_path / "packing.csv", text)), VALUES), text


def test_theLastCommentThatNamesTheColumnsCounts(tmp_path):
    path = write(
        tmp_path / "packing.csv", "# r x y\n# r, x [mm], y: seen from above\n# x, y, r\n# in metres\n1,2,3\n# y, r, x\n"
    )
    assert np.array_equal(read(path), [[1], [2], [3]])


def test_rowsKnowTheirLines(tmp_path):
    path = write(tmp_path / "t.csv", "\ufeff# a\r\n\r\nx\r\n1\r\n\r\n# b\r\n2\r\n")
    table = readTable(path, (Column("x", "m"),), "the table")
    assert table.lines == (4, 7) and table.where(1) == f"{path}, line 7" and list(table.values["x"]) == [1, 2]


def test_optionalColumns(tmp_path):
    columns = Column("stress", "Pa"), Column("strain", "-", optional=True)
    assert set(readTable(write(tmp_path / "t.csv", "stress\n1\n"), columns, "the table").values) == {"stress"}
    table = readTable(write(tmp_path / "t.csv", "Strain [%],STRESS [MPa]\n1.5,0.1\n"), columns, "the table")
    assert table.values["stress"][0] == 1e5 and table.values["strain"][0] == 0.015


# ---- refused


NEEDED = (
    "needed: x [m], y [m], r [m] (or radius, d, diameter); a unit may stand behind a name: 'x [mm]', 'y [mm]', 'r [mm]'"
)
NO_HEADER = (
    "numbers, but no line before them that names the columns; needed: a first line 'x, y, r', with the units "
    "where they are not SI units: 'x [mm]', 'y [mm]', 'r [mm]'"
)
HINT = "; where commas are decimal, separate the fields by ;"
POSITIVE, FINITE = "allowed: a finite number > 0", "allowed: a finite number"
REFUSED = [
    # the header
    ("", f"line 1: columns none; {NEEDED}"),
    ("# nothing\n\n", f"line 1: columns none; {NEEDED}"),
    ("x,y\n1,2\n", f"line 1: columns 'x', 'y'; {NEEDED}"),
    ("# a\n\nx;y;rad\n1;2;3\n", f"line 3: columns 'x', 'y', 'rad'; {NEEDED}"),
    ("x_mm y_mm r_mm\n1 2 3\n", f"line 1: columns 'x_mm', 'y_mm', 'r_mm'; {NEEDED}"),
    ("1,2,3\n4,5,6\n", f"line 1: {NO_HEADER}"),
    ("# my grains\n1;2;3\n", f"line 2: {NO_HEADER}"),
    ("# x,y,r,phi\n1,2,3\n", f"line 2: {NO_HEADER}"),
    ("1,nan,3\n", f"line 1: {NO_HEADER}"),
    ("1,2,3\n# x,y,r\n", f"line 1: {NO_HEADER}"),
    ("x,y,r,r\n1,2,3,4\n", "line 1: the columns 'r' and 'r' both give r; allowed: one"),
    ("# x y r R\n1 2 3 4\n", "line 1: the columns 'r' and 'R' both give r; allowed: one"),
    ("x,y,r [m],D [mm]\n1,2,3,4\n", "line 1: the columns 'r [m]' and 'D [mm]' both give r; allowed: one"),
    ("x,y,r,x [mm]\n1,2,3,4\n", "line 1: the columns 'x' and 'x [mm]' both give x; allowed: one"),
    ("x,y,z,r,Z\n1,2,0,3,0\n", "line 1: the columns 'z' and 'Z' both give z; allowed: one"),
    ("x,y,r [inch]\n1,2,3\n", "line 1: 'r [inch]' has the unit 'inch', allowed: m, dm, cm, mm, um, µm, μm, nm"),
    ("x,y,r []\n1,2,3\n", "line 1: 'r []' has the unit '', allowed: m, dm, cm, mm, um, µm, μm, nm"),
    # fields too many, too few
    (
        "x,y,r\n1,2,3\n9,1,2,3\n",
        f"line 3: 4 fields (9 | 1 | 2 | 3), allowed: 3, one for each column of line 1 (x | y | r){HINT}",
    ),
    (
        "x,y,r\n1.0,2,3\n9.5,1,2,3\n",
        "line 3: 4 fields (9.5 | 1 | 2 | 3), allowed: 3, one for each column of line 1 (x | y | r)",
    ),
    (
        "x,y,r\n1,2,3,\n",
        f"line 2: 4 fields (1 | 2 | 3 | ), allowed: 3, one for each column of line 1 (x | y | r){HINT}",
    ),
    ("\n# a\nx y r\n1 2 3\n\n1 2\n", "line 6: 2 fields (1 | 2), allowed: 3, one for each column of line 3 (x | y | r)"),
    ("x;y;r\n1,2,3\n", "line 2: 1 field (1,2,3), allowed: 3, one for each column of line 1 (x | y | r)"),
    (
        "# x,y,z,r\n1,2,0,3\n1,2,3\n",
        "line 3: 3 fields (1 | 2 | 3), allowed: 4, one for each column of line 1 (x | y | z | r)",
    ),
    ('x,y,r\n1,"2,3\n', 'line 2: a quote does not end in: 1,"2,3'),
    # fields
    ("x,y,r\n1,2,zero\n", f"line 2: r = 'zero', {POSITIVE}"),
    ("x,y,r\n1,2,\n", f"line 2: r = '', {POSITIVE}"),
    ("x,y,Radius [mm]\n1,2,3\n1,2,0\n", f"line 3: Radius [mm] = '0', {POSITIVE}"),
    ("x,y,d\n1,2,-1\n", f"line 2: d = '-1', {POSITIVE}"),
    ("x,y,r\n1,2,nan\n", f"line 2: r = 'nan', {POSITIVE}"),
    ("x,y,r\n1,2,inf\n", f"line 2: r = 'inf', {POSITIVE}"),
    ("x,y,r\n1,2,1e-999\n", f"line 2: r = '1e-999', {POSITIVE}"),
    ("x;y;r\n1;NaN;3\n", f"line 2: y = 'NaN', {FINITE}"),
    ("x;y;r\n-Infinity;2;3\n", f"line 2: x = '-Infinity', {FINITE}"),
    ("x;y;r\n1e999;2;3\n", f"line 2: x = '1e999', {FINITE}"),
    ("x;y;r\n1e99999999999999999999;2;3\n", f"line 2: x = '1e99999999999999999999', {FINITE}"),
    ("x;y;r\n1_000;2;3\n", f"line 2: x = '1_000', {FINITE}"),
    ("x;y;r\n1 m;2;3\n", f"line 2: x = '1 m', {FINITE}"),
    ("x;y;r\n0x10;2;3\n", f"line 2: x = '0x10', {FINITE}"),
    ("x;y;r\n\u0661;2;3\n", f"line 2: x = '\u0661', {FINITE}"),
    ("x;y;r\nmm;mm;mm\n1;2;3\n", f"line 2: x = 'mm', {FINITE}"),
    ("x;y;r\n1,234,567;2;3\n", f"line 2: x = '1,234,567', {FINITE}"),
    (
        "x;y;r\n1;2;3\n1,5;2;3\n1;2.5;3\n",
        (
            "line 3: x = '1,5' has a comma, but line 4: y = '2.5' has a point; allowed: one of them, for decimals, "
            "and none for thousands"
        ),
    ),
    (
        "x,y,z,r\n1,2,0,3\n1,5,0.1,3\n",
        "line 3: z = 0.1 m, in line 2 0 m; allowed: one for all, the grains are disks in a plane",
    ),
]


@pytest.mark.parametrize("text, message", REFUSED, ids=[str(k) for k in range(len(REFUSED))])
def test_refusals(tmp_path, text, message):
    refused(tmp_path / "packing.csv", text, message)
    # In the same words where a spreadsheet has saved it.
    refused(tmp_path / "packing.csv", "\ufeff" + text.replace("\n", "\r\n"), message)


def test_noRows(tmp_path):
    path = write(tmp_path / "packing.csv", "x,y,r\n,,\n")
    message = f"{path}: the packing has no rows of numbers, needed: at least one"
    with pytest.raises(CaseError, match=f"^{re.escape(message)}$"):
        read(path)


def test_rangesNameTheUnit(tmp_path):
    column = Column("passing", "%", low=0, high=100)
    path = write(tmp_path / "t.csv", "passing [-]\n1.01\n")
    message = f"{path}, line 2: passing [-] = '1.01', allowed: a finite number >= 0 and <= 100 [%]"
    with pytest.raises(CaseError, match=re.escape(message)):
        readTable(path, (column,), "the table")
