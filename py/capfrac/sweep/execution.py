# SPDX-License-Identifier: GPL-2.0-or-later
"""Run the points of a sweep, several at a time, each in a process of its own.

:func:`runPoint` is all that happens to one point; it takes and returns plain data, so anything with the ``submit`` of
:mod:`concurrent.futures` can carry it out: threads that wait for processes on this machine, Dask's ``Client`` or its
``get_executor()`` on a cluster with a shared file system. What has been done is read from the folders, never from
memory: finished points are skipped, unfinished ones are taken up at their checkpoint. The way to stop is a file, too,
which each point looks for: it reaches points wherever they run, and asks nothing of the executor.
"""

import asyncio
import os
import queue
import signal
import subprocess
import time
from concurrent import futures
from pathlib import Path

from capfrac import environment
from capfrac.errors import CapfracError, CaseError

#: Seconds that an interrupted point has to write its summary, and between two looks whether it shall stop.
_GRACE, _LOOK = 60, 0.2
#: Characters of an error that are kept.
_ERROR_LENGTH = 4000


def runPoint(job):
    """Run one point; returns a dict.

    ``job`` has ``name``, ``place`` (the working folder), ``folder`` (the run folder), ``key`` (of the run: see
    :func:`capfrac.run.folder.caseKey`), ``threads``, ``arguments`` (case and overrides) and ``stop``, the path of a
    file: where it exists the point does not begin, or leaves its folder to be taken up.

    ``status`` is the exit status of its process (0: finished, 130: interrupted, < 0: ended by that signal), ``error``
    what it said where it did not finish, ``seconds`` the time it took.
    """
    start = time.monotonic()
    status, errors = 130, ""
    if not os.path.exists(job["stop"]):
        process = _start(job)
        try:
            errors = _watch(process, job["stop"]).decode(errors="replace").strip()
        except BaseException:  # Ctrl-C in a pool of processes, which reaches them all
            _interrupt(process)
            raise
        status = process.returncode
    if status < 0 and not errors:
        errors = f"ended by signal {-status} ({signal.Signals(-status).name})"
    return {
        "name": job["name"],
        "status": status,
        "error": errors[-_ERROR_LENGTH:] if status else "",
        "seconds": time.monotonic() - start,
    }


def _start(job):
    variables = dict(os.environ)
    environment.settle(variables, job["threads"])
    command = environment.pythonOf(
        "from capfrac.sweep.worker import main; main()",
        str(os.getpid()),
        job["folder"],
        job["key"],
        str(job["threads"]),
        *job["arguments"],
    )
    # In a session of its own, Ctrl-C in a terminal reaches the sweep alone, which then asks its points to stop.
    return subprocess.Popen(
        command,
        cwd=job["place"],
        env=variables,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )


def _watch(process, stop):
    """What the process said on stderr when it has ended, by itself or because it was to stop."""
    while True:
        try:
            return process.communicate(timeout=_LOOK)[1]
        except subprocess.TimeoutExpired:
            if os.path.exists(stop):
                return _interrupt(process)


def _interrupt(process):
    """End a process as Ctrl-C does, so that it leaves its folder usable; returns what it said on stderr."""
    for _ in range(_GRACE // 10):
        process.send_signal(signal.SIGINT)
        try:
            return process.communicate(timeout=10)[1]
        except subprocess.TimeoutExpired:
            continue
    process.kill()
    return process.communicate()[1]


def runAll(jobs, executor, stop, done):
    """Run jobs (without their ``stop``) in their order; ``done(outcome)`` is called here after each.

    ``executor``: has ``submit(function, argument)``, which returns a future with ``result``, ``cancel`` and
    ``add_done_callback``; it is used, not shut down. ``outcome`` is that of :func:`runPoint`; where the executor raises
    instead, ``status`` is None and ``error`` names the exception, and where the future was cancelled ``error`` is None.
    ``stop``: path of the file that stops the points. Ctrl-C stops them all, in good order, and goes on to the caller.
    """
    stop = Path(stop)
    stop.unlink(missing_ok=True)  # of a sweep that was killed as it stopped
    begun, waiting, ended = time.monotonic(), {}, queue.SimpleQueue()
    try:
        for job in jobs:
            waiting[job["name"]] = future = _submit(executor, {**job, "stop": str(stop)})
            future.add_done_callback(lambda _, name=job["name"]: ended.put(name))
        while waiting:
            name = ended.get()
            done(_outcome(name, waiting.pop(name), time.monotonic() - begun))
    except BaseException:
        _stopAll(waiting, ended, stop)
        raise


def _submit(executor, job):
    try:
        return executor.submit(runPoint, job)
    except RuntimeError as problem:  # broken, or shut down
        raise CapfracError(
            f"the executor takes no point ({type(problem).__name__}: {problem}); the same call goes on with the sweep"
        ) from problem


def _outcome(name, future, seconds):
    failed = {"name": name, "status": None, "seconds": seconds}
    try:
        return future.result()
    except (futures.CancelledError, asyncio.CancelledError):
        return {**failed, "error": None}
    except futures.BrokenExecutor as problem:  # it takes all points with it, which did nothing wrong
        raise CapfracError(
            f"the executor broke ({type(problem).__name__}: {problem}); the same call goes on with the sweep"
        ) from problem
    except Exception as problem:
        return {**failed, "error": f"{type(problem).__name__}: {problem}"[-_ERROR_LENGTH:]}


def _stopAll(waiting, ended, stop):
    """Have the points of these futures stop; returns when they have."""
    try:
        stop.touch()
        end = time.monotonic() + _GRACE + 10
        while waiting and time.monotonic() < end:
            waiting.pop(ended.get(timeout=max(0.1, end - time.monotonic())), None)
    except (OSError, queue.Empty):
        pass
    # Those that wait for a free place, perhaps for days. Where one begins nevertheless, the file stops it.
    for future in waiting.values():
        future.cancel()
    if not waiting:
        stop.unlink(missing_ok=True)


def checkExecutor(executor):
    """Raise :class:`CaseError` where ``executor`` is nothing that points can be given to."""
    if not callable(getattr(executor, "submit", None)):
        raise CaseError(f"executor = {executor!r}, allowed: None, or one with submit(), as those of concurrent.futures")
