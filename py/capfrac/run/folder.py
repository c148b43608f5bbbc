# SPDX-License-Identifier: GPL-2.0-or-later
"""The folder of a run: what is in it, how it is kept usable at any moment, how a run is taken up again.

    summary.json          versions, parameters, seed, results, state of the run
    events.csv            every pore that gas entered: when, where, through which throat, at which pressure
    pc_saturation.csv     every pressure level: capillary pressure, saturation, bonds, displacement; the last may be
                          unfinished when the run ends
    history.csv           the course in time: gas pressure, volume and mass of the gas, saturation, broken bonds
    fracture.json         branches, tips, apertures, directions, broken bonds at initiation, breakthrough and end
    fracture.csv          how the tips advanced, event by event
    snapshots/            the states that pictures are drawn from (.npz), the stresses of the grains, and the pictures
                          (.png)
    fields/               fields for ParaView: open the .pvd files
    checkpoint.yade.gz    the scene of the last checkpoint; only while the run is not finished

Files are written beside their place and moved there whole, so an interrupted run never leaves half a file.
"""

import hashlib
import json
import math
import os
import re
from pathlib import Path

from capfrac.errors import RunFolderError
from capfrac.io.csvfiles import writeColumns
from capfrac.io.namedfiles import byContent, changedFiles
from capfrac.io.wholefiles import putInPlace, refuseForeign

STATES = ("running", "interrupted", "failed", "finished")
#: Names of files that are being written.
_ASIDE = re.compile(r"\.(probe-\d+|\d+-.+)")


def _plain(value):
    """`value` for JSON: NaN and infinity, which JSON has no word for, become null."""
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def caseKey(case, files):
    """A short text that is the same for cases with the same parameters; titles and places do not count.

    Of the output only the pressures of snapshots do: the ramp stops at each, which shifts the levels after it.
    ``files``: those that the case names (see :func:`capfrac.io.namedfiles.digests`); their content counts, not their
    name.
    """
    parameters = {section: entries for section, entries in case.items() if section not in ("case", "output")}
    if case.get("output", {}).get("pressures"):
        parameters["output"] = {"pressures": sorted(set(map(float, case["output"]["pressures"])))}
    return hashlib.sha256(json.dumps(_plain(byContent(parameters, files)), sort_keys=True).encode()).hexdigest()[:16]


def difference(summary, case, files):
    """In which way the run that a ``summary`` tells of is not one of the case and its files; empty where it is."""
    recorded = summary.get("files")
    if summary.get("caseKey") == caseKey(case, files):
        return ""
    if files and not isinstance(recorded, dict):
        names = " and ".join(file["file"] for file in files.values())
        return f"a run of a former version of capfrac, which did not record what was in {names}"
    changed = " and ".join(changedFiles(files, recorded or {}))
    if changed and summary.get("caseKey") == caseKey(case, recorded):
        return f"a run of an earlier content of {changed}, changed since"
    return "a run with other parameters" + (f" and another content of {changed}" if changed else "")


def readSummary(folder):
    """summary.json of a run folder (a path) as a dict; {} where there is none that can be read."""
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return summary if isinstance(summary, dict) else {}


class RunFolder:
    """A run folder, opened for a case. Raises :class:`RunFolderError` when it cannot be used for it.

    ``files``: those that the case names (see :func:`capfrac.io.namedfiles.digests`).
    """

    #: What a run writes: files, folders, and endings of the files in those folders.
    FILES = (
        "events.csv",
        "pc_saturation.csv",
        "curve.png",
        "history.csv",
        "history.png",
        "checkpoint.yade.gz",
        "fracture.json",
        "fracture.csv",
        "fracture.png",
        "stress.png",
    )
    FOLDERS = ("snapshots", "fields")
    SUFFIXES = (".npz", ".png", ".vtu", ".pvd")

    def __init__(self, path, case, restart=False, files=None):
        self.path, self.files = Path(path), files or {}
        self.key = caseKey(case, self.files)
        self.made = not self.path.exists()
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            probe = self.path / f".probe-{os.getpid()}"
            probe.touch()
            probe.unlink()
        except OSError as problem:
            raise RunFolderError(f"the run folder {self.path} cannot be written: {problem.strerror}") from None
        self.summary = self._readSummary()
        # A run that was killed may leave a file that it was about to put in its place (see writeWhole).
        foreign = (
            [entry.name for entry in self.path.iterdir() if not _ASIDE.fullmatch(entry.name)]
            if not self.summary
            else []
        )
        refuseForeign(self.path, foreign)
        if restart:
            self.clear()
        elif self.summary and (held := difference(self.summary, case, self.files)):
            raise RunFolderError(
                f"the run folder {self.path} holds {held}; choose another folder, or --restart to discard that run"
            )

    def _readSummary(self):
        path = self.path / "summary.json"
        try:
            summary = json.loads(path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (OSError, ValueError) as problem:
            raise RunFolderError(f"{path} cannot be read: {problem}") from None
        if not (isinstance(summary, dict) and "caseKey" in summary):
            raise RunFolderError(f"{path} is not that of a run of capfrac; choose an empty folder or a new one")
        return summary

    @property
    def finished(self):
        return self.summary.get("state") == "finished"

    @property
    def checkpoint(self):
        """Path of the checkpoint, whether or not there is one."""
        return self.path / "checkpoint.yade.gz"

    def sub(self, name):
        """A subfolder, made when missing."""
        folder = self.path / name
        folder.mkdir(exist_ok=True)
        return folder

    def clear(self):
        """Remove what a run writes, and nothing else."""
        written = [entry for entry in self.path.iterdir() if entry.name in self.FILES or _ASIDE.fullmatch(entry.name)]
        folders = [folder for folder in (self.path / name for name in self.FOLDERS) if folder.is_dir()]
        for folder in folders:
            written += [entry for entry in folder.iterdir() if entry.suffix in self.SUFFIXES]
        try:
            # The summary last: without it the rest would be foreign.
            for entry in [*written, self.path / "summary.json"]:
                entry.unlink(missing_ok=True)
            for folder in folders:
                if not any(folder.iterdir()):
                    folder.rmdir()
        except OSError as problem:
            raise RunFolderError(f"the run in {self.path} cannot be discarded: {problem}") from None
        self.summary = {}

    def discard(self):
        """Take back what a run left that ended before there was anything to take up."""
        self.clear()
        if self.made and not any(self.path.iterdir()):
            self.path.rmdir()

    def writeWhole(self, name, write):
        """Let ``write(path)`` write a file aside and move it to its place at once."""
        target = self.path / name
        putInPlace(target.with_name(f".{os.getpid()}-{target.name}"), target, write)

    def warn(self, text):
        """Keep a warning, once, in the list ``warnings`` of the summary; written with the next :meth:`writeSummary`."""
        if text not in self.summary.setdefault("warnings", []):
            self.summary["warnings"].append(text)

    def writeSummary(self, **entries):
        """Update summary.json with these entries."""
        self.summary.setdefault("warnings", [])
        self.summary.update(_plain(entries))
        self.summary.update(caseKey=self.key, files=self.files)
        text = json.dumps(self.summary, indent=2) + "\n"
        self.writeWhole("summary.json", lambda path: path.write_text(text, encoding="utf-8"))

    def writeTable(self, name, columns):
        """Write a CSV of equally long columns: dict of header (with unit) -> list."""
        self.writeWhole(name, lambda path: writeColumns(path, columns))
