# SPDX-License-Identifier: GPL-2.0-or-later
"""Sweeps that are interrupted, killed, or have points that fail: the same command goes on and ends with the same table.
"""

import csv
import shlex
import signal
import subprocess
import time

import pytest

from capfrac.errors import RunFolderError
from capfrac.sweep import execution, readSweep, runSweep
from processes import run, waitFor

#: Two runs of a second or two: 30 grains, a short ramp.
SMALL = """
[sweep]
title = "Small"
case = "figure15"
[set]
grains.count = 30
inlet.pores = 1
ramp = {start = 150.0, increment = 1.0, max = 160.0, minLevelSteps = 300}
output = {fields = false, pictures = "none", pressures = []}
[[grid]]
cohesion.chi = [0.0, 10.0]
"""
#: Columns that differ between two runs of the same.
COST = ("cpuSeconds [s]",)


@pytest.fixture
def small(tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(SMALL)
    return path


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The table of the small sweep, made in one go, two at a time, here."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "small.toml").write_text(SMALL)
    result = runSweep(readSweep(folder / "small.toml"), folder / "sweep", processes=2)
    assert (result["finished"], result["failed"], result["points"]) == (2, 0, 2)
    assert not list((folder / "sweep" / "points").rglob("*.png")), "output.pictures is none"
    return rows(folder / "sweep")


def rows(folder):
    with open(folder / "table.csv", newline="") as stream:
        return [{name: value for name, value in line.items() if name not in COST} for line in csv.DictReader(stream)]


def test_tableHasEveryPoint(whole):
    assert [line["point"] for line in whole] == ["chi0", "chi10"]
    for line in whole:
        assert line["state"] == "finished" and line["error"] == "" and line["mode"] in ("capillary", "mixed")
        # Grains of 1-2 mm: throats open between 121 and 241 Pa at contact; the ramp ends at 160 Pa.
        assert (
            121 < float(line["endPressure [Pa]"]) <= 160
            and float(line["ramp.start [Pa]"] if "ramp.start [Pa]" in line else 150) == 150
        )


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_stoppedSweepGoesOnAndEndsTheSame(command, small, whole, tmp_path, how):
    folder = tmp_path / "sweep"
    process = command("sweep", small, "-o", folder)
    waitFor(process, (folder / "points" / "chi0" / "checkpoint.yade.gz").exists)
    process.send_signal(how)
    _, errors = process.communicate(timeout=90)
    assert process.returncode == (-9 if how == signal.SIGKILL else 130), errors
    if how != signal.SIGKILL:
        assert f"the same command goes on with the sweep in {folder}" in errors
    # Nothing is left that would still write: the point died with its sweep.
    end = time.time() + 10
    while time.time() < end and subprocess.run(["pgrep", "-f", f"sweep.worker.*{folder}"], capture_output=True).stdout:
        time.sleep(0.1)
    assert not subprocess.run(["pgrep", "-f", f"sweep.worker.*{folder}"], capture_output=True).stdout
    assert not (folder / "points" / "chi10").exists() and rows(folder)[0]["state"] in ("open", "begun")
    status, output, errors = run(command, "sweep", small, "-o", folder)
    assert status == 0, errors
    assert "Small: 2 of 2 points finished, 0 failed" in output
    assert rows(folder) == whole


def test_finishedPointsAreNotRunAgain(small, tmp_path, monkeypatch):
    sweep, told = readSweep(small), []
    first = runSweep(sweep, tmp_path / "sweep", points=1)
    assert (first["points"], first["finished"]) == (1, 1) and len(rows(tmp_path / "sweep")) == 1
    written = (tmp_path / "sweep" / "points" / "chi0" / "summary.json").stat().st_mtime_ns
    runSweep(sweep, tmp_path / "sweep", report=told.append)
    assert (
        told[0] == "2 points: 1 finished, 0 failed, 1 to run, 1 at a time"
        and len(told) == 2
        and told[1].startswith("2/2 chi10: ")
    )
    assert (tmp_path / "sweep" / "points" / "chi0" / "summary.json").stat().st_mtime_ns == written


def test_failedPointsAreRecordedAndDoNotStopTheRest(tmp_path):
    path = tmp_path / "bad.toml"
    # wider than the box, as only the sample tells
    path.write_text(
        SMALL.replace("inlet.pores = 1\n", "").replace("cohesion.chi = [0.0, 10.0]", "inlet.pores = [99, 1]")
    )
    result = runSweep(readSweep(path), tmp_path / "sweep")
    assert (result["finished"], result["failed"]) == (1, 1)
    bad, good = rows(tmp_path / "sweep")
    assert (bad["state"], good["state"]) == ("failed", "finished") and bad["mode"] == ""
    assert "= 99, allowed: 1 …" in bad["error"]
    assert "= 99, allowed: 1 …" in (tmp_path / "sweep" / "failed" / "pores99.txt").read_text()
    told = []
    runSweep(readSweep(path), tmp_path / "sweep", report=told.append)
    assert told == ["2 points: 1 finished, 1 failed, 0 to run, 1 at a time"]
    runSweep(readSweep(path), tmp_path / "sweep", retry=True, report=told.append)
    assert "1 to run" in told[1] and "= 99, allowed: 1 …" in told[2] and "FAILED" in told[2]


def test_aKilledPointCountsAsFailed(small, tmp_path, monkeypatch):
    monkeypatch.setattr(execution.environment, "pythonOf", lambda *arguments: ["/bin/sh", "-c", "kill -9 $$"])
    result = runSweep(readSweep(small), tmp_path / "sweep")
    assert result["failed"] == 2 and rows(tmp_path / "sweep")[0]["error"] == "ended by signal 9 (SIGKILL)"


def test_foldersOfOthersAreRefused(small, tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(RunFolderError, match="holds other things"):
        runSweep(readSweep(small), tmp_path)
    runSweep(readSweep(small), tmp_path / "sweep", points=1)
    with pytest.raises(RunFolderError, match="chi0 holds a run with other parameters"):
        runSweep(readSweep(small, ["grains.seed=5"]), tmp_path / "sweep")
    with pytest.raises(RunFolderError, match="cannot be written"):
        runSweep(readSweep(small), "/dev/null/sweep")


def test_twoSweepsDoNotShareAFolder(command, small, tmp_path):
    folder = tmp_path / "sweep"
    process = command("sweep", small, "-o", folder, "-q")
    waitFor(process, (folder / "points").exists)
    try:
        with pytest.raises(RunFolderError, match="another sweep is at work"):
            runSweep(readSweep(small), folder)
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=90)


@pytest.mark.parametrize(
    "arguments, status, message",
    [
        (["sweep", "nowhere"], 1, "capfrac: error: the sweep 'nowhere' cannot be read"),
        (["sweep", "regime_map", "-j", "0"], 1, "--processes = 0, allowed: a whole number >= 1"),
        (["sweep", "regime_map", "-s", "grains.cuont=3"], 1, "'grains.cuont' is no key of a case"),
        (["sweep"], 2, "the following arguments are required: sweep"),
    ],
)
def test_commandSaysWhatIsWrong(command, tmp_path, arguments, status, message):
    returned, output, errors = run(lambda *a: command(*a, cwd=tmp_path), *arguments)
    assert (
        returned == status
        and output == ""
        and message in errors
        and "Traceback" not in errors
        and list(tmp_path.iterdir()) == []
    )


def test_listedCommandsFillTheSweep(command, small, whole, tmp_path):
    # As pasted into a shell, in a folder whose name a shell would take apart.
    folder = tmp_path / "a sweep; 'of' $two"
    status, output, errors = run(command, "sweep", small, "--list", "-o", folder)
    assert status == 0 and errors == "" and len(output.splitlines()) == 2
    for line in output.splitlines():
        name, *arguments = shlex.split(line)
        assert name == "capfrac"
        status, _, errors = run(command, *arguments, "-q")
        assert status == 0, errors
    told = []
    assert runSweep(readSweep(small), folder, report=told.append)["finished"] == 2
    assert told == ["2 points: 2 finished, 0 failed, 0 to run, 1 at a time"] and rows(folder) == whole


def test_failuresAreTold(command, tmp_path):
    path = tmp_path / "none.toml"
    grid = "inlet.pores = [98, 99]"
    path.write_text(SMALL.replace("inlet.pores = 1", "").replace("cohesion.chi = [0.0, 10.0]", grid))
    for _ in range(2):  # also where nothing is left to run
        status, output, errors = run(command, "sweep", path, "-o", tmp_path / "sweep", "-q")
        lines = output.splitlines()
        assert status == 1 and lines[0].startswith("Small: 0 of 2 points finished, 2 failed, in ")
        assert lines[1].startswith("failed: pores98: ") and "98, allowed: 1 … " in lines[1]
        assert lines[2].startswith("failed: pores99: ")
        assert lines[3] == "With --retry the same command runs them once more" and lines[4].startswith("table: ")
    assert not (tmp_path / "sweep" / "figures").exists()
