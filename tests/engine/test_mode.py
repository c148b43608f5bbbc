# SPDX-License-Identifier: GPL-2.0-or-later
"""The mode of an injection on samples set by hand, whose ways, throats and areas can be counted (see gaslattice.py),
and its agreement in all that a run leaves.
"""

import csv
import json
import math
from dataclasses import asdict

import numpy as np
import pytest
from gaslattice import COLUMN_VOID, COLUMNS, ROWS, grain, lattice, opened

from capfrac import mode, snapshot
from capfrac.errors import CaseError, RunFolderError
from capfrac.results.fracture import passage, throats

START = lattice()
#: A column of pores in the middle, and a broad body of gas around it.
CRACK, BODY = (5,), range(3, 8)
NO_EVENTS = {"iteration": [], "capillaryPressure [Pa]": [], "kind": []}


def entries(kinds, iteration=0):
    return {
        "iteration": [iteration] * len(kinds),
        "capillaryPressure [Pa]": [100.0 + k for k in range(len(kinds))],
        "kind": list(kinds),
    }


def modeOf(now, kinds=("rigid",) * 9, **options):
    return mode.modeOf(now, START, entries(kinds), **options)


# --- the way and the room -------------------------------------------------------------------------


def test_crackAllAlong():
    found = passage.findPassage(lattice(CRACK, opened(5, 0.1)), START)
    # from the cell on the floor to that below the roof
    assert found.through and len(found.fewestRigid.cells) == 2 * ROWS
    for way in (found.fewestRigid, found.fewestOpened):
        assert (way.opened, way.rigid, way.openedShare) == (ROWS, 0, 1.0)
    # The column is wider by 0.1 over its whole height.
    assert found.madeRoom == pytest.approx(0.1 * ROWS / (COLUMN_VOID + 0.1 * ROWS), rel=1e-12)


def test_noCrack():
    found = passage.findPassage(lattice(CRACK), START)
    assert found.through and (found.fewestRigid.opened, found.fewestRigid.rigid) == (0, ROWS) and found.madeRoom == 0


