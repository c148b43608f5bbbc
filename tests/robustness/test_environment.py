# SPDX-License-Identifier: GPL-2.0-or-later
"""Neither the environment nor the files beside a script decide what capfrac computes, or whether it runs."""

import csv
import os
import subprocess
import sys
from pathlib import Path

import pytest
from yade import O, config
from yade.wrapper import InsertionSortCollider

import capfrac
from capfrac import environment, snapshot
from capfrac.errors import CapfracError
from capfrac.run.folder import readSummary
from capfrac.sweep import readSweep, runSweep
from processes import run

#: A run of a second: 30 grains up to the breakthrough.
SMALL = [
    "figure15",
    "-q",
    "-s",
    "grains.count=30",
    "-s",
    "inlet.pores=1",
    "-s",
    "ramp.start=150",
    "-s",
    "ramp.increment=5",
    "-s",
    "ramp.max=170",
    "-s",
    "output.fields=false",
    "-s",
    "output.pictures='none'",
]
#: What batch systems and users export.
EXPORTED = {
    "OMP_NUM_THREADS": "2,2",
    "OMP_DYNAMIC": "true",
    "OMP_PROC_BIND": "true",
    "OMP_PLACES": "cores",
    "OMP_THREAD_LIMIT": "3",
    "GOMP_CPU_AFFINITY": "0",
    "KMP_AFFINITY": "compact",
    "OPENBLAS_NUM_THREADS": "2",
    "MKL_NUM_THREADS": "2",
    "BLIS_NUM_THREADS": "2",
    "NUMEXPR_NUM_THREADS": "2",
}
THREADS = "import capfrac; capfrac.load_engines(); from yade import O; print('threads', O.numThreads)"
#: For a Python that knows where the packages are, and nothing of the launcher.
PLAIN = {**os.environ, "PYTHONPATH": os.pathsep.join(environment.places())}


def started(command, *arguments, variables=None, **options):
    """Status, output and errors of the command with these variables beside those of this process; None: a bare PATH."""
    chosen = {**os.environ, **variables} if variables else {"PATH": os.environ["PATH"]} if variables is None else None
    return run(lambda *a: command(*a, env=chosen, **options), *arguments)


def plain(code, **variables):
    done = subprocess.run(
        [sys.executable, "-c", code], env={**PLAIN, **variables}, capture_output=True, text=True, timeout=120
    )
    return done.stdout.strip(), done.stderr


# --- threads -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def whole(command, tmp_path_factory):
    """The small run in a bare environment."""
    folder = tmp_path_factory.mktemp("whole") / "run"
    status, _, errors = started(command, "inject", *SMALL, "-o", folder)
    assert (status, errors) == (0, "")
    return folder


def test_runIsTheSameWhateverIsExported(command, whole, tmp_path):
    status, _, errors = started(command, "inject", *SMALL, "-o", tmp_path / "run", variables=EXPORTED)
    assert (status, errors) == (0, "")
    for name in ("events.csv", "pc_saturation.csv", "history.csv"):
        assert (tmp_path / "run" / name).read_bytes() == (whole / name).read_bytes()
    ends = [snapshot.load(folder / "snapshots" / "end.npz") for folder in (whole, tmp_path / "run")]
    assert (ends[0].x == ends[1].x).all() and (ends[0].y == ends[1].y).all()
    assert readSummary(whole)["threads"] == readSummary(tmp_path / "run")["threads"] == 1


@pytest.mark.parametrize(
    "arguments, count",
    [
        (["python", "-c", THREADS], 1),
        (["yade", "-x", "-n", "s.py"], 1),
        (["yade", "-x", "-n", "-j2", "s.py"], 2),
        (["yade", "-x", "-n", "--threads=3", "s.py"], 3),
    ],
)
def test_userProgramsRunOnOneThreadUnlessAsked(command, tmp_path, arguments, count):
    (tmp_path / "s.py").write_text(THREADS)
    status, output, errors = started(command, *arguments, variables=EXPORTED, cwd=tmp_path)
    assert status == 0, errors
    assert f"threads {count}" in output


def test_threadsThatAreAskedForAreOnRecord(command, tmp_path):
    # Two grains, so that threads which wait for each other take no time.
    status, _, errors = started(command, "lab", "contacts", "-q", "--threads", "2", "-o", tmp_path / "two")
    assert (status, errors) == (0, "")
    status, _, errors = started(command, "lab", "contacts", "-q", "-o", tmp_path / "one", variables=EXPORTED)
    assert (status, errors) == (0, "")
    assert readSummary(tmp_path / "two")["threads"] == 2 and readSummary(tmp_path / "one")["threads"] == 1


