# SPDX-License-Identifier: GPL-2.0-or-later
"""Run folders: what cannot be used is refused as it is, and nothing half-written is left."""

import signal

import pytest
from yade import O

from capfrac import injection
from capfrac.case import resolveCase
from capfrac.errors import RunFolderError, SceneError
from capfrac.run.checkpoint import saveScene
from capfrac.run.folder import RunFolder


def caseOf(**grains):
    return resolveCase(
        {
            "grains": {"rMin": 1e-3, **grains},
            "stress": {"vertical": 10e3, "horizontal": 8e3},
            "inlet": {"pores": 3},
            "ramp": {"start": 100, "increment": 1, "max": 200},
        }
    )


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def refused(folder, message, error=RunFolderError, case=None, **options):
    before = contents(folder) if folder.is_dir() else None
    with pytest.raises(error, match=message):
        injection.inject(case or caseOf(), folder, report=lambda text: None, **options)
    if before is not None:
        assert contents(folder) == before
    assert len(O.engines) == 0


def writeRun(folder, state, case=None):
    """A run folder as a run leaves it, without running."""
    run = RunFolder(folder, case or caseOf())
    run.writeSummary(state=state, title="", mode={})
    run.writeTable("events.csv", {"event": [1, 2]})
    run.sub("snapshots").joinpath("start.png").write_text("picture")
    return run


# ---- folders that cannot be used


def test_folderBelowAFile(tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(RunFolderError, match="the run folder .*file/run cannot be written: Not a directory"):
        injection.inject(caseOf(), tmp_path / "file" / "run")
    with pytest.raises(RunFolderError, match="the run folder .*file cannot be written: File exists"):
        injection.inject(caseOf(), tmp_path / "file")
    assert (tmp_path / "file").read_text() == "mine"


@pytest.mark.parametrize("restart", [False, True])
def test_foreignFolder(tmp_path, restart):
    (tmp_path / "thesis.tex").write_text("mine")
    refused(tmp_path, r"holds other things \(thesis.tex\); choose an empty or new one", restart=restart)


@pytest.mark.parametrize("restart", [False, True])
@pytest.mark.parametrize("text", ["{}", '{"state": "finished"}', "[1, 2]", "3"])
def test_foreignSummary(tmp_path, text, restart):
    # Another program's summary.json: not to be read as a run, and least of all to be cleared away.
    (tmp_path / "summary.json").write_text(text)
    (tmp_path / "events.csv").write_text("mine")
    refused(tmp_path, "summary.json is not that of a run of capfrac", restart=restart)


@pytest.mark.parametrize("data", [b"{", b"", b"\xff\xfe"])
def test_brokenSummary(tmp_path, data):
    (tmp_path / "summary.json").write_bytes(data)
    refused(tmp_path, "summary.json cannot be read")


def test_runOfOtherParameters(tmp_path):
    writeRun(tmp_path, "finished", caseOf(seed=2))
    refused(tmp_path, "holds a run with other parameters; choose another folder, or --restart to discard that run")


def test_finishedRunIsReturnedAsItIs(tmp_path):
    writeRun(tmp_path, "finished")
    before = contents(tmp_path)
    assert injection.inject(caseOf(), tmp_path, report=lambda text: None)["state"] == "finished"
    assert contents(tmp_path) == before


def test_restartTakesAwayOnlyWhatARunWrites(tmp_path):
    run = writeRun(tmp_path, "finished", caseOf(seed=2))
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "snapshots" / "mine").mkdir()
    saveScene(run, run.checkpoint.name)
    RunFolder(tmp_path, caseOf(), restart=True)
    assert contents(tmp_path) == {"notes.txt": b"mine", "snapshots": None, "snapshots/mine": None}


def test_leftoverOfAKilledRunIsNotForeign(tmp_path):
    (tmp_path / ".4711-summary.json").write_text("{")
    RunFolder(tmp_path, caseOf())
    RunFolder(tmp_path, caseOf(), restart=True)
    assert contents(tmp_path) == {}


def test_failedWriteLeavesTheOldFile(tmp_path):
    run = writeRun(tmp_path, "running")
    before = contents(tmp_path)

    def halfWay(path):
        path.write_text("half")
        raise OSError(28, "No space left on device")

    with pytest.raises(RunFolderError, match="events.csv cannot be written: No space left on device"):
        run.writeWhole("events.csv", halfWay)
    assert contents(tmp_path) == before
    with pytest.raises(KeyboardInterrupt):
        run.writeWhole("events.csv", lambda path: (path.write_text("half"), signal.raise_signal(signal.SIGINT)))
    assert contents(tmp_path) == before


def test_damagedCheckpoint(tmp_path):
    # Refused, not discarded: the results so far are the user's.
    writeRun(tmp_path, "interrupted").checkpoint.write_bytes(b"\x1f\x8b\x08 no scene")
    refused(
        tmp_path,
        (
            "the checkpoint .*checkpoint.yade.gz cannot be read .*: damaged, or of another version of capfrac or YADE;"
            " --restart discards the run"
        ),
    )


def test_sceneWithBodiesIsNotThrownAway(tmp_path, handScene, looseDisks, sceneState):
    handScene(*looseDisks())
    before = sceneState()
    with pytest.raises(
        SceneError, match=r"the scene holds 29 bodies; call O.reset\(\) first, or inject\(..., replaceScene=True\)"
    ):
        injection.inject(caseOf(), tmp_path / "run")
    assert sceneState() == before and not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    "inlet, message",
    [
        ({"pores": 99}, "inlet.pores = 99, allowed: 1 … "),
        ({"from": 0.0, "to": 1.0}, "inlet.from = 0, inlet.to = 1 m, allowed: 0 … "),
        ({"points": [[1.0, 1.0]]}, r"inlet.points .* allowed: points inside the box"),
        ({"middle": 1.0}, r"inlet.points .* allowed: points inside the box"),
    ],
)
def test_inletThatDoesNotFitTheSampleLeavesNothing(tmp_path, inlet, message):
    # Known only when the sample is made, so the folder exists by then.
    case = resolveCase(
        {
            "grains": {"rMin": 1e-3, "count": 10},
            "stress": {"vertical": 10e3, "horizontal": 8e3},
            "inlet": inlet,
            "ramp": {"start": 100, "increment": 1, "max": 200},
        }
    )
    with pytest.raises(ValueError, match=message):
        injection.inject(case, tmp_path / "run", report=lambda text: None)
    assert list(tmp_path.iterdir()) == []
