# SPDX-License-Identifier: GPL-2.0-or-later
"""Laboratory tests that are interrupted: stages, checkpoints and results of LabRun, and folders that cannot be used.

A test here is four grains that jostle in a box, 400 steps in chunks of 50, the height of the top one written down after
each. What a process of its own would see is had by a new LabRun on an empty scene.
"""

import json
import os
import signal
import time
from pathlib import Path

import pytest
from yade import O

from capfrac import sediment
from capfrac.errors import RunFolderError
from capfrac.lab import run as labrun
from capfrac.lab.run import LabRun

PARAMETERS = {"grains": {"rMin": 1e-3, "seed": 1}, "fall": {"steps": 400}}
STEPS, CHUNK = 400, 50


class Killed(BaseException):
    """Ends a run here as a kill does: nothing catches it."""


@pytest.fixture
def labFolder(tmp_path):
    return tmp_path / "run"


@pytest.fixture
def everyTick(monkeypatch):
    """A checkpoint at every tick."""
    monkeypatch.setattr(labrun, "CHECKPOINT_TICKS", 1)


def takeUp(folder, parameters=PARAMETERS, **options):
    """The run as a new process would find it."""
    O.reset()
    return LabRun("fall", parameters, folder, **options)


def place():
    """Three grains in a row and one above: pressed into each other a little, so that they jump and turn from the
    beginning.
    """
    sample = sediment.Sediment(grainCount=4, rMin=1e-3, rMax=1e-3)
    r, u = 1e-3, 1e-6
    sediment.buildScene(
        sample,
        [r - u, 3 * r - 2 * u, 5 * r - 3 * u, 2 * r],
        [r - u, r, r - u, 2.7 * r],
        [r] * 4,
        (0, 6 * r - 4 * u, 0, 8 * r),
    )
    sediment.startSettling(sample, 1000.0)


def fall(run, until=STEPS, killedAt=None):
    """Towards an absolute step, so that it can be taken up; ``killedAt`` between two checkpoints."""
    rows = run.data.setdefault("height [m]", [])
    while O.iter < until:
        if killedAt is not None and O.iter >= killedAt:
            O.run(20, True)  # these are lost
            raise Killed
        O.run(CHUNK, True)
        rows.append(O.bodies[7].state.pos[1])
        run.tick()


def bits():
    bodies = [(tuple(b.state.pos), tuple(b.state.vel), tuple(b.state.angVel), tuple(b.state.angMom)) for b in O.bodies]
    contacts = sorted(
        (i.id1, i.id2, tuple(i.phys.normalForce), tuple(i.phys.shearForce), i.phys.cohesionBroken)
        for i in O.interactions
        if i.isReal
    )
    return bodies, contacts, [type(e).__name__ for e in O.engines], [e.label for e in O.engines], O.iter, O.dt, O.time


def wholeRun(steps=STEPS):
    """Rows and bits of the run that nothing interrupts, without a folder."""
    O.reset()
    run = LabRun("fall", PARAMETERS)
    run.stage("place", place)
    run.stage("fall", lambda: fall(run, steps))
    assert len(bits()[1]) >= 4  # the grains have reached the floor and each other: there is something to restore
    return run.data["height [m]"], bits()


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def mustNotRun():
    pytest.fail("this has been done before")


# ---- stages


def test_sceneAndDataAreRestoredToTheBit(labFolder):
    run = takeUp(labFolder)
    run.stage("place", place)
    run.stage("fall", lambda: fall(run))
    run.data.update(text="Größe", number=1 / 3, nested={"list": [1, [2.5, None]]}, nothing=float("nan"))
    run.stage("look", lambda: None)
    before, data = bits(), dict(run.data)
    assert len(before[1]) >= 4

    run = takeUp(labFolder)
    for name in ("place", "fall", "look"):
        run.stage(name, mustNotRun)
    seen = []
    run.stage("next", lambda: seen.append(bits()))
    assert seen == [before]
    assert str(run.data) == str(data) and run.data["height [m]"] == data["height [m]"]