def test_mostThreadsOfARunStayOnRecord(monkeypatch):
    monkeypatch.setattr(environment, "threadsInUse", lambda: 1)
    assert environment.most({}) == 1 and environment.most({"threads": 4}) == 4
    monkeypatch.setattr(environment, "threadsInUse", lambda: 2)
    assert environment.most({"threads": 1}) == 2


def test_pointsOfASweepSayTheirThreads(tmp_path, monkeypatch):
    path = tmp_path / "sweep.toml"
    path.write_text(
        "[sweep]\ncase = 'figure15'\n[set]\ngrains.count = 30\ninlet.pores = 1\nramp.start = 165.0\nramp.max = 170.0\n"
        "output = {fields = false, pictures = 'none'}\n[[grid]]\ngrains.seed = [1]\n"
    )
    for name, value in EXPORTED.items():
        monkeypatch.setenv(name, value)
    runSweep(readSweep(path), tmp_path / "sweep")
    with open(tmp_path / "sweep" / "table.csv", newline="") as stream:
        (line,) = csv.DictReader(stream)
    assert line["threads [-]"] == "1"
    assert os.environ["OMP_NUM_THREADS"] == EXPORTED["OMP_NUM_THREADS"]  # what else the user starts is not our affair


@pytest.mark.parametrize("threads", [0, -1, 1.5, "2", True, 5000])
def test_numbersOfThreadsThatAreNoneAreRefused(threads):
    with pytest.raises(CapfracError, match="threads = .*, allowed: a whole number from 1 to 1024"):
        capfrac.load_engines(threads=threads)


@pytest.mark.parametrize("threads", ["0", "1.5", "two", "5000"])
def test_commandRefusesThemToo(command, tmp_path, threads):
    status, output, errors = started(
        command, "inject", *SMALL, "--threads", threads, "-o", tmp_path / "run", variables=EXPORTED
    )
    assert (
        status in (1, 2)
        and output == ""
        and "threads" in errors
        and "Traceback" not in errors
        and not (tmp_path / "run").exists()
    )


def test_threadsCannotChangeOnceYadeIsLoaded():
    assert O.numThreads == 1
    capfrac.load_engines(threads=1)
    with pytest.raises(
        CapfracError, match="threads = 2, but YADE, .* was loaded in this process for 1 and cannot change"
    ):
        capfrac.load_engines(threads=2)


def test_pythonOfTheUsers():
    """``import capfrac`` without the launcher: what is loaded after it obeys, what was loaded before is told of."""
    assert (
        plain(THREADS + "; import os; print(os.environ['OMP_NUM_THREADS'])", OMP_NUM_THREADS="2")[0] == "threads 1\n2"
    )
    asked = THREADS.replace("load_engines()", "load_engines(threads=2)")
    assert plain(asked, OMP_NUM_THREADS="3")[0] == "threads 2"
    early = "import ctypes; ctypes.CDLL('libgomp.so.1'); "
    output, errors = plain(early + THREADS, OMP_NUM_THREADS="2")
    assert output == "" and "YADE runs on 2 threads that nobody asked for" in errors
    assert plain(early + asked, OMP_NUM_THREADS="2")[0] == "threads 2"
    output, errors = plain("from yade import O; import capfrac; print('here')", OMP_NUM_THREADS="2")
    assert output.endswith("here") and "RuntimeWarning: YADE was loaded for 2 threads before capfrac" in errors


def test_sceneOfMoreThreadsRunsOnTheseHere():
    O.engines = [InsertionSortCollider()]
    O.engines[0].ompThreads = 4  # as YADE saves it where it has run on four
    environment.adoptScene()
    assert O.engines[0].ompThreads == -1


# --- modules -------------------------------------------------------------------------------------


