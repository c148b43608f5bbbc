# SPDX-License-Identifier: GPL-2.0-or-later
"""A packing that contradicts its case is refused, with what was meant; what is only odd is told and kept."""

import re

import numpy as np
import pytest

from capfrac import injection, packing
from capfrac.case import packing as casepacking, resolveCase
from capfrac.errors import CaseError
from capfrac.sweep import readSweep
from processes import run

BASE = """
[grains]
packing = "p.csv"
rMin = 0.95e-3
[stress]
vertical = 1e4
horizontal = 1e4
[inlet]
pores = 1
[ramp]
start = 50
increment = 10
max = 400
"""


def write(path, scale=1.0, header="x,y,r", radius=1e-3, places=1.0):
    """23 grains on a lattice, radii 0.95 to 0.99 ``radius``, numbers times ``scale``, x and y times ``places`` more."""
    x, y, r = packing.hexagonal(20, radius)
    r = r * np.linspace(0.95, 0.99, len(r))
    path.write_text(
        header
        + "\n"
        + "".join(
            f"{a * places * scale!r},{b * places * scale!r},{c * scale!r}\n"
            for a, b, c in zip(x.tolist(), y.tolist(), r.tolist())
        )
    )
    return path


def caseOf(path, **grains):
    return resolveCase(
        {
            "grains": {"packing": str(path), **grains},
            "stress": {"vertical": 10e3, "horizontal": 10e3},
            "inlet": {"pores": 1},
            "ramp": {"start": 50, "increment": 10, "max": 400},
        }
    )


def told(path, **grains):
    return casepacking.checkPacking(caseOf(path, **grains))


@pytest.mark.parametrize("rMin", [0.95e-3, 0.94e-3, 1e-3, 0.9e-3])
def test_roundedRadiiAgree(tmp_path, rMin):
    assert told(write(tmp_path / "p.csv"), rMin=rMin) == []


@pytest.mark.parametrize("scale, unit", [(1e3, "mm"), (1e2, "cm"), (1e6, "um"), (1e9, "nm")])
def test_forgottenUnits(tmp_path, scale, unit):
    path = write(tmp_path / "p.csv", scale)
    message = (
        f"grains.rMin = 0.00094 m, but the smallest radius in {path} (line 2) is {0.95e-3 * scale:g} m, "
        f"{0.95 / 0.94 * scale:.4g} times that; allowed: about the same, or no grains.rMin; are the numbers of "
        f"the file in {unit}? Then name its columns x [{unit}], y [{unit}], r [{unit}]"
    )
    with pytest.raises(CaseError, match=f"^{re.escape(message)}$"):
        told(path, rMin=0.94e-3)
    # What the message says is the cure.
    path = write(tmp_path / "p.csv", scale, f"x [{unit}],y [{unit}],r [{unit}]")
    assert told(path, rMin=0.94e-3) == []


@pytest.mark.parametrize("rMin, unit", [(0.94, "mm"), (940, "um"), (0.094, "cm")])
def test_unitsForgottenInTheCase(tmp_path, rMin, unit):
    message = f"times that; allowed: about the same, or no grains.rMin; is that of the case in {unit}? Its unit is m"
    with pytest.raises(CaseError, match=re.escape(message)):
        told(write(tmp_path / "p.csv"), rMin=rMin)


def test_largestRadius(tmp_path):
    path = write(tmp_path / "p.csv")
    assert told(path, rMin=0.95e-3, rMax=1e-3) == []
    assert told(path, rMin=0.95e-3) == []  # rMax is 2 rMin then, which says nothing of the file
    message = "grains.rMax = 0.004 m, but the largest radius in .*p.csv .* is 0.00099 m, 0.2475 times that"
    with pytest.raises(CaseError, match=message):
        told(path, rMin=0.95e-3, rMax=4e-3)


def test_otherSizesAreTold(tmp_path):
    path = write(tmp_path / "p.csv", 2)
    (text,) = told(path, rMin=0.95e-3)
    assert (
        text == f"grains.rMin = 0.00095 m, but the smallest radius in {path} (line 2) is 0.0019 m; the file "
        "counts; are these diameters? Then call the column d"
    )
    (text,) = told(write(tmp_path / "p.csv", 1.5), rMin=0.95e-3)
    assert text.endswith("is 0.001425 m; the file counts")


def test_count(tmp_path):
    path = write(tmp_path / "p.csv")
    number = len(path.read_text().splitlines()) - 1
    assert told(path, rMin=1e-3, count=number) == []
    message = f"grains.count = 60, but .*p.csv holds {number} grains; allowed: their number, or no grains.count"
    with pytest.raises(CaseError, match=message):
        told(path, rMin=1e-3, count=60)


