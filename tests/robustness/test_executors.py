# SPDX-License-Identifier: GPL-2.0-or-later
"""Whatever runs the points of a sweep: executors of this machine, of a cluster, some that fail, none to be shut down.
"""

import csv
import os
import signal
import subprocess
import sys
import threading
from concurrent import futures

import pytest

from capfrac import environment
from capfrac.errors import CapfracError, CaseError
from capfrac.run.folder import readSummary
from capfrac.sweep import execution, readSweep, runSweep
from processes import waitFor

#: Points of a second each: 30 grains, one level.
SMALL = """
[sweep]
title = "Small"
case = "figure15"
[set]
grains.count = 30
inlet.pores = 1
ramp = {start = 165.0, increment = 5.0, max = 170.0}
output = {fields = false, pictures = "none", pressures = []}
[[grid]]
grains.seed = [1, 2]
"""
COST = ("cpuSeconds [s]",)


@pytest.fixture
def small(tmp_path):
    (tmp_path / "small.toml").write_text(SMALL)
    return readSweep(tmp_path / "small.toml")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The rows of the small sweep, made by the processes of this machine."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "small.toml").write_text(SMALL)
    runSweep(readSweep(folder / "small.toml"), folder / "sweep")
    return rows(folder / "sweep")


def rows(folder):
    with open(folder / "table.csv", newline="") as stream:
        return [{name: value for name, value in line.items() if name not in COST} for line in csv.DictReader(stream)]


class Threads:
    """The least that can be called an executor: a thread for each call, no shutdown, no context."""

    def submit(self, function, argument):
        future = futures.Future()

        def work():
            try:
                future.set_result(function(argument))
            except BaseException as problem:
                future.set_exception(problem)

        threading.Thread(target=work).start()
        return future


class Failing:
    """Futures end without their point having been run; ``ends``: what happens to the future of each point, in turn."""

    def __init__(self, *ends):
        self.ends = list(ends)

    def submit(self, function, argument):
        future = futures.Future()
        self.ends.pop(0)(future)
        return future


def doubled(number):
    return 2 * number


@pytest.mark.parametrize("kind", [futures.ThreadPoolExecutor, futures.ProcessPoolExecutor])
def test_executorsOfTheCallerStayOpen(small, whole, tmp_path, kind):
    told = []
    with kind(1) as executor:
        result = runSweep(small, tmp_path / "sweep", executor=executor, report=told.append)
        assert executor.submit(doubled, 21).result(timeout=30) == 42
        assert runSweep(small, tmp_path / "sweep", executor=executor)["finished"] == 2  # nothing left to run
    assert (result["finished"], result["failed"]) == (2, 0) and rows(tmp_path / "sweep") == whole
    assert told[0].endswith(f"2 to run, by {kind.__name__}")


def test_submitIsAllThatAnExecutorNeeds(small, whole, tmp_path):
    assert runSweep(small, tmp_path / "sweep", executor=Threads())["finished"] == 2
    assert rows(tmp_path / "sweep") == whole


#: A sweep on Dask's workers, which start with another working folder; the scheduler is in the same process.
DASK = """
import sys
from distributed import Client, LocalCluster
from capfrac.sweep import readSweep, runSweep

if __name__ == "__main__":
    one = LocalCluster(n_workers=1, threads_per_worker=2, processes=True, dashboard_address=None)
    with one as cluster, Client(cluster) as client:
        client.run(__import__("os").chdir, "/")
        executor = client if sys.argv[1] == "client" else client.get_executor()
        result = runSweep(readSweep("small.toml"), "sweep", executor=executor)
        print("finished", result["finished"], "then", executor.submit(abs, -42).result())
"""


@pytest.mark.parametrize("how", ["executor", "client"])
def test_daskRunsPoints(small, whole, tmp_path, how):
    pytest.importorskip("distributed")
    (tmp_path / "run.py").write_text(DASK)
    variables = {**os.environ, "PYTHONPATH": os.pathsep.join(environment.places())}
    done = subprocess.run(
        [sys.executable, "run.py", how], cwd=tmp_path, env=variables, capture_output=True, text=True, timeout=150
    )
    assert "finished 2 then 42" in done.stdout, done.stderr
    assert rows(tmp_path / "sweep") == whole


def test_pointsWhoseFutureRaisesFailAndTheRestGoesOn(small, tmp_path):
    executor = Failing(
        lambda future: future.set_exception(RuntimeError("the node is gone")),
        lambda future: future.set_exception(OSError("no such thing")),
    )
    result = runSweep(small, tmp_path / "sweep", executor=executor)
    assert (result["finished"], result["failed"]) == (0, 2)
    assert [line["error"] for line in rows(tmp_path / "sweep")] == [
        "RuntimeError: the node is gone",
        "OSError: no such thing",
    ]


