# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of sweeps and what is made from them: r*, second opinions, figures. The tables here are written by hand."""

import csv
import math

import pytest

from capfrac import depth
from capfrac.errors import CaseError
from capfrac.sweep import depth_figures, figures, regime_map, table

GAMMA = 0.05


def mapRow(r, stress, chi, seed, mode, displacement, median, through=True):
    return {
        "point": f"{r}-{stress}-{chi}-{seed}",
        "state": "finished",
        "stress.horizontal [Pa]": stress,
        "grains.rMin [m]": r / 1.5,
        "cohesion.chi [-]": chi,
        "grains.seed [-]": seed,
        "rMean [m]": r,
        "stressNumber [-]": stress * r / GAMMA,
        "mode": mode,
        "ended": "",
        "breakthroughPressure [Pa]": 4.65 * GAMMA / r if through else None,
        "endPressure [Pa]": 2 * stress,
        "openedShare [-]": 0.5,
        "displacement [r]": displacement,
        "medianDisplacement [r]": median,
        "inletWidth [m]": 10 * r,
    }


@pytest.fixture
def mapTable(tmp_path):
    """Modes that change at sigma'_H r/gamma = 3 in all samples; one run failed, one lifted the sediment from
    the inlet.
    """
    rows = []
    for stress in (8e3, 80e3, 800e3):
        for number in (0.1, 1.0, 9.0, 90.0):
            for seed in (1, 2):
                fine = number < 3
                mode = "none" if number == 0.1 else "fracture" if fine else "capillary"
                rows.append(
                    mapRow(
                        number * GAMMA / stress,
                        stress,
                        0.0,
                        seed,
                        mode,
                        9.0 if fine else 0.01,
                        3.0 if fine else 0.001,
                        not fine,
                    )
                )
    rows.append({**rows[0], "state": "failed", "mode": ""})
    table.write(tmp_path / "table.csv", rows)
    return tmp_path / "table.csv"


def test_radiusOfTheChangeFromATable(mapTable):
    rows = regime_map.read(mapTable)
    assert len(rows) == 24  # the one that failed is not among them
    found = regime_map.changes(rows)
    # Between 1 and 9 the middle (in logarithms) is 3; displacements fall from 3 to 0.001 there, through 0.5. Six digits
    # in the table, places to a thousandth of a decade.
    displaced = 9 ** (math.log(3 / 0.5) / math.log(3 / 0.001))
    for entry in found:
        assert entry["change"].radius == pytest.approx(3 * GAMMA / entry["stressH"], rel=1e-5)
        assert entry["gaveWay"] == pytest.approx(displaced * GAMMA / entry["stressH"], rel=3e-3)
        assert entry["theory"] == pytest.approx(4.65 * GAMMA / entry["stressH"], rel=1e-5) and entry[
            "aOverR"
        ] == pytest.approx(5, rel=1e-5)
    laws = regime_map.laws(found)[0.0]
    assert laws["change"].exponent == pytest.approx(-1, abs=1e-5) and laws["gaveWay"].exponent == pytest.approx(
        -1, abs=2e-3
    )
    together = regime_map.numbers(rows)[0.0]
    assert together["change"].radius == pytest.approx(3, rel=1e-5) and together["gaveWay"] == pytest.approx(
        displaced, rel=3e-3
    )


def test_gasThatLiftsTheSedimentFractures():
    assert regime_map.mapMode({"mode": "none", "displacement [r]": 5.0}) == "fracture"
    assert regime_map.mapMode({"mode": "none", "displacement [r]": 0.2}) == "none"
    assert regime_map.mapMode({"mode": "capillary", "displacement [r]": 0.2}) == "capillary"


def test_pressureIsThatAtTheEndWhereGasDidNotComeThrough(mapTable):
    for row in regime_map.read(mapTable):
        assert row["pressure"] == pytest.approx(
            4.65 * GAMMA / row["rMean [m]"] if row["stressNumber [-]"] > 3 else 2 * row["stress.horizontal [Pa]"],
            rel=1e-5,
        )


