"""The folder of a run: what is in it, how it is kept usable at any moment, how a run is taken up again.

    summary.json          versions, parameters, seed, results, state of the run
    events.csv            every pore that gas entered: when, where, through which throat, at which pressure
    pc_saturation.csv     every pressure level: capillary pressure, saturation, bonds, displacement
    snapshots/            the states that pictures are drawn from (.npz) and the pictures (.png)
    fields/               fields for ParaView: open the .pvd files
    checkpoint.yade.gz    the scene of the last checkpoint; only while the run is not finished

Files are written beside their place and moved there whole, so an interrupted run never leaves half a file.
"""

import csv
import hashlib
import json
import math
import os
from pathlib import Path

from capfrac.errors import RunFolderError

STATES = ("running", "interrupted", "finished")


def _plain(value):
    """`value` for JSON: NaN and infinity, which JSON has no word for, become null."""
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def caseKey(case):
    """A short text that is the same for cases with the same parameters; titles and places do not count."""
    parameters = {section: entries for section, entries in case.items() if section not in ("case", "output")}
    return hashlib.sha256(json.dumps(_plain(parameters), sort_keys=True).encode()).hexdigest()[:16]


class RunFolder:
    """A run folder, opened for a case. Raises :class:`RunFolderError` when it cannot be used for it."""

    def __init__(self, path, case, restart=False):
        self.path = Path(path)
        self.key = caseKey(case)
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            probe = self.path / f".probe-{os.getpid()}"
            probe.touch()
            probe.unlink()
        except OSError as problem:
            raise RunFolderError(f"the run folder {self.path} cannot be written: {problem.strerror}") from None
        self.summary = self._readSummary()
        foreign = [entry.name for entry in self.path.iterdir()] if not self.summary else []
        if foreign:
            raise RunFolderError(f"the folder {self.path} holds other things ({', '.join(sorted(foreign)[:3])}); choose an empty or new one")
        if restart:
            self.clear()
        elif self.summary and self.summary.get("caseKey") != self.key:
            raise RunFolderError(f"the run folder {self.path} holds a run with other parameters; choose another folder, or --restart to discard that run")

    def _readSummary(self):
        try:
            return json.loads((self.path / "summary.json").read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (OSError, ValueError) as problem:
            raise RunFolderError(f"{self.path / 'summary.json'} cannot be read: {problem}") from None

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
        for name in ("summary.json", "events.csv", "pc_saturation.csv", "curve.png", "checkpoint.yade.gz"):
            (self.path / name).unlink(missing_ok=True)
        for name in ("snapshots", "fields"):
            folder = self.path / name
            if folder.is_dir():
                for entry in folder.iterdir():
                    entry.unlink()
                folder.rmdir()
        self.summary = {}

    def writeWhole(self, name, write):
        """Let ``write(path)`` write a file aside and move it to its place at once."""
        target = self.path / name
        aside = target.with_name(f".{os.getpid()}-{target.name}")
        try:
            write(aside)
            os.replace(aside, target)
        except OSError as problem:
            aside.unlink(missing_ok=True)
            raise RunFolderError(f"{target} cannot be written: {problem.strerror}") from None

    def writeSummary(self, **entries):
        """Update summary.json with these entries."""
        self.summary.update(_plain(entries))
        self.summary["caseKey"] = self.key
        text = json.dumps(self.summary, indent=2) + "\n"
        self.writeWhole("summary.json", lambda path: path.write_text(text, encoding="utf-8"))

    def saveCheckpoint(self):
        """Save YADE's current scene as the checkpoint."""
        from yade import O

        self.writeWhole("checkpoint.yade.gz", lambda path: O.save(str(path), quiet=True))

    def writeTable(self, name, columns):
        """Write a CSV of equally long columns: dict of header (with unit) -> list."""

        def write(path):
            with open(path, "w", newline="", encoding="utf-8") as stream:
                writer = csv.writer(stream)
                writer.writerow(columns)
                writer.writerows(zip(*columns.values()))

        self.writeWhole(name, write)

    def writeLogs(self, gas):
        """Write events.csv and pc_saturation.csv from the engine's logs."""
        e, levels = gas.events(), gas.levels()
        self.writeTable("events.csv", {
            "event": list(range(1, len(e["time"]) + 1)), "time [s]": e["time"], "iteration": e["iteration"], "level": e["level"],
            "capillaryPressure [Pa]": [p - gas.waterPressure for p in e["gasPressure"]],
            "throat": ["-".join(map(str, ids)) for ids in e["throat"]], "pore": ["-".join(map(str, ids)) for ids in e["pore"]],
            "x [m]": e["x"], "y [m]": e["y"], "entryPressure [Pa]": e["entryPressure"], "gap [m]": e["gap"], "gapGrowth [m]": e["gapGrowth"],
            "bondBroken": [int(b) for b in e["bondBroken"]], "kind": ["opened" if o else "rigid" for o in e["opened"]],
            "cells": e["cells"], "volume [m^3]": e["volume"],
        })
        self.writeTable("pc_saturation.csv", {
            "level": list(range(1, len(levels["pressure"]) + 1)), "capillaryPressure [Pa]": [p - gas.waterPressure for p in levels["pressure"]],
            "gasSaturation": levels["gasSaturation"], "gasVolume [m^3]": levels["gasVolume"], "brokenBonds": levels["brokenBonds"],
            "displacement [r]": levels["displacement"], "displacementWithRattlers [r]": levels["displacementWithRattlers"],
            "unbalanced": levels["unbalanced"], "atRest": [int(rest) for rest in levels["atRest"]], "iteration": levels["iteration"],
        })