def test_sceneIsThereThoughNoStageIsLeft(labFolder):
    # A test reads its results off the scene after its last stage; it may be killed just then.
    run = takeUp(labFolder)
    run.stage("place", place)
    run.stage("fall", lambda: fall(run))
    before = bits()
    run = takeUp(labFolder)
    run.stage("place", mustNotRun)
    run.stage("fall", mustNotRun)
    assert bits() == before


def test_stagesOfOneProcessRunOnce(labFolder):
    for folder in (None, labFolder):
        calls = []
        run = takeUp(folder)
        for _ in range(2):
            run.stage("one", lambda: calls.append(1))
        assert calls == [1]


@pytest.mark.parametrize("killedAt", [0, 100, 350])
def test_interruptedStageGoesOnFromItsLastCheckpoint(labFolder, everyTick, killedAt):
    height, end = wholeRun()
    run = takeUp(labFolder)
    run.stage("place", place)
    with pytest.raises(Killed):
        run.stage("fall", lambda: fall(run, killedAt=killedAt))
    assert O.iter == killedAt + 20

    reports = []
    run = takeUp(labFolder, report=reports.append)
    assert reports == ["taking up the run at its checkpoint"]
    began = []
    run.stage("place", mustNotRun)
    run.stage("fall", lambda: (began.append(O.iter), fall(run)))
    assert began == [killedAt]
    assert run.data["height [m]"] == height and bits() == end


def test_interruptionTwiceAndInTheFirstStage(labFolder, everyTick):
    def both(run, killedAt=None):
        if not len(O.bodies):
            place()
        fall(run, killedAt=killedAt)

    O.reset()
    run = LabRun("fall", PARAMETERS)
    run.stage("all", lambda: both(run))
    height, end = run.data["height [m]"], bits()
    for killedAt in (50, 250, None):
        run = takeUp(labFolder)
        try:
            run.stage("all", lambda: both(run, killedAt))
        except Killed:
            pass
    assert run.data["height [m]"] == height and bits() == end


def test_betweenCheckpointsNothingIsSaved(labFolder, monkeypatch):
    monkeypatch.setattr(labrun, "CHECKPOINT_TICKS", 3)
    run = takeUp(labFolder)
    run.stage("place", place)
    for saves in (False, False, True, False, False, True, False):
        before = contents(labFolder)
        fall(run, O.iter + CHUNK)
        assert (contents(labFolder) != before) == saves


@pytest.mark.parametrize("inFolder", [False, True])
def test_ticksAndFolderDoNotChangeTheOrderOfCheckpoints(labFolder, monkeypatch, inFolder):
    # Checkpoints are where a run that is taken up has them: so many ticks after the last one.
    monkeypatch.setattr(labrun, "CHECKPOINT_TICKS", 3)
    height, end = wholeRun()
    run = takeUp(labFolder if inFolder else None)
    run.stage("place", place)
    if inFolder:
        with pytest.raises(Killed):
            run.stage("fall", lambda: fall(run, killedAt=250))
        run = takeUp(labFolder)
    run.stage("place", mustNotRun)
    run.stage("fall", lambda: fall(run))
    assert run.data["height [m]"] == height and bits() == end


def test_oneSceneIsKept(labFolder, everyTick):
    run = takeUp(labFolder)
    run.stage("place", place)
    run.stage("fall", lambda: fall(run))
    named = json.loads((labFolder / "state.json").read_text())["scene"]
    assert [f"scenes/{path.name}" for path in (labFolder / "scenes").iterdir()] == [named]


@pytest.mark.parametrize("moment", ["scene", "state", "old scene"])
def test_killedWithinACheckpoint(labFolder, monkeypatch, everyTick, moment):
    # The run is killed as it puts the scene or the state in its place, or as the old scene is to go.
    height, end = wholeRun()
    run = takeUp(labFolder)
    run.stage("place", place)
    fall(run, 100)
    replace, unlink = os.replace, Path.unlink

    def killedReplacing(source, target):
        if Path(target).name == ("state.json" if moment == "state" else "4.yade.gz") and moment != "old scene":
            raise Killed
        replace(source, target)

    def killedUnlinking(path, missing_ok=False):
        if moment == "old scene" and path.name[0] != "." and path.name.endswith(".yade.gz"):
            raise Killed
        unlink(path, missing_ok=missing_ok)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", killedReplacing)
        patch.setattr(Path, "unlink", killedUnlinking)
        with pytest.raises(Killed):
            fall(run)
    run = takeUp(labFolder)
    run.stage("place", mustNotRun)
    run.stage("fall", lambda: fall(run))
    assert run.data["height [m]"] == height and bits() == end
    run.finish({"steps": O.iter})
    assert sorted(contents(labFolder)) == ["summary.json"]


