# SPDX-License-Identifier: GPL-2.0-or-later
"""The folder of a sweep, usable at any moment:

    table.csv        every point of the sweep: parameters, mode, pressures, cost, or why it failed
    sweep.json       name and title of the sweep, versions
    points/NAME/     the run folder of each point, as of ``capfrac inject``
    failed/NAME.txt  what a point said that failed
    figures/         figures drawn from the table

What has been done is what lies in the folder: there is no list that could disagree with it.
"""

import fcntl
import json
from pathlib import Path

import capfrac
from capfrac.errors import RunFolderError
from capfrac.io.wholefiles import putInPlace, refuseForeign
from capfrac.run.folder import difference, readSummary
from capfrac.sweep import table

#: Before the key of the case that failed, in the file that tells why.
_KEY = "case key: "


class SweepFolder:
    """A sweep's folder, opened and locked. Raises :class:`RunFolderError` when it cannot be used for the sweep."""

    def __init__(self, path, sweep):
        self.path, self.sweep = Path(path), sweep
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            # Without sweep.json there may be points, run one by one by the commands of `capfrac sweep --list`, or what
            # a sweep has begun with that is just starting, or was killed there.
            own = (".lock", ".stop", ".sweep.json", "points", "failed")
            foreign = [entry.name for entry in self.path.iterdir() if entry.name not in own]
            if not (self.path / "sweep.json").exists():
                refuseForeign(self.path, foreign)
            self._lock = open(self.path / ".lock", "w")  # open as long as this object lives
            self._takeLock()  # first: what is made then is seen by others as the folder of a sweep at work
            for name in ("points", "failed"):
                (self.path / name).mkdir(exist_ok=True)
        except OSError as problem:
            raise RunFolderError(f"the folder {self.path} cannot be written: {problem.strerror}") from None
        self._rows = {}
        others = [(point, held) for point in sweep.points if (held := self.difference(point))]
        if others:
            more = f" ({len(others)} of {len(sweep.points)} points are so)" if len(others) > 1 else ""
            raise RunFolderError(
                f"{self.run(others[0][0])} holds {others[0][1]}{more}; choose another folder for the "
                "sweep, or remove what is in this one"
            )
        head = {
            "name": sweep.name,
            "title": sweep.title,
            "description": sweep.description,
            "capfrac": capfrac.__version__,
        }
        self._whole("sweep.json", lambda path: path.write_text(json.dumps(head, indent=2) + "\n", encoding="utf-8"))

    def _takeLock(self):
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise RunFolderError(
                f"another sweep is at work in {self.path}; wait for it, or choose another folder"
            ) from None

    def close(self):
        """Let others at the folder."""
        fcntl.flock(self._lock, fcntl.LOCK_UN)  # processes that were forked meanwhile hold the file open, too
        self._lock.close()

    @property
    def stop(self):
        """Path of the file that has the points stop (see :mod:`capfrac.sweep.execution`)."""
        return self.path / ".stop"

    def run(self, point):
        """Run folder of a point."""
        return self.path / "points" / point.name

    def difference(self, point):
        """In which way the run in a point's folder is not the point's; empty where it is, or where there is none."""
        summary = readSummary(self.run(point))
        return difference(summary, point.case, point.files) if summary else ""

    def _error(self, point):
        return self.path / "failed" / f"{point.name}.txt"

    def state(self, point):
        """'finished', 'failed', 'begun' (to be taken up) or 'open'."""
        state = readSummary(self.run(point)).get("state", "")
        if state == "finished":
            return "finished"
        return "failed" if self._failure(point) is not None else "begun" if state else "open"

    def _failure(self, point):
        """Why the point failed; None where it did not, or with other parameters or other contents of files."""
        try:
            error, mark, key = self._error(point).read_text(encoding="utf-8").rpartition(_KEY)
        except OSError:
            return None
        return error if mark and key.strip() == point.key else None

    def fail(self, point, error):
        """Record that a point failed, and why."""
        text = f"{error}\n{_KEY}{point.key}\n"
        self._whole(f"failed/{point.name}.txt", lambda path: path.write_text(text, encoding="utf-8"))

    def forgive(self, point):
        """Forget that a point failed."""
        self._error(point).unlink(missing_ok=True)

    def writeTable(self, points):
        """Write table.csv with these points, in their order; returns its path."""
        self._whole("table.csv", lambda path: table.write(path, [self.row(point) for point in points]))
        return self.path / "table.csv"

    def row(self, point):
        """The line of a point in the table, as of now."""
        if point.name not in self._rows:
            state = self.state(point)
            error = self._failure(point) if state == "failed" else ""
            line = table.row(point, self.sweep.columns, state, readSummary(self.run(point)), self.run(point), error)
            if state != "finished":
                return line
            self._rows[point.name] = line  # it stays as it is
        return self._rows[point.name]

    def _whole(self, name, write):
        target = self.path / name
        putInPlace(target.with_name(f".{target.name}"), target, write)