def test_halfACrack():
    found = passage.findPassage(lattice(CRACK, opened(5, 0.1, rows=ROWS // 2)), START)
    assert (found.fewestRigid.opened, found.fewestRigid.rigid) == (ROWS // 2, ROWS // 2)


def test_waysAvoidWhatTheyAreToAvoid():
    # Gas in two columns, one of them parted: one way through opened throats alone, one through rigid ones alone.
    found = passage.findPassage(lattice((4, 5), opened(5, 0.1)), START)
    assert (found.fewestRigid.opened, found.fewestRigid.rigid) == (ROWS, 0)
    assert (found.fewestOpened.opened, found.fewestOpened.rigid) == (0, ROWS)


def test_withoutBreakthroughTheWayEndsWhereGasIsFarthest():
    found = passage.findPassage(lattice(CRACK, opened(5, 0.1), upTo=6), START)
    assert not found.through and (found.fewestRigid.opened, found.fewestRigid.rigid) == (6, 0)
    # The same gas is through where the floor is an outlet.
    assert passage.findPassage(lattice(CRACK, upTo=6), START, outlet="any").through


def test_thresholdIsInMeanRadii():
    for by, count in ((0.0049, 0), (0.0051, ROWS)):  # 0.01 of the radius, 1/2
        assert passage.findPassage(lattice(CRACK, opened(5, by)), START).fewestRigid.opened == count
    assert passage.findPassage(lattice(CRACK, opened(5, 0.0051)), START, openingThreshold=0.02).fewestRigid.opened == 0


def test_gasThatLosesTheInletHasNoWay():
    now = lattice(CRACK, inlet=(0, 0))
    found = passage.findPassage(now, START)
    assert (
        not found.through
        and (found.fewestRigid.opened, found.fewestRigid.rigid) == (0, 0)
        and math.isnan(found.fewestRigid.openedShare)
    )


def test_roomDoesNotSeeWhatHappensWithinTheGas():
    rng = np.random.default_rng(1)
    for _ in range(5):
        moved = opened(5, 0.1)
        # a grain within the body of gas, with 3 radii and more
        moved[grain(5, rng.integers(1, ROWS - 1))] += rng.uniform(-3, 3, 2)
        expected = 0.1 * ROWS / (len(BODY) * COLUMN_VOID + 0.1 * ROWS)
        assert passage.madeRoom(lattice(BODY, moved), START) == pytest.approx(expected, rel=1e-12)


def test_areasOfCellsAreThoseOfTheirPolygons(square):
    shot = snapshot.takeSnapshot(square(gap=1e-4))  # triangles, trapezoids along the walls, rectangles in the corners
    areas = throats.signedAreas(shot, shot.cellVertices)
    corners = [shot.polygon(cell) for cell in range(len(areas))]
    expected = [abs(0.5 * np.sum(p[:, 0] * np.roll(p[:, 1], -1) - np.roll(p[:, 0], -1) * p[:, 1])) for p in corners]
    assert {len(p) for p in corners} == {3, 4}
    np.testing.assert_allclose(areas, expected, rtol=1e-12)
    assert areas.sum() == pytest.approx((shot.box[1] - shot.box[0]) * (shot.box[3] - shot.box[2]), rel=1e-12)


def test_thicknessCancels():
    now = lattice(CRACK, opened(5, 0.1))
    expected = passage.madeRoom(now, START)
    now.thickness, now.cellVoid = 3.0, 3 * now.cellVoid
    assert passage.madeRoom(now, START) == pytest.approx(expected, rel=1e-12)


# --- the rule -------------------------------------------------------------------------------------


def test_modesOfTheThree():
    assert modeOf(lattice(CRACK, opened(5, 0.1))).mode == "fracture"
    assert modeOf(lattice(CRACK)).mode == "capillary"
    assert modeOf(lattice(CRACK, opened(5, 0.1, rows=ROWS // 2))).mode == "mixed"


def test_throatsThatOpenAfterTheGasCount():
    # All entries were through rigid throats; the crack opened behind the gas.
    found = modeOf(lattice(CRACK, opened(5, 0.1)), kinds=["rigid"] * 24)
    assert (found.mode, found.modeByThroats) == ("fracture", "mixed")


def test_stretchingIsNoFracture():
    # Every throat is a little wider than counts as opened; but the gas stands in water's room.
    found = modeOf(lattice(CRACK, opened(5, 0.0055)))
    assert found.openedOnWay == ROWS and found.mode == "mixed" and found.madeRoom < mode.STRETCHED_ROOM


@pytest.mark.parametrize(
    "gas, moved, name",
    [(BODY, opened(5, 0), "capillary"), (CRACK, opened(5, 0.1), "fracture"), (BODY, opened(5, 0.15), "fracture")],
)
def test_oneGrainThatSlipsDoesNotTipTheMode(gas, moved, name):
    """By 0.7 radii, in any direction, in and around the gas; the older rule calls it mixed at a seventh of that."""
    for number in [grain(i, j) for i in range(2, 9) for j in range(i % 3, ROWS, 3)]:
        angle = 2.4 * number  # all directions, one after the other
        slipped = moved.copy()
        slipped[number] += 0.35 * np.array([np.cos(angle), np.sin(angle)])
        assert modeOf(lattice(gas, slipped)).mode == name, (number, angle)


@pytest.mark.parametrize("gas, moved, name", [(BODY, opened(5, 0), "capillary"), (BODY, opened(5, 0.15), "fracture")])
def test_rattlersDoNotTipTheMode(gas, moved, name):
    """Every third grain within the gas floats there, and flies about by many radii."""
    start = lattice(rattlers=[grain(i, j) for i in range(4, 8) for j in range(1, ROWS - 1) if (i + j) % 3 == 0])
    rng = np.random.default_rng(2)
    for _ in range(5):
        flown = moved.copy()
        flown[start.rattler] += rng.uniform(-4, 4, (int(start.rattler.sum()), 2))
        now = lattice(gas, flown, rattlers=np.flatnonzero(start.rattler))
        assert mode.modeOf(now, start, entries(["rigid"] * 9)).mode == name


def test_gasThatLiftsTheSedimentIsAFracture():
    # No pore was entered: all grains rose from the floor by a radius, and the gas below them with them.
    moved = np.zeros((COLUMNS * ROWS, 2))
    moved[:, 1] = 0.5
    found = mode.modeOf(lattice(range(COLUMNS - 1), moved, upTo=0), START, NO_EVENTS)
    assert (found.mode, found.modeByThroats) == ("fracture", "none") and found.medianDisplacement == 1
    assert mode.modeOf(lattice(CRACK, upTo=0), START, NO_EVENTS).mode == "none"


@pytest.mark.parametrize(
    "opened, rigid, room, moved, entered, name",
    [
        (9, 3, 0.051, 0, 9, "fracture"),
        (8, 3, 0.051, 0, 9, "mixed"),
        (9, 3, 0.05, 0, 9, "mixed"),
        (6, 6, 0.05, 0.1, 9, "capillary"),
        (7, 6, 0.05, 0.1, 9, "mixed"),
        (6, 6, 0.051, 0.1, 9, "mixed"),
        (6, 6, 0.05, 0.11, 9, "mixed"),
        (0, 9, -0.2, 0, 9, "capillary"),
        (0, 0, 0.5, 9, 9, "fracture"),
        (0, 0, 0.49, 9, 9, "mixed"),
        (0, 9, 0.5, 0, 9, "fracture"),
        (0, 9, 0.49, 0, 9, "mixed"),
        (0, 0, 0.0, 0, 9, "capillary"),
        (0, 0, 0.05, 9, 0, "none"),
        (0, 0, 0.5, 9, 0, "fracture"),
    ],
)
def test_boundsOfTheRule(opened, rigid, room, moved, entered, name):
    assert mode.classify(opened, rigid, room, moved, entered) == name


@pytest.mark.parametrize(
    "share, displacement, entered, name",
    [
        (0.5, 0, 9, "fracture"),
        (0.1, 0.1, 9, "capillary"),
        (0.11, 0, 9, "mixed"),
        (0, 0.11, 9, "mixed"),
        (0, 1, 9, "fracture"),
        (math.nan, 5, 0, "none"),
    ],
)
def test_boundsOfTheOlderRule(share, displacement, entered, name):
    assert mode.classifyByThroats(share, displacement, entered) == name


def test_badArguments():
    for arguments, message in (
        ({"outlet": "roof"}, "outlet = 'roof', allowed: 'left'"),
        ({"openingThreshold": 0}, "openingThreshold = 0, allowed: > 0"),
    ):
        with pytest.raises(CaseError, match=message):
            passage.findPassage(lattice(CRACK), START, **arguments)
    other = lattice(CRACK)
    other.ids = other.ids + 1
    with pytest.raises(CaseError, match="start holds 144 grains, allowed: a snapshot of the same 144 grains"):
        passage.findPassage(other, START)
    with pytest.raises(CaseError, match="start is missing; needed: the sample before the injection"):
        mode.measureMode(None)


# --- numbers of one state -------------------------------------------------------------------------


def test_numbersAreOfTheStateAndUntilIt():
    now = lattice(CRACK, opened(5, 0.1), iteration=50)
    events = {
        "iteration": [10, 20, 49, 50, 60],
        "capillaryPressure [Pa]": [1.0, 2.0, 3.0, 4.0, 5.0],
        "kind": ["rigid", "opened", "rigid", "opened", "opened"],
    }
    found = mode.modeOf(now, START, events, moment="breakthrough", last=lattice(BODY, iteration=80))
    assert (found.invadedThroats, found.openedThroats, found.initiationPressure, found.breakthroughPressure) == (
        3,
        1,
        2.0,
        3.0,
    )
    moved = np.hypot(*now.displacement.T) / now.r
    assert (found.largestDisplacement, found.medianDisplacement) == (0.2, float(np.median(moved)))
    assert found.gasSaturation == now.gasSaturation and found.finalSaturation == lattice(BODY).gasSaturation


@pytest.fixture
def folder(tmp_path):
    """A function (snapshots by name, events) -> run folder as of a finished run."""

    def make(shots, events=(), **parameters):
        (tmp_path / "snapshots").mkdir(exist_ok=True)
        for name, shot in shots.items():
            shot.save(tmp_path / "snapshots" / f"{name}.npz")
        (tmp_path / "events.csv").write_text(
            "time [s],iteration,capillaryPressure [Pa],x [m],y [m],kind\n"
            + "".join(f"0,{iteration},{pressure},0,0,{kind}\n" for iteration, pressure, kind in events)
        )
        whole = {"inlet": {"outlet": "top"}, "network": {"openingThreshold": 0.01}, **parameters}
        (tmp_path / "summary.json").write_text(
            json.dumps({"state": "finished", "parameters": whole, "mode": {"mode": "of old"}})
        )
        return tmp_path

    return make


def test_theRestAfterTheBreakthroughDecides(folder):
    # Gas came through rigid throats; at rest under its pressure the crack had opened; later the gas went everywhere.
    events = [(1, 100.5, "rigid"), (4, 101.5, "rigid"), (30, 105.0, "opened")]
    shots = {
        "start": START,
        "breakthrough": lattice(CRACK, iteration=5),
        "rest": lattice(CRACK, opened(5, 0.1), iteration=20),
        "end": lattice(BODY, iteration=40),
    }
    found = mode.modesOfRun(folder(shots, events))
    assert [(name, found[name].mode, found[name].moment) for name in mode.MODES] == [
        ("mode", "fracture", "rest"),
        ("modeAtBreakthrough", "capillary", "breakthrough"),
        ("modeAtEnd", "capillary", "end"),
    ]
    assert {one.modeByThroats for one in found.values()} == {"capillary"} and {
        one.breakthroughPressure for one in found.values()
    } == {101.5}
    assert [one.invadedThroats for one in found.values()] == [2, 2, 3]


def test_withoutRestTheEndDecides(folder):
    path = folder(
        {
            "start": START,
            "breakthrough": lattice(CRACK, iteration=5),
            "end": lattice(CRACK, opened(5, 0.2), iteration=9),
        },
        [(1, 99.0, "rigid")],
    )
    found = mode.modesOfRun(path)
    assert (found["mode"].mode, found["mode"].moment, found["modeAtBreakthrough"].mode) == (
        "fracture",
        "end",
        "capillary",
    )
    # A summary of an earlier version gets the modes of this one.
    assert mode.summarised(json.loads((path / "summary.json").read_text()), path) == {
        name: asdict(one) for name, one in found.items()
    }
    (path / "snapshots" / "breakthrough.npz").unlink()
    assert (
        mode.modesOfRun(path)["modeAtBreakthrough"] is None
        and mode.modesOfRun(path)["mode"].breakthroughPressure is None
    )


def test_outletAndThresholdAreThoseOfTheCase(folder):
    shots = {"start": START, "end": lattice(CRACK, opened(5, 0.0055), iteration=9)}
    path = folder(shots, inlet={"outlet": "any"}, network={"openingThreshold": 0.02})
    assert (mode.modesOfRun(path)["mode"].openedOnWay, mode.modesOfRun(path)["mode"].through) == (0, True)


def test_snapshotsOfEarlierVersionsAreRead(tmp_path):
    lattice(CRACK).save(tmp_path / "new.npz")
    with np.load(tmp_path / "new.npz") as stored:
        np.savez(tmp_path / "old.npz", **{name: stored[name] for name in stored if name != "thickness"})
    assert snapshot.load(tmp_path / "old.npz").equals(lattice(CRACK))


def test_foldersThatAreNoRuns(tmp_path, folder):
    with pytest.raises(RunFolderError, match="does not have the parameters of a run"):
        mode.modesOfRun(tmp_path)
    path = folder({"start": START})
    with pytest.raises(RunFolderError, match="has no snapshots 'start' and 'end' of a run"):
        mode.modesOfRun(path)
    assert mode.modesOfRun(path, now=lattice(CRACK))["mode"].moment == "checkpoint"


# --- runs -----------------------------------------------------------------------------------------

QUIET = {"pictures": "none", "fields": False}
#: Runs that end without a level, by coming apart; within a level, by time; and at the rest after a breakthrough.
RUNS = {
    "apart": {
        "grains": {"count": 40, "rMin": 4e-6},
        "stress": {"vertical": 2e3, "horizontal": 1e3},
        "inlet": {"pores": 2},
        "gas": {"law": "ideal"},
        "supply": {"control": "rate", "rate": 2e-6, "reservoirVolume": 1e-9},
        "ramp": {"start": 5e3, "increment": 500.0, "max": 120e3, "maxExtension": 0.1},
        "output": QUIET,
    },
    "time": {
        "grains": {"count": 60, "rMin": 1e-6},
        "stress": {"vertical": 10e3, "horizontal": 8e3},
        "inlet": {"pores": 3},
        "supply": {"maxTime": 2e-6},
        "ramp": {"start": 100e3, "increment": 1e3, "max": 215e3, "invasionInterval": 50},
        "output": QUIET,
    },
    "rest": {
        "grains": {"count": 60, "rMin": 1e-3},
        "stress": {"vertical": 10e3, "horizontal": 8e3},
        "cohesion": {"chi": 10.0},
        "inlet": {"pores": 3},
        "ramp": {"start": 120.0, "increment": 4.0, "max": 240.0, "invasionInterval": 50, "endAt": "rest"},
        "output": QUIET,
    },
}


@pytest.fixture(scope="module", params=RUNS)
def run(request, tmp_path_factory):
    """Name, run folder and summary of a run."""
    from yade import O

    from capfrac.run.injection import inject

    O.reset()
    folder = tmp_path_factory.mktemp("runs") / request.param
    return (
        request.param,
        folder,
        inject(
            {name: dict(section) for name, section in RUNS[request.param].items()}, folder, report=lambda text: None
        ),
    )


def lastRow(path):
    with open(path, newline="") as stream:
        return list(csv.DictReader(stream))[-1]


def test_allOfASummaryIsOfItsLastState(run):
    name, folder, summary = run
    last, books, mode = summary["snapshots"][-1], summary["results"]["ledger [m^3]"], summary["mode"]
    assert (
        last["name"] == "end"
        and summary["modeAtEnd"]["iteration"] == last["iteration"] == summary["results"]["iterations"]
    )
    assert (
        mode["finalSaturation"]
        == summary["modeAtEnd"]["gasSaturation"]
        == last["gasSaturation"]
        == pytest.approx(books["gas"] / books["void"], rel=1e-12)
    )
    assert mode["moment"] == {"apart": "end", "time": "end", "rest": "rest"}[name] and (name == "rest") == (
        summary["modeAtBreakthrough"] is not None
    )
    for section in (mode, summary["modeAtEnd"], summary["modeAtBreakthrough"] or mode):
        assert (
            0 <= section["medianDisplacement"] <= section["displacement90"]
            and section["medianDisplacement"] <= section["largestDisplacement"]
        )
    assert (
        summary["results"]["largestDisplacementAtEnd [r]"]
        == summary["modeAtEnd"]["largestDisplacement"]
        <= summary["results"]["displacementWithRattlersAtEnd [r]"]
    )
    if name == "apart":
        assert "came apart" in summary["ended"] and mode["mode"] == "fracture" and mode["medianDisplacement"] > 0.1


def test_logsReachToTheEnd(run):
    _, folder, summary = run
    end = summary["modeAtEnd"]
    course, level = lastRow(folder / "history.csv"), lastRow(folder / "pc_saturation.csv")
    assert (float(course["gasSaturation"]), int(course["iteration"]), int(course["brokenBonds"])) == (
        end["gasSaturation"],
        end["iteration"],
        end["brokenBonds"],
    )
    assert float(course["capillaryPressure [Pa]"]) == end["capillaryPressure"]
    if level["finished"] == "0":
        assert (float(level["gasSaturation"]), int(level["iteration"]), level["atRest"]) == (
            end["gasSaturation"],
            end["iteration"],
            "0",
        )
        assert float(level["displacementWithRattlers [r]"]) == summary["results"]["displacementWithRattlersAtEnd [r]"]


def test_folderAndTableSayTheSame(run):
    from types import SimpleNamespace

    from capfrac.sweep import table

    _, folder, summary = run
    stored = json.loads((folder / "summary.json").read_text())
    assert json.loads(json.dumps(stored)) == stored and stored["mode"] == summary["mode"]
    for name, found in mode.modesOfRun(folder).items():
        expected = found and {
            key: None if isinstance(value, float) and math.isnan(value) else value
            for key, value in asdict(found).items()
        }
        assert stored[name] == expected
    line = table.row(SimpleNamespace(name="point", values={}), {}, "finished", stored, folder)
    assert (
        line["mode"] == stored["mode"]["mode"]
        and line["medianDisplacement [r]"] == stored["mode"]["medianDisplacement"]
    )
    assert (
        line["displacement [r]"] == stored["mode"]["largestDisplacement"]
        and line["gasSaturation [-]"] == stored["snapshots"][-1]["gasSaturation"]
    )
    assert (
        line["endPressure [Pa]"] == stored["snapshots"][-1]["capillaryPressure [Pa]"]
        and line["madeRoom [-]"] == stored["mode"]["madeRoom"]
    )


def test_breakthroughIsThatOfTheStep(run):
    name, folder, summary = run
    if name != "rest":
        pytest.skip("no breakthrough")
    entry = next(entry for entry in summary["snapshots"] if entry["name"] == "breakthrough")
    log = lastRow(folder / "events.csv")
    with open(folder / "events.csv", newline="") as stream:
        before = [row for row in csv.DictReader(stream) if int(row["iteration"]) < entry["iteration"]]
    assert (
        int(before[-1]["iteration"]) == entry["iteration"] - 1
        and float(before[-1]["capillaryPressure [Pa]"]) == summary["mode"]["breakthroughPressure"]
    )
    assert (
        snapshot.load(folder / "snapshots" / "breakthrough.npz").iteration
        == entry["iteration"]
        <= int(log["iteration"]) + 1
    )