SCRIPT = """
import sys
sys.path.insert(0, {here!r})
import capfrac
capfrac.load_engines()
from capfrac.lab import run as labrun
import test_lab_run as test
labrun.CHECKPOINT_TICKS = 1
run = labrun.LabRun("fall", test.PARAMETERS, {folder!r})
run.stage("place", test.place)
while True:  # for ever over the same steps, until killed
    test.fall(run, int(1e9))
"""


def test_killedProcess(labFolder, everyTick, command, tmp_path):
    # SIGKILL somewhere in some hundred checkpoints: what is left is a state that is whole.
    script = tmp_path / "script.py"
    script.write_text(SCRIPT.format(here=str(Path(__file__).parent), folder=str(labFolder)))
    process = command("python", script)
    end = time.time() + 60
    while time.time() < end and process.poll() is None and not _count(labFolder) > 20:
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == -signal.SIGKILL, errors
    seen = []
    run = takeUp(labFolder)
    run.stage("place", mustNotRun)
    run.stage("look", lambda: seen.append(bits()))
    rows = run.data["height [m]"]
    assert len(rows) >= 20
    # Its last checkpoint was in the middle of a stage, as at the end of one.
    height, end = wholeRun(CHUNK * len(rows))
    assert rows == height and seen == [end]


def _count(folder):
    try:
        return json.loads((folder / "state.json").read_text())["count"]
    except OSError:
        return 0


# ---- results


def test_resultsAreComputedOnce(labFolder):
    def work(value):
        assert len(O.bodies) == 0 and run.data == {}
        place()
        run.data["scratch"] = 1
        return value

    run = takeUp(labFolder)
    place()
    value = {"numbers": (1, 2.5), "text": "Größe", "nothing": None, "third": 1 / 3}
    stored = {**value, "numbers": [1, 2.5]}  # as it is read back
    assert run.result("one", lambda: work(value)) == stored
    assert run.result("one", mustNotRun) == stored
    assert run.result("two", lambda: work(3)) == 3

    reports = []
    run = takeUp(labFolder, report=reports.append)
    assert run.result("one", mustNotRun) == stored and run.result("two", mustNotRun) == 3
    assert reports == ["taking up the run at its checkpoint"]
    assert run.result("three", lambda: work([])) == [] and reports[1:] == ["three"]


def test_stagesOfAResultAreForgottenAfterwards(labFolder):
    for folder in (None, labFolder):
        run = takeUp(folder)

        def work(steps):
            run.stage("place", place)
            run.stage("fall", lambda: fall(run, steps))
            return [O.iter, len(run.data["height [m]"])]

        assert run.result("short", lambda: work(50)) == [50, 1]
        assert run.result("long", lambda: work(100)) == [100, 2]
        assert run.data == {}


@pytest.mark.parametrize("where", ["in a stage", "after the last stage"])
def test_interruptedResultGoesOn(labFolder, everyTick, where):
    height, end = wholeRun()
    seen = []

    def work(killed):
        run.stage("place", mustNotRun if not killed else place)
        run.stage("fall", lambda: fall(run, killedAt=200 if killed and where == "in a stage" else None))
        if killed:
            raise Killed
        seen.append(bits())
        return run.data["height [m]"]

    run = takeUp(labFolder)
    assert run.result("before", lambda: 1) == 1
    with pytest.raises(Killed):
        run.result("fall", lambda: work(True))
    run = takeUp(labFolder)
    assert run.result("before", mustNotRun) == 1
    assert run.result("fall", lambda: work(False)) == height
    assert seen == [end]


