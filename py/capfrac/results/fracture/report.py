# SPDX-License-Identifier: GPL-2.0-or-later
"""The fracture of a run folder: its numbers as files, and its pictures."""

import json
from pathlib import Path

from capfrac.errors import RunFolderError
from capfrac.io.csvfiles import writeColumns
from capfrac.plot import fracture as figures
from capfrac.results import snapshot
from capfrac.results.fracture import stress
from capfrac.results.fracture.measure import measureFracture, readEvents, tipAdvance

#: Files that :func:`reportRun` leaves in a run folder.
FILES = ("fracture.json", "fracture.csv", "fracture.png", "stress.png")


def reportRun(path, openingThreshold=0.01, write=None, pictures=True):
    """Measure the fracture of a run folder, fracture.json and fracture.csv, and draw it, fracture.png and stress.png;
    returns the short numbers.

    The moment is the breakthrough, or the end of the run where it did not come to that; ``fracture.json`` has all that
    were taken. ``write(name, writer)`` puts a file in its place (that of :class:`~capfrac.run.folder.RunFolder`);
    without ``pictures`` there are numbers alone. :class:`RunFolderError` for a folder without snapshots.
    """
    path = Path(path)
    shots = {
        p.stem: snapshot.load(p) for p in sorted((path / "snapshots").glob("*.npz")) if not p.stem.endswith("-stress")
    }
    moment = next((name for name in ("breakthrough", "end") if name in shots), None)
    if moment is None or "start" not in shots:
        raise RunFolderError(
            f"the folder {path} has no snapshots 'start' and 'end' of a run: not finished, or none of capfrac"
        )
    write = write or (lambda name, writer: writer(path / name))
    measured = {
        name: measureFracture(shots[name], shots["start"], openingThreshold)
        for name in ("initiation", "breakthrough", "rest", "end")
        if name in shots
    }
    text = json.dumps({name: numbers for name, (numbers, _) in measured.items()}, indent=2) + "\n"
    write("fracture.json", lambda target: target.write_text(text, encoding="utf-8"))
    numbers, found = measured[moment]
    advance = tipAdvance(found, readEvents(path / "events.csv"))
    write("fracture.csv", lambda target: writeColumns(target, advance))
    if pictures:
        _drawRun(path, shots, moment, found, advance, write)
    return {
        "moment": moment,
        **{key: value for key, value in numbers.items() if key not in ("brokenBonds", "branches")},
        "brokenBonds": len(numbers["brokenBonds"]),
    }


def _drawRun(path, shots, moment, found, advance, write):
    write("fracture.png", lambda target: figures.drawFracture(shots[moment], found, target, advance=advance))
    fields = [
        (shots[name], stress.loadStress(path / "snapshots" / f"{name}-stress.npz"))
        for name in ("start", "initiation", "breakthrough")
        if (path / "snapshots" / f"{name}-stress.npz").exists()
    ]
    fields.sort(key=lambda field: field[0].time)  # the first throat that opens may do so after the gas has come through
    if fields:
        write("stress.png", lambda target: figures.drawStress(fields[-2:], target))
