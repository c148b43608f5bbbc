# SPDX-License-Identifier: GPL-2.0-or-later
"""A result belongs to what is in the files that a case, a test or a sweep names, not to their names."""

import json
import re

import pytest

from capfrac import injection
from capfrac.case import resolveCase
from capfrac.errors import CaseError, RunFolderError
from capfrac.io import namedfiles
from capfrac.lab import command as lab, parameters
from capfrac.lab.run import LabRun
from capfrac.run.folder import RunFolder, caseKey, difference
from capfrac.sweep import readSweep, runSweep
from processes import run, writePacking


def inject(case, folder, **options):
    return injection.inject(case, folder, report=lambda text: None, replaceScene=True, **options)


def caseOf(folder, name="packing.csv", **grains):
    return resolveCase(
        {
            "case": {},
            "grains": {"rMin": 1e-3, "packing": str(folder / name), **grains},
            "stress": {"vertical": 10e3, "horizontal": 10e3},
            "inlet": {"pores": 1},
            "ramp": {"start": 50, "increment": 10, "max": 400, "endAt": "breakthrough"},
            "output": {"pictures": "none", "fields": False},
        }
    )


def finished(folder, case):
    """A run folder as a finished run leaves it, without running."""
    held = RunFolder(folder, case, files=namedfiles.digests(case))
    held.writeSummary(state="finished", mode={})


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


# ---- injections


def test_changedPackingIsNotTheRunThatIsThere(tmp_path):
    writePacking(tmp_path / "packing.csv")
    case, folder = caseOf(tmp_path), tmp_path / "run"
    inject(case, folder)
    before, first = contents(folder), json.loads((folder / "summary.json").read_text())
    assert first["files"]["grains.packing"]["file"] == str(tmp_path / "packing.csv")
    assert re.fullmatch("[0-9a-f]{64}", first["files"]["grains.packing"]["sha256"])
    assert inject(case, folder) == first
    writePacking(tmp_path / "packing.csv", 2)
    message = "holds a run of an earlier content of .*packing.csv, changed since; choose another folder, or --restart"
    with pytest.raises(RunFolderError, match=message):
        inject(case, folder)
    assert contents(folder) == before
    again = inject(case, folder, restart=True)
    # All is twice as large, overlaps too (2 r sigma / k_n): half the pressure, up to a step of 10 Pa of each ramp.
    pressures = [summary["mode"]["breakthroughPressure"] for summary in (first, again)]
    assert pressures[0] == pytest.approx(2 * pressures[1], abs=20) and again["files"] != first["files"]


def test_contentCountsNotTheName(tmp_path):
    writePacking(tmp_path / "packing.csv")
    writePacking(tmp_path / "other.csv")
    finished(tmp_path / "run", caseOf(tmp_path))
    assert inject(caseOf(tmp_path, "other.csv"), tmp_path / "run")["state"] == "finished"
    writePacking(tmp_path / "other.csv", comment="# bytes count, not what they mean\n")
    with pytest.raises(RunFolderError, match="an earlier content of .*other.csv, changed since"):
        inject(caseOf(tmp_path, "other.csv"), tmp_path / "run")


def test_otherParametersAreTold(tmp_path):
    writePacking(tmp_path / "packing.csv")
    finished(tmp_path / "run", caseOf(tmp_path))
    with pytest.raises(RunFolderError, match="holds a run with other parameters; choose"):
        inject(caseOf(tmp_path, friction=0.3), tmp_path / "run")
    writePacking(tmp_path / "packing.csv", 1.5)
    with pytest.raises(RunFolderError, match="with other parameters and another content of .*packing.csv; choose"):
        inject(caseOf(tmp_path, friction=0.3), tmp_path / "run")


@pytest.mark.parametrize("recorded", [None, 3, "gone"])
def test_runsOfAFormerVersionAreTold(tmp_path, recorded):
    # It kept the name of the file alone, and may be a run of anything.
    writePacking(tmp_path / "packing.csv")
    case = caseOf(tmp_path)
    held = RunFolder(tmp_path / "run", case)
    held.writeSummary(state="finished")
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["caseKey"] == caseKey(case, {})
    summary.update(files=recorded) if recorded != "gone" else summary.pop("files")
    (tmp_path / "run" / "summary.json").write_text(json.dumps(summary))
    message = "a run of a former version of capfrac, which did not record what was in .*packing.csv; choose another"
    with pytest.raises(RunFolderError, match=message):
        inject(case, tmp_path / "run")


def test_caseWithoutFilesIsTheRunThatItWas():
    case = resolveCase(
        {
            "grains": {"rMin": 1e-3},
            "stress": {"vertical": 1, "horizontal": 1},
            "inlet": {"pores": 1},
            "ramp": {"start": 1, "increment": 1, "max": 2},
        }
    )
    assert namedfiles.digests(case) == {} and difference({"caseKey": caseKey(case, {})}, case, {}) == ""


def test_fileThatCannotBeRead(tmp_path):
    with pytest.raises(CaseError, match="^the packing .*packing.csv cannot be read: No such file or directory$"):
        namedfiles.digests(caseOf(tmp_path))


# ---- laboratory


def labValues(test, **entries):
    raw = {}
    for key, value in entries.items():
        section, name = key.split("__")
        raw.setdefault(section.replace("_", "-"), {})[name] = value
    return parameters.resolve(test, raw)