def test_boulders(tmp_path):
    (text,) = told(write(tmp_path / "p.csv", 1e3), rMin=0.95)
    assert text.endswith(
        ": r = 0.99 m, a boulder; are the numbers of the file in mm or um? Then write the unit behind "
        "the names of its columns, r [mm]"
    )


@pytest.mark.parametrize("places", [1e2, 1e3, 1e6])
def test_placesInAnotherUnitThanRadii(tmp_path, places):
    message = "p.csv: the grains fill .* of the box around them, allowed: at least 0.01; are x and y in another unit"
    with pytest.raises(CaseError, match=message):
        told(write(tmp_path / "p.csv", places=places), rMin=1e-3)
    message = "p.csv, lines 2 and 3: the grains overlap by .* m, allowed: up to half of the smaller radius"
    with pytest.raises(CaseError, match=message):
        told(write(tmp_path / "p.csv", places=1 / places), rMin=1e-3)


def test_grainAstray(tmp_path):
    path = write(tmp_path / "p.csv")
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:5], "9,0.005,0.001", *lines[5:]]))
    with pytest.raises(CaseError, match="Farthest out is that of line 6: x = 9 m, y = 0.005 m, r = 0.001 m"):
        told(path, rMin=1e-3)


def test_radiiTooFarApart(tmp_path):
    path = write(tmp_path / "p.csv")
    path.write_text(path.read_text() + "0.05,0.05,0.0105\n")
    message = r"p.csv, line \d+: r = 0.0105 m, 11.1 times that of line 2, 0.00095 m; allowed: up to 10 times"
    with pytest.raises(CaseError, match=message):
        told(path, rMin=1e-3)


def test_nothingIsLeftOfWhatIsRefused(command, tmp_path):
    write(tmp_path / "p.csv", 1e3)
    (tmp_path / "case.toml").write_text(BASE)
    status, output, errors = run(command, "inject", tmp_path / "case.toml", "-o", tmp_path / "run")
    assert status == 1 and output == "" and "are the numbers of the file in mm?" in errors
    assert not (tmp_path / "run").exists()


def test_warningsAreKeptAndPrinted(command, tmp_path):
    case = caseOf(write(tmp_path / "p.csv", 1.5), rMin=0.95e-3)
    case["ramp"]["endAt"] = "breakthrough"
    case["output"].update(pictures="none", fields=False)
    lines = []
    summary = injection.inject(case, tmp_path / "run", report=lines.append)
    (text,) = summary["warnings"]
    assert "the file counts" in text and f"warning: {text}" in lines


def test_seedWithAPackingIsNoOtherSample(command, tmp_path):
    write(tmp_path / "p.csv")
    case = caseOf(tmp_path / "p.csv", seed=7)
    assert case["grains"]["seed"] == 1 and any("grains.seed = 7" in text for text in case["case"]["warnings"])
    # Two seeds of one packing would stand in a table as two samples.
    (tmp_path / "base.toml").write_text(BASE)
    (tmp_path / "many.toml").write_text('[sweep]\ncase = "base.toml"\n[[grid]]\ngrains.seed = [1, 2, 3]\n')
    status, output, errors = run(command, "sweep", tmp_path / "many.toml", "-o", tmp_path / "sweep")
    assert status == 1 and output == "" and not (tmp_path / "sweep").exists()
    assert "the points seed1 and seed2 would be the same run: grains.seed has no effect in them; leave one" in errors
    # Without the packing they are samples.
    drawn = '[sweep]\ncase = "base.toml"\n[set]\ngrains.packing = ""\n[[grid]]\ngrains.seed = [1, 2]\n'
    (tmp_path / "many.toml").write_text(drawn)
    assert len(readSweep(tmp_path / "many.toml").points) == 2


def test_packingWithoutRadiiInTheCase(tmp_path):
    path = write(tmp_path / "p.csv")
    case = resolveCase(
        {
            "grains": {"packing": str(path)},
            "stress": {"vertical": 10e3, "horizontal": 10e3},
            "inlet": {"pores": 1},
            "ramp": {"start": 50, "increment": 10, "max": 400},
        }
    )
    assert casepacking.checkPacking(case) == []
    write(path, 1e3)  # nothing to compare with, but grains of a metre
    (text,) = casepacking.checkPacking(case)
    assert "a boulder; are the numbers of the file in mm or um?" in text