@pytest.mark.parametrize("inFolder", [False, True])
@pytest.mark.parametrize("again", ["one", "other"])
def test_failedResultLeavesNothingToTheNext(labFolder, inFolder, again):
    # A caller may go on after a sample that could not be made; a stage of the same name is a stage of another sample.
    run = takeUp(labFolder if inFolder else None)

    def work(fails):
        run.stage("place", place)
        run.data["failed"] = fails
        if fails:
            raise ValueError("no sample")
        return len(O.bodies)

    with pytest.raises(ValueError, match="no sample"):
        run.result("one", lambda: work(True))
    assert run.result(again, lambda: (run.data.get("failed"), work(False))) == [None, 8]


def test_withoutAFolderNothingIsWritten(tmp_path, monkeypatch, everyTick):
    monkeypatch.chdir(tmp_path)
    run = LabRun("fall", PARAMETERS)
    assert not run.finished
    run.stage("place", place)
    run.tick()
    run.checkpoint()
    run.table("t", {"x": [1]})
    run.picture("p", lambda path: pytest.fail("no folder, no picture"))
    run.finish({"x": 1})
    assert run.summary == {"results": {"x": 1}}
    assert list(tmp_path.iterdir()) == []


# ---- the end


def finished(folder, viaResult=False):
    run = takeUp(folder)

    def work():
        run.stage("place", place)
        return len(O.bodies)

    run.result("place", work) if viaResult else work()
    run.table("rows", {"x [m]": [1, 2]})
    run.picture("rows", lambda path: path.write_bytes(b"picture"))
    run.finish({"bodies": 8, "missing": float("nan")})
    return run


@pytest.mark.parametrize("viaResult", [False, True])
def test_finishedRunKeepsOnlyItsResults(labFolder, viaResult):
    run = finished(labFolder, viaResult)
    assert sorted(contents(labFolder)) == ["pictures", "pictures/rows.png", "summary.json", "tables", "tables/rows.csv"]
    assert (labFolder / "tables" / "rows.csv").read_text() == "x [m]\n1\n2\n"
    summary = json.loads((labFolder / "summary.json").read_text())
    assert summary == run.summary
    assert (summary["state"], summary["test"], summary["parameters"]) == ("finished", "fall", PARAMETERS)
    assert summary["results"] == {"bodies": 8, "missing": None}
    assert {"capfrac", "yade", "python"} <= summary["versions"].keys()


@pytest.mark.parametrize("leftover", ["scenes/.4711-2.yade.gz", "scenes/7.yade.gz"])
def test_finishClearsWhatKilledProcessesLeft(labFolder, leftover):
    run = takeUp(labFolder)
    run.stage("place", place)
    (labFolder / leftover).write_text("half a scene")
    run.finish({})
    assert sorted(contents(labFolder)) == ["summary.json"]


def test_foreignFilesAmongTheScenesAreKept(labFolder):
    run = takeUp(labFolder)
    run.stage("place", place)
    (labFolder / "scenes" / "notes.txt").write_text("mine")
    run.finish({})
    assert contents(labFolder).keys() == {"scenes", "scenes/notes.txt", "summary.json"}


def test_finishedRunIsTakenAsItIs(labFolder):
    finished(labFolder)
    before = contents(labFolder)
    reports = []
    run = takeUp(labFolder, report=reports.append)
    assert run.finished and run.summary["results"]["bodies"] == 8 and reports == []
    assert contents(labFolder) == before


# ---- folders that cannot be used


def unfinished(folder):
    run = takeUp(folder)
    run.stage("place", place)
    run.table("rows", {"x [m]": [1, 2]})
    return run


@pytest.mark.parametrize("state", [unfinished, finished])
@pytest.mark.parametrize(
    "test, parameters",
    [("fall", {**PARAMETERS, "grains": {"rMin": 2e-3, "seed": 1}}), ("settle", PARAMETERS), ("fall", {})],
)
def test_runOfOtherParametersIsRefused(labFolder, state, test, parameters):
    state(labFolder)
    before = contents(labFolder)
    with pytest.raises(RunFolderError) as problem:
        LabRun(test, parameters, labFolder)
    assert (
        str(problem.value)
        == f"the run folder {labFolder} holds a run with other parameters; choose another folder, or --restart to"
        " discard that run"
    )
    assert contents(labFolder) == before