@pytest.fixture
def shadows(tmp_path):
    """A folder with a script, its helper, and files that have the names of modules that capfrac and YADE import."""
    for name in ("queue", "numpy", "random", "enum", "yade", "matplotlib"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('the wrong module')\n")
    (tmp_path / "helper.py").write_text("answer = 42\n")
    (tmp_path / "script.py").write_text(
        "import helper\n" + THREADS.replace("'threads'", "helper.answer") + "\nimport queue; queue.Queue\n"
    )
    return tmp_path


@pytest.mark.parametrize(
    "arguments",
    [
        ["cases"],
        ["inject", *SMALL, "-o", "run"],
        ["sweep", "regime_map", "--list", "-n", "1"],
        ["python", "-c", "import helper; " + THREADS],
        ["python", "-m", "helper"],
        ["python", "script.py"],
        ["yade", "-x", "-n", "script.py"],
    ],
)
def test_filesInTheWorkingFolderAreNotTakenForModules(command, shadows, arguments):
    status, _, errors = started(command, *arguments, cwd=shadows)
    assert status == 0 and "wrong module" not in errors, errors


@pytest.mark.parametrize("program", [["python"], ["yade", "-x", "-n"]])
def test_scriptsFindTheModulesBesideThem(command, shadows, program):
    elsewhere = shadows / "elsewhere"
    elsewhere.mkdir()
    status, output, errors = started(command, *program, shadows / "script.py", cwd=elsewhere)
    assert status == 0, errors
    assert "42 1" in output


@pytest.mark.parametrize(
    "arguments", [["inject", *SMALL, "-o", "run"], ["python", "script.py"], ["yade", "-x", "-n", "script.py"]]
)
@pytest.mark.parametrize("place", ["{}", ":"])  # an empty entry is the working folder
def test_foldersOfPythonpathComeLast(command, shadows, arguments, place):
    status, _, errors = started(command, *arguments, variables={"PYTHONPATH": place.format(shadows)}, cwd=shadows)
    assert status == 0 and "wrong module" not in errors, errors


def test_pythonpathIsSearched(command, shadows, tmp_path):
    (tmp_path / "more").mkdir()
    for arguments in (["python", "-c", "import helper; print(helper.answer)"], ["yade", "-x", "-n", "ask.py"]):
        (tmp_path / "more" / "ask.py").write_text("import helper; print(helper.answer)\n")
        status, output, errors = started(
            command, *arguments, variables={"PYTHONPATH": str(shadows)}, cwd=tmp_path / "more"
        )
        assert status == 0 and output.rstrip().endswith("42"), errors


@pytest.mark.parametrize(
    "arguments, more",
    [
        (["inject", *SMALL, "-o", "run"], {"PYTHONWARNINGS": "error"}),
        (["python", "script.py"], {}),
        (["yade", "-x", "-n", "script.py"], {}),
    ],
)
def test_variablesForOtherProgramsDoNotStopIt(command, shadows, arguments, more):
    variables = {"PYTHONHOME": "/nowhere", "YADE_PREFIX": "/nowhere", "PYTHONSAFEPATH": "1", **more}
    status, _, errors = started(command, *arguments, variables=variables, cwd=shadows)
    assert status == 0, errors


def test_packagesOfTheUserDoNotReplaceThoseOfTheSystem(command, shadows, tmp_path):
    site = tmp_path / "base" / "lib" / f"python{sys.version_info[0]}.{sys.version_info[1]}" / "site-packages"
    site.mkdir(parents=True)
    (shadows / "numpy.py").rename(site / "numpy.py")
    status, _, errors = started(
        command, "inject", *SMALL, "-o", tmp_path / "run", variables={"PYTHONUSERBASE": str(tmp_path / "base")}
    )
    assert (status, errors) == (0, "")


def test_aHomeIsNotNeeded(command, tmp_path):
    for arguments in (["inject", *SMALL, "-o", tmp_path / "run"], ["python", "-c", THREADS]):
        status, _, errors = started(command, *arguments)  # nothing but a PATH
        assert (status, errors) == (0, ""), errors


def test_pointsOfASweepFindTheirModules(command, shadows):
    (shadows / "sweep.toml").write_text(
        "[sweep]\ncase = 'figure15'\n[set]\ngrains.count = 30\ninlet.pores = 1\nramp.start = 165.0\n"
        "ramp.max = 170.0\noutput = {fields = false, pictures = 'none'}\n[[grid]]\ngrains.seed = [1]\n"
    )
    status, output, errors = started(
        command, "sweep", "sweep.toml", "-o", "sweep", variables={"PYTHONPATH": str(shadows)}, cwd=shadows
    )
    assert status == 0 and "1 of 1 points finished" in output, errors


def test_programOfYadeIsThatOfTheEngines(command, tmp_path):
    (tmp_path / "s.py").write_text("from yade import config; print('prefix', config.prefix)\n")
    status, output, _ = started(command, "yade", "-x", "-n", "s.py", cwd=tmp_path)
    assert status == 0 and f"prefix {config.prefix}" in output
    assert Path(config.prefix).is_dir()