def test_cancelledPointsStayOpen(small, whole, tmp_path):
    told = []
    result = runSweep(
        small, tmp_path / "sweep", executor=Failing(futures.Future.cancel, futures.Future.cancel), report=told.append
    )
    assert (result["finished"], result["failed"], result["points"]) == (0, 0, 2)
    assert (
        told[1:] == ["seed1: cancelled", "seed2: cancelled"]
        and [line["state"] for line in rows(tmp_path / "sweep")] == ["open"] * 2
    )
    assert runSweep(small, tmp_path / "sweep")["finished"] == 2 and rows(tmp_path / "sweep") == whole


def test_aBrokenExecutorFailsNoPoint(small, tmp_path):
    with pytest.raises(CapfracError, match="the executor broke .*a worker died.*; the same call goes on"):
        runSweep(
            small,
            tmp_path / "sweep",
            executor=Failing(*[lambda future: future.set_exception(futures.BrokenExecutor("a worker died"))] * 2),
        )
    assert [line["state"] for line in rows(tmp_path / "sweep")] == ["open"] * 2
    closed = futures.ThreadPoolExecutor(1)
    closed.shutdown()
    with pytest.raises(CapfracError, match="the executor takes no point .*shutdown"):
        runSweep(small, tmp_path / "sweep", executor=closed)
    assert [line["state"] for line in rows(tmp_path / "sweep")] == ["open"] * 2 and not (
        tmp_path / "sweep" / ".stop"
    ).exists()


@pytest.mark.parametrize("executor", [5, "dask", object()])
def test_whatIsNoExecutorIsRefused(small, tmp_path, executor):
    with pytest.raises(CaseError, match="executor = .*, allowed: None, or one with submit"):
        runSweep(small, tmp_path / "sweep", executor=executor)
    assert not (tmp_path / "sweep").exists()


#: A sweep of points that take minutes, two of them at a time, by an executor of the caller's.
LONG = """
import sys
from concurrent import futures
from capfrac.sweep import readSweep, runSweep

if __name__ == "__main__":
    kind = sys.argv[1]
    executor = getattr(futures, kind)(2)
    try:
        runSweep(readSweep("long.toml"), "sweep", executor=executor, report=lambda text: print(text, flush=True))
    except KeyboardInterrupt:
        print("interrupted", flush=True)
        executor.shutdown(cancel_futures=True)
        sys.exit(130)
"""


@pytest.mark.parametrize("whom", ["one", "all"])
@pytest.mark.parametrize("kind", ["ThreadPoolExecutor", "ProcessPoolExecutor"])
def test_interruptedPointsOfAnyExecutorStop(tmp_path, kind, whom):
    text = SMALL.replace("seed = [1, 2]", "seed = [1, 2, 3, 4]").replace(
        "ramp = {start = 165.0, increment = 5.0, max = 170.0}", "ramp = {start = 150.0, increment = 0.01, max = 170.0}"
    )
    (tmp_path / "long.toml").write_text(text)
    (tmp_path / "run.py").write_text(LONG)
    variables = {**os.environ, "PYTHONPATH": os.pathsep.join(environment.places())}
    process = subprocess.Popen(
        [sys.executable, "run.py", kind],
        cwd=tmp_path,
        env=variables,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    points = [tmp_path / "sweep" / "points" / f"seed{seed}" for seed in (1, 2, 3, 4)]
    waitFor(process, lambda: all((point / "checkpoint.yade.gz").exists() for point in points[:2]))
    # Ctrl-C in a terminal reaches all of the group
    (os.killpg if whom == "all" else os.kill)(process.pid, signal.SIGINT)
    output, errors = process.communicate(timeout=100)
    assert process.returncode == 130 and "interrupted" in output, errors
    assert [readSummary(point).get("state") for point in points] == ["interrupted", "interrupted", None, None]
    assert not (tmp_path / "sweep" / ".stop").exists() and not list((tmp_path / "sweep" / "failed").iterdir())


def test_aPointThatFindsTheStopDoesNotBegin(tmp_path):
    (tmp_path / "stop").touch()
    outcome = execution.runPoint(
        {
            "name": "a",
            "place": str(tmp_path),
            "folder": str(tmp_path / "run"),
            "key": "",
            "threads": 1,
            "arguments": ["figure15"],
            "stop": str(tmp_path / "stop"),
        }
    )
    assert outcome["status"] == 130 and not (tmp_path / "run").exists() and outcome["seconds"] < 1


def test_aStopThatWasLeftBehindStopsNothing(small, tmp_path):
    runSweep(small, tmp_path / "sweep", points=1)
    (tmp_path / "sweep" / ".stop").touch()  # of a sweep that was killed as it stopped
    assert runSweep(small, tmp_path / "sweep")["finished"] == 2
