# SPDX-License-Identifier: GPL-2.0-or-later
"""The command, interrupted and killed: the run folder stays usable, the same command ends the run as if nothing had
been.
"""

import json
import os
import signal
import time

import pytest

from capfrac.case import readCase
from capfrac.run.folder import RunFolder
from processes import run, waitFor

#: A run of some seconds: 40 grains, twenty levels of 300 steps or more, no pictures but those at the start and the end.
SMALL = [
    "figure15",
    "-s",
    "grains.count=40",
    "-s",
    "inlet.pores=1",
    "-s",
    "ramp.start=150",
    "-s",
    "ramp.increment=1",
    "-s",
    "ramp.max=170",
    "-s",
    "ramp.minLevelSteps=300",
    "-s",
    "output.pressures=[]",
    "-s",
    "output.fields=false",
]


def summaryOf(folder):
    return json.loads((folder / "summary.json").read_text())


@pytest.fixture(scope="module")
def uninterrupted(command, tmp_path_factory):
    """The folder of the small run, made in one go."""
    folder = tmp_path_factory.mktemp("whole") / "run"
    status, output, errors = run(command, "inject", *SMALL, "-q", "-o", folder)
    assert (status, errors) == (0, "")
    assert "mode: " in output and f"run folder: {folder}" in output
    return folder


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_interruptedRunIsTakenUpAndEndsTheSame(command, uninterrupted, tmp_path, how):
    folder = tmp_path / "run"
    process = command("inject", *SMALL, "-q", "-o", folder)
    waitFor(process, (folder / "checkpoint.yade.gz").exists)
    time.sleep(0.3)  # somewhere in the ramp; where does not matter for what follows
    process.send_signal(how)
    _, errors = process.communicate(timeout=60)
    stopped = how != signal.SIGKILL
    assert process.returncode == (130 if stopped else -9), errors
    summary = summaryOf(folder)
    assert summary["state"] == ("interrupted" if stopped else "running")
    assert (folder / "events.csv").exists() and (folder / "pc_saturation.csv").exists()
    if stopped:
        assert f"the same command takes the run up again from {folder}" in errors
        assert not [path for path in folder.rglob(".*")]
    status, output, errors = run(command, "inject", *SMALL, "-o", folder)
    assert status == 0 and "taking up the run at its checkpoint" in errors
    assert summaryOf(folder)["state"] == "finished" and not (folder / "checkpoint.yade.gz").exists()
    for name in ("events.csv", "pc_saturation.csv"):
        assert (folder / name).read_bytes() == (uninterrupted / name).read_bytes()
    whole, taken = summaryOf(uninterrupted), summaryOf(folder)
    assert {k: v for k, v in taken.items() if "econds" not in k} == {
        k: v for k, v in whole.items() if "econds" not in k
    }


def test_interruptedWhileTheSampleIsMadeLeavesNothing(command, tmp_path):
    process = command("inject", *SMALL[:2], "grains.count=300", "-o", tmp_path / "run")
    lines = []
    waitFor(process, lambda: lines.append(process.stderr.readline()) or "settling" in lines[-1])
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=60) == 130
    assert list(tmp_path.iterdir()) == []


def test_killedWhileTheSampleIsMadeCanBeRunAgain(command, tmp_path):
    folder = tmp_path / "run"
    process = command("inject", *SMALL[:2], "grains.count=300", "-o", folder)
    lines = []
    waitFor(process, lambda: lines.append(process.stderr.readline()) or "settling" in lines[-1])
    os.kill(process.pid, signal.SIGKILL)
    process.communicate(timeout=10)
    assert list(folder.iterdir()) == []
    assert RunFolder(folder, readCase("figure15")).summary == {}


@pytest.mark.parametrize(
    "arguments, status, message",
    [
        (["inject", "nowhere"], 1, "capfrac: error: the case 'nowhere' cannot be read"),
        (["inject", "figure15", "-s", "grains.rmin=1"], 1, "unknown key grains.rmin; did you mean 'rMin'?"),
        (
            ["inject", "figure15", "-o", "/dev/null/run"],
            1,
            "the run folder /dev/null/run cannot be written: Not a directory",
        ),
        (["inject"], 2, "the following arguments are required: case"),
        (["injekt"], 2, "invalid choice: 'injekt'"),
    ],
)
def test_commandSaysWhatIsWrongInOneSentence(command, tmp_path, arguments, status, message):
    returned, output, errors = run(lambda *a: command(*a, cwd=tmp_path), *arguments)
    assert returned == status and output == "" and message in errors
    assert status == 2 or len(errors.splitlines()) == 1
    assert "Traceback" not in errors and list(tmp_path.iterdir()) == []