def test_foreignFolderIsRefused(tmp_path):
    (tmp_path / "thesis.tex").write_text("mine")
    for restart in (False, True):
        with pytest.raises(RunFolderError, match=r"holds other things \(thesis.tex\); choose an empty or new one"):
            LabRun("fall", PARAMETERS, tmp_path, restart)
    assert contents(tmp_path) == {"thesis.tex": b"mine"}


GOOD = {"data": {}, "done": [], "results": {}, "scene": None, "count": 0}


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"\xff\xfe",
        b"[1, 2]",
        b"null",
        b"3",
        b"{}",
        *(
            json.dumps({**GOOD, **bad}).encode()
            for bad in ({"data": 1}, {"done": 2}, {"results": []}, {"scene": 4}, {"count": "five"}, {"done": None})
        ),
    ],
)
def test_damagedStateIsRefused(labFolder, data):
    # Refused, not discarded: the results so far are the user's.
    unfinished(labFolder)
    (labFolder / "state.json").write_bytes(data)
    before = contents(labFolder)
    with pytest.raises(
        RunFolderError, match=rf"^{labFolder}/state.json cannot be read \(.+\); --restart discards the run$"
    ):
        takeUp(labFolder)
    assert contents(labFolder) == before
    assert takeUp(labFolder, restart=True).data == {}


def damage(path, how):
    if how == "missing":
        path.unlink()
    else:
        whole = path.read_bytes()
        path.write_bytes({"empty": b"", "no scene": b"\x1f\x8b\x08 no scene", "half": whole[: len(whole) // 2]}[how])


@pytest.mark.parametrize("how", ["missing", "empty", "no scene", "half"])
def test_damagedSceneIsRefused(labFolder, how):
    unfinished(labFolder)
    path = labFolder / json.loads((labFolder / "state.json").read_text())["scene"]
    damage(path, how)
    run = takeUp(labFolder)
    before = contents(labFolder)
    with pytest.raises(RunFolderError) as problem:
        run.stage("next", mustNotRun)
    assert str(problem.value).startswith(f"the checkpoint {path} cannot be read (")
    assert str(problem.value).endswith("): damaged, or of another version; --restart discards the run")
    assert contents(labFolder) == before and len(O.bodies) == 0
    run = takeUp(labFolder, restart=True)
    run.stage("place", place)
    assert len(O.bodies) == 8


@pytest.mark.parametrize("state", [unfinished, finished])
@pytest.mark.parametrize("parameters", [PARAMETERS, {}])
def test_restartDiscardsWhatARunWritesAndNothingElse(labFolder, state, parameters):
    state(labFolder)
    (labFolder / "notes.txt").write_text("mine")
    (labFolder / "tables" / "notes.txt").write_text("mine")
    run = takeUp(labFolder, parameters, restart=True)
    assert sorted(contents(labFolder)) == ["notes.txt", "summary.json", "tables", "tables/notes.txt"]
    summary = json.loads((labFolder / "summary.json").read_text())
    assert (summary["state"], summary["parameters"], summary.get("results")) == ("running", parameters, None)
    calls = []
    run.stage("place", lambda: calls.append(1))
    assert calls == [1] and run.data == {} and not run.finished


def test_folderThatCannotBeWritten(tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(RunFolderError, match="the run folder .*file/run cannot be written: Not a directory"):
        LabRun("fall", PARAMETERS, tmp_path / "file" / "run")


def test_failedCheckpointKeepsTheLastOne(labFolder, monkeypatch):
    run = unfinished(labFolder)
    run.data["rows"] = object()  # nothing that a file can hold
    with pytest.raises(TypeError):
        run.stage("bad", lambda: None)
    run = takeUp(labFolder)
    run.stage("place", mustNotRun)
    seen = []
    run.stage("next", lambda: seen.append(len(O.bodies)))
    assert seen == [8]