def test_figuresOfTheMapAreTheSameBytes(mapTable, tmp_path):
    first, second = (figures.draw("regime_map", mapTable, tmp_path / name) for name in ("one", "two"))
    assert [path.name for path in first] == ["regime_map.png", "regime_collapse.png", "critical_radius.csv"]
    for a, b in zip(first, second):
        assert a.read_bytes() == b.read_bytes()
    with open(first[2], newline="") as stream:
        lines = list(csv.DictReader(stream))
    assert [float(line["stress.horizontal [Pa]"]) for line in lines] == [8e3, 8e4, 8e5] and float(
        lines[0]["exponent [-]"]
    ) == pytest.approx(-1, abs=1e-4)


def depthRow(z, k0, through, mode):
    return {
        "point": f"{z}-{k0}",
        "state": "finished",
        "depth [m]": z,
        "k0 [-]": k0,
        "gas.interfacialTension [N/m]": 0.05,
        "throat [m]": 0.176e-6,
        "stress.horizontal [Pa]": k0 * float(depth.verticalStress(z)),
        "mode": mode,
        "displacement [r]": 3.0,
        "medianDisplacement [r]": 1.0,
        "breakthroughPressure [Pa]": through,
        "endPressure [Pa]": 3e5,
        "openedShare [-]": 0.5,
    }


def test_depths(tmp_path):
    table.write(
        tmp_path / "table.csv",
        [
            depthRow(30.0, 0.667, 2e5, "fracture"),
            depthRow(30.0, 0.5, None, "none"),
            depthRow(126.61, 0.667, 5.6e5, "mixed"),
        ],
    )
    rows = depth_figures.read(tmp_path / "table.csv")
    assert [row["best"] for row in rows] == [True, False, True] and [row["mapMode"] for row in rows] == [
        "fracture",
        "fracture",
        "mixed",
    ]
    assert [row["pressure"] for row in rows] == [2e5, 3e5, 5.6e5]
    assert rows[0]["column"] == pytest.approx(float(depth.gasColumn(2e5, 30.0)), rel=1e-12)
    drawn = figures.draw("hydrate_ridge_depth", tmp_path / "table.csv", tmp_path / "figures")
    with open(drawn[1], newline="") as stream:
        lines = list(csv.DictReader(stream))
    assert [float(line["depth [m]"]) for line in lines] == [30, 126.61] and [line["runs [-]"] for line in lines] == [
        "1",
        "1",
    ]
    assert lines[0]["modesElsewhereInTheRanges"] == "1 fracture" and float(lines[1]["runPressureLow [Pa]"]) == 5.6e5
    assert drawn[0].stat().st_size > 30_000


def test_whatIsNoTableIsRefused(tmp_path):
    with pytest.raises(CaseError, match="cannot be read"):
        table.read(tmp_path / "none.csv")
    (tmp_path / "other.csv").write_text("a,b\n1,2\n")
    with pytest.raises(
        CaseError, match="is not the table of a sweep, or holds no points: the column 'point' is missing"
    ):
        table.read(tmp_path / "other.csv")
    (tmp_path / "short.csv").write_text("point,state\np,finished\n")
    with pytest.raises(CaseError, match=r"the column 'stress.horizontal \[Pa\]' is missing"):
        regime_map.read(tmp_path / "short.csv")


def test_numbersOfATableAreRead(tmp_path):
    table.write(
        tmp_path / "t.csv",
        [{"point": "a", "state": "finished", "x [m]": 1.5e-7, "y [Pa]": None, "mode": "mixed", "capfrac": "0.1.0"}],
    )
    (row,) = table.read(tmp_path / "t.csv")
    assert row["x [m]"] == 1.5e-7 and math.isnan(row["y [Pa]"]) and (row["mode"], row["capfrac"]) == ("mixed", "0.1.0")
    (tmp_path / "t.csv").write_bytes(b"\xef\xbb\xbf" + (tmp_path / "t.csv").read_bytes())  # a spreadsheet has saved it
    assert table.read(tmp_path / "t.csv")[0]["point"] == "a"