@pytest.mark.parametrize(
    "test, entries, first, then",
    [
        (
            "settle",
            {"grains__distribution": "sieve", "grains__sieve": "curve.csv", "grains__count": 10},
            "diameter [mm],passing\n1,0\n2,100\n",
            "diameter [mm],passing\n1,0\n3,100\n",
        ),
        (
            "hydrate-ridge",
            {"hydrate_ridge__laboratory": "curve.csv"},
            "stress,strain\n1e5,0.1\n2e5,0.2\n",
            "stress,strain\n1e5,0.1\n2e5,0.3\n",
        ),
    ],
)
def test_changedCurvesAreNotTheTestThatIsThere(tmp_path, test, entries, first, then):
    curve = tmp_path / "curve.csv"
    curve.write_text(first)
    values = labValues(test, **entries)
    key = next(iter(namedfiles.digests(values, tmp_path)))
    held = LabRun(test, values, tmp_path / "run", files=namedfiles.digests(values, tmp_path))
    held.finish({"told": 1})
    assert lab.runTest(test, values, tmp_path / "run", base=tmp_path) == {"told": 1}
    assert held.summary["files"][key]["file"] == "curve.csv"
    curve.write_text(then)
    with pytest.raises(RunFolderError, match="holds a run of an earlier content of curve.csv, changed since"):
        lab.runTest(test, values, tmp_path / "run", base=tmp_path)
    curve.write_text(first)
    assert lab.runTest(test, values, tmp_path / "run", base=tmp_path) == {"told": 1}


def test_sieveThatIsNotUsedDoesNotCount(tmp_path):
    assert namedfiles.namedFiles(labValues("settle", grains__sieve="no.csv"), tmp_path) == {}


def test_gradingIsKept(tmp_path):
    (tmp_path / "curve.csv").write_text("diameter [mm],passing\n1,0\n2,100\n")
    values = labValues("settle", grains__distribution="sieve", grains__sieve="curve.csv", grains__count=10)
    lab.runTest("settle", values, tmp_path / "run", base=tmp_path)
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["grading"] == {"name": "Sieve", "diameter": [0.001, 0.002], "passing": [0, 100]}


def test_boulders(tmp_path):
    (tmp_path / "curve.csv").write_text("diameter,passing\n1,0\n2,100\n")
    values = labValues("settle", grains__distribution="sieve", grains__sieve="curve.csv", grains__count=10)
    lab.runTest("settle", values, tmp_path / "run", base=tmp_path)
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["warnings"] == ["grains of up to r = 1 m, boulders: is a number in mm that is meant to be in m?"]


# ---- sweeps


SWEEP = """
[sweep]
case = "base.toml"
[[grid]]
cohesion.chi = [0.0, 10.0]
"""
BASE = """
[grains]
packing = "packing.csv"
rMin = 1e-3
[stress]
vertical = 10e3
horizontal = 10e3
[inlet]
pores = 1
[ramp]
start = 50
increment = 10
max = 400
endAt = "breakthrough"
[output]
pictures = "none"
fields = false
"""


@pytest.fixture
def sweepFile(tmp_path):
    writePacking(tmp_path / "packing.csv")
    (tmp_path / "base.toml").write_text(BASE)
    (tmp_path / "many.toml").write_text(SWEEP)
    return tmp_path / "many.toml"


def test_sweepDoesNotMixContents(command, sweepFile, tmp_path):
    folder = tmp_path / "sweep"
    assert runSweep(readSweep(sweepFile), folder, points=1)["finished"] == 1
    before = contents(folder)
    writePacking(tmp_path / "packing.csv", 2)
    message = "points/chi0 holds a run of an earlier content of packing.csv, changed since; choose another folder"
    with pytest.raises(RunFolderError, match=message):
        runSweep(readSweep(sweepFile), folder)
    assert contents(folder) == before
    status, _, errors = run(command, "sweep", sweepFile, "-o", folder)
    assert status == 1 and "changed since" in errors
    writePacking(tmp_path / "packing.csv")
    assert runSweep(readSweep(sweepFile), folder)["finished"] == 2


def test_fileThatChangesWhileASweepRuns(sweepFile, tmp_path):
    sweep = readSweep(sweepFile)
    writePacking(tmp_path / "packing.csv", 2)
    result = runSweep(sweep, tmp_path / "sweep")
    assert (result["finished"], result["failed"]) == (0, 2)
    told = (tmp_path / "sweep" / "failed" / "chi0.txt").read_text()
    assert "a file that it names was changed since the sweep began" in told
    assert not (tmp_path / "sweep" / "points" / "chi0").exists()
    # Those failures are not of the sweep as it is now.
    result = runSweep(readSweep(sweepFile), tmp_path / "sweep", points=1)
    assert (result["finished"], result["failed"]) == (1, 0)
    assert not (tmp_path / "sweep" / "failed" / "chi0.txt").exists()


def test_failureBelongsToWhatFailed(sweepFile, tmp_path):
    (tmp_path / "base.toml").write_text(BASE.replace("pores = 1", "pores = 99"))
    result, told = runSweep(readSweep(sweepFile), tmp_path / "sweep"), []
    assert result["failed"] == 2
    runSweep(readSweep(sweepFile), tmp_path / "sweep", report=told.append)
    assert told == ["2 points: 0 finished, 2 failed, 0 to run, 1 at a time"]
    (tmp_path / "base.toml").write_text(BASE)
    assert runSweep(readSweep(sweepFile), tmp_path / "sweep")["finished"] == 2


def test_badPackingIsRefusedBeforeASweepBegins(sweepFile, tmp_path):
    (tmp_path / "packing.csv").write_text("x,y,r\n1,2,3,4\n")
    with pytest.raises(CaseError, match="point chi0: .*packing.csv, line 2: 4 fields"):
        readSweep(sweepFile)
