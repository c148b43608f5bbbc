"""Run the points of a sweep, several at a time, each in a process of its own.

:func:`runPoint` is all that happens to one point; it takes and returns plain data, so any executor of the kind of
:mod:`concurrent.futures` can carry it out: here threads that wait for processes on this machine
(:class:`LocalProcesses`), elsewhere those of a cluster with a shared file system. What has been done is read from the
folders, never from memory: finished points are skipped, unfinished ones are taken up at their checkpoint.
"""

import importlib.util
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent import futures
from pathlib import Path

import capfrac

#: Seconds that an interrupted point has to write its summary.
_GRACE = 60
#: Characters of an error that are kept.
_ERROR_LENGTH = 4000


class LocalProcesses(futures.ThreadPoolExecutor):
    """Runs as many points at a time as it has workers; :meth:`interrupt` ends them as Ctrl-C ends a run."""

    def __init__(self, workers):
        super().__init__(max_workers=workers, thread_name_prefix="point")
        self._lock, self._processes, self._stopped = threading.Lock(), set(), False

    def submit(self, function, job):
        """As in :mod:`concurrent.futures`; the function gets ``watch``, which must be told of processes that it starts."""
        return super().submit(function, job, watch=self._watch)

    def _watch(self, process, running):
        with self._lock:
            (self._processes.add if running else self._processes.discard)(process)
            if running and self._stopped:
                process.send_signal(signal.SIGINT)

    def interrupt(self):
        """Ask all running points to stop; they leave their folders to be taken up. Returns when they are gone."""
        with self._lock:
            self._stopped = True
            running = list(self._processes)
            for process in running:
                process.send_signal(signal.SIGINT)
        end = time.monotonic() + _GRACE
        for process in running:
            try:
                process.wait(max(0.1, end - time.monotonic()))
            except subprocess.TimeoutExpired:
                process.kill()


def _environment():
    """This process's environment, with capfrac and YADE to be found as they are here, and one thread for each point."""
    places = [str(Path(capfrac.__file__).parents[1])]
    yade = importlib.util.find_spec("yade")
    places += [str(Path(yade.origin).parents[1])] if yade and yade.origin else []
    places += [os.environ["PYTHONPATH"]] if os.environ.get("PYTHONPATH") else []
    return {**os.environ, "OMP_NUM_THREADS": "1", "PYTHONPATH": os.pathsep.join(places), "PYTHONDONTWRITEBYTECODE": "1"}


def runPoint(job, watch=lambda process, running: None):
    """Run one point: ``job`` has ``name``, ``folder`` (the run folder), ``key`` (of the run: see
    :func:`capfrac.runfolder.caseKey`) and ``arguments`` (case and overrides); returns a dict.

    ``status`` is the exit status of its process (0: finished, 130: interrupted, < 0: ended by that signal), ``error`` what it
    said where it did not finish, ``seconds`` the time it took.
    """
    start = time.monotonic()
    # In a session of its own, Ctrl-C in a terminal reaches the sweep alone, which then asks its points to stop.
    process = subprocess.Popen([sys.executable, "-c", "from capfrac.sweep.worker import main; main()", str(os.getpid()),
                                job["folder"], job["key"], *job["arguments"]],
                               env=_environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)
    watch(process, True)
    try:
        errors = process.communicate()[1].decode(errors="replace").strip()
    finally:
        watch(process, False)
    status = process.returncode
    if status < 0 and not errors:
        errors = f"ended by signal {-status} ({signal.Signals(-status).name})"
    return {"name": job["name"], "status": status, "error": errors[-_ERROR_LENGTH:] if status else "", "seconds": time.monotonic() - start}


def runAll(jobs, executor, done):
    """Run jobs in their order; ``done(outcome)`` is called here after each. Ctrl-C stops them all, in good order, and goes on to the caller."""
    waiting = {executor.submit(runPoint, job) for job in jobs}
    try:
        while waiting:
            ready, waiting = futures.wait(waiting, return_when=futures.FIRST_COMPLETED)
            for future in ready:
                done(future.result())
    except BaseException:
        for future in waiting:
            future.cancel()
        if hasattr(executor, "interrupt"):
            executor.interrupt()
        raise
    finally:
        executor.shutdown(wait=True, cancel_futures=True)
