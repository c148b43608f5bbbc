# SPDX-License-Identifier: GPL-2.0-or-later
"""What is odd but possible is told as a run begins, printed with its result, and kept in summary and table."""

import csv
import json

import pytest

from capfrac import injection
from capfrac.case import resolveCase
from capfrac.run.folder import RunFolder
from capfrac.sweep import readSweep, runSweep
from processes import run, writePacking

CASE = """
[grains]
packing = "p.csv"
rMin = 1e-3
[stress]
vertical = 10e3
horizontal = 10e3
[inlet]
pores = 1
[ramp]
start = {start}
increment = 10
max = 400
endAt = "breakthrough"
[output]
pictures = "none"
fields = false
"""
#: Gas passes disks that touch at 4.83 gamma / r, 244 Pa for r = 0.99 mm, and a little more where they overlap (0.2 %).
BELOW, ABOVE = 50, 300


@pytest.fixture
def caseOf(tmp_path):
    """A function (start, section={key: value}) -> resolved case of a small lattice."""
    writePacking(tmp_path / "p.csv")

    def make(start=BELOW, **sections):
        raw = {
            "grains": {"packing": str(tmp_path / "p.csv"), "rMin": 1e-3},
            "stress": {"vertical": 10e3, "horizontal": 10e3},
            "inlet": {"pores": 1},
            "ramp": {"start": start, "increment": 10, "max": 400, "endAt": "breakthrough"},
            "output": {"pictures": "none", "fields": False},
        }
        for section, entries in sections.items():
            raw.setdefault(section, {}).update(entries)
        return resolveCase(raw)

    return make


def warningsOf(case, folder):
    lines = []
    summary = injection.inject(case, folder, report=lines.append)
    return summary, [line for line in lines if line.startswith("warning: ")]


def test_nothingIsToldOfAnOrdinaryRun(caseOf, tmp_path):
    summary, told = warningsOf(caseOf(), tmp_path / "run")
    assert summary["warnings"] == told == [] and summary["results"]["upperBounds"] == []


def test_throughAtTheStartOfTheRamp(caseOf, tmp_path):
    summary, _ = warningsOf(caseOf(ABOVE, ramp={"endAt": "max", "max": ABOVE + 10}), tmp_path / "run")
    assert summary["mode"]["breakthroughPressure"] == ABOVE
    names = summary["results"]["upperBounds"]
    # The levels of saturation, too: gas is everywhere at the end of the first level.
    assert names == ["breakthroughPressure", *summary["results"]["saturation"]]
    (text,) = summary["warnings"]
    assert (
        text == f"reached at ramp.start = 300 Pa already, so upper bounds: {', '.join(names)}; "
        "begin the ramp lower to find them"
    )


@pytest.mark.parametrize("pressure, above", [(None, False), (50.0, True), (50.000001, False), (20.0, True)])
def test_anyPressureOfTheStart(caseOf, tmp_path, pressure, above):
    case = caseOf()
    run = injection.Run(case, RunFolder(tmp_path / "run", case), report=None)
    found = run.upperBounds({"initiationPressure": pressure, "breakthroughPressure": 60.0})
    assert found == ["initiationPressure"] * above and len(run.folder.summary.get("warnings", [])) == above


def test_printedWithTheResultAndAgain(command, tmp_path):
    writePacking(tmp_path / "p.csv")
    (tmp_path / "case.toml").write_text(CASE.format(start=ABOVE))
    for quiet in ([], ["-q"]):  # the second time the run is there already
        status, output, _ = run(command, "inject", tmp_path / "case.toml", "-o", tmp_path / "run", *quiet)
        assert status == 0 and "  breakthroughPressure: 300 or lower\n" in output
        assert "\nwarning: reached at ramp.start = 300 Pa already" in output


def test_toldInASweep(command, tmp_path):
    writePacking(tmp_path / "p.csv")
    (tmp_path / "base.toml").write_text(CASE.format(start=ABOVE))
    (tmp_path / "many.toml").write_text(f'[sweep]\ncase = "base.toml"\n[[grid]]\nramp.start = [{BELOW}, {ABOVE}]\n')
    told = []
    runSweep(readSweep(tmp_path / "many.toml"), tmp_path / "sweep", report=told.append)
    assert " Pa, " in told[1] and " Pa or below, " in told[2]
    with open(tmp_path / "sweep" / "table.csv", newline="") as stream:
        low, high = csv.DictReader(stream)
    assert low["upperBounds"] == low["warnings"] == ""
    assert high["upperBounds"] == "breakthroughPressure"
    assert high["warnings"].startswith("reached at ramp.start")


def test_inletThatTouchesTheOutlet(caseOf, tmp_path):
    # A pore in a corner of the box, with a wall on either side.
    case = caseOf(inlet={"pores": 0, "points": [[1e-4, 1e-4]], "outlet": "left"})
    summary, told = warningsOf(case, tmp_path / "run")
    assert summary["mode"]["breakthroughPressure"] == BELOW and summary["mode"]["invadedThroats"] == 0
    assert summary["warnings"][0].startswith("a pore of the inlet touches the outlet before any gas moves")
    assert told == [f"warning: {summary['warnings'][0]}"]


def test_pressuresOutsideOfTheRamp(caseOf, tmp_path):
    summary, told = warningsOf(caseOf(output={"pressures": [20, 60, 400, 500.5]}), tmp_path / "run")
    (text,) = summary["warnings"]
    assert text == "output.pressures: no snapshot at 20, 500.5 Pa, the capillary pressure goes from 50 to 400 Pa"
    assert told == [f"warning: {text}"] and "60Pa" in [entry["name"] for entry in summary["snapshots"]]


def test_warningsAreKeptOnce(tmp_path):
    case = {"case": {}, "ramp": {}}
    folder = RunFolder(tmp_path / "run", case)
    folder.writeSummary(state="running")
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["warnings"] == []
    for text in ("a", "b", "a"):
        folder.warn(text)
    folder.writeSummary(state="interrupted")
    again = RunFolder(tmp_path / "run", case)
    again.warn("b")
    again.writeSummary(state="finished")
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["warnings"] == ["a", "b"]


def test_pressuresOfSnapshotsMakeAnotherRun(caseOf):
    # The ramp stops at each, so the levels after it are others. Twice the same, or in another order, they do not.
    def key(pressures):
        from capfrac.run.folder import caseKey

        return caseKey(caseOf(output={"pressures": pressures}), {})

    assert key([60, 70]) == key([70.0, 60, 60]) and len({key([]), key([60]), key([60, 70])}) == 3
