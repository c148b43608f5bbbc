# SPDX-License-Identifier: GPL-2.0-or-later
"""What the fracture of an injection looks like in numbers, from the snapshots and the log of a run.

:func:`measureFracture` measures one snapshot, :func:`tipAdvance` follows the tips through the events,
:func:`capfrac.results.fracture.report.reportRun` does both for a run folder and draws the pictures. Lengths are in
metres, angles in degrees from the horizontal (axial, in [0, 180)), thickness 1 m.
"""

import math

import numpy as np

from capfrac.errors import CaseError, RunFolderError
from capfrac.io.csvfiles import readRows
from capfrac.results.fracture import graph, inlet, orientation, throats

#: Distances from the inlet at which branches are counted, in mean grain diameters [-].
DISTANCES = (2.0, 4.0, 6.0, 8.0, 10.0, 12.0)


def measureFracture(now, start, openingThreshold=0.01, shortest=graph.SHORTEST):
    """The fracture of a snapshot as ``(numbers, Fracture)``; the numbers are a dict fit for JSON.

    ``branchCount``: fracture branches (see :mod:`capfrac.results.fracture.graph`); ``fingers``: branches with more
    bridges than cracked throats; ``branches``: each with tip, length, angle and share of cracked throats;
    ``branchesAt``: how many fracture branches pass a distance in mean grain diameters from the inlet;
    ``crackedThroats``, ``stretchedThroats`` (opened, but not cracked), ``rigidThroats``: with gas on both sides;
    ``parts``: into which the cracked ones fall; apertures (growth of the gap since the start) of the cracked ones;
    ``growth [m^2]``: of the box since the start; ``brokenBonds``: place and the angle of the crack across each;
    ``orientation``: mean direction, resultant and vector T of the ``extent`` (directions of the cracked throats as seen
    from the inlet, weight: square of the distance), of the ``branches`` (lines from root to tip, weight: length of the
    line), and of the ``apertures`` (direction of the crack at each cracked throat, across the line of its grains,
    weight: aperture). Errors as in :func:`graph.findFracture`.
    """
    found = graph.findFracture(now, start, openingThreshold, shortest)
    inCrack = found.inGas & found.cracked
    aperture = found.aperture[inCrack]
    boxes = [(s.box[1] - s.box[0]) * (s.box[3] - s.box[2]) for s in (now, start)]
    numbers = {
        "capillaryPressure [Pa]": now.capillaryPressure,
        "time [s]": now.time,
        "branchCount": len(found.fractureBranches),
        "fingers": len(found.branches) - len(found.fractureBranches),
        "shortestBranch [m]": shortest * found.diameter,
        "meanDiameter [m]": found.diameter,
        "branchesAt": {f"{d:g}": found.branchesAt(d * found.diameter) for d in DISTANCES},
        "branches": [
            {
                "tip [m]": list(map(float, b.tip)),
                "length [m]": b.length,
                "angle [degrees]": b.angle,
                "openedShare": b.openedShare if b.openedThroats + b.rigidThroats else None,
                "fracture": b.isFracture,
            }
            for b in found.branches
        ],
        "crackedThroats": int(inCrack.sum()),
        "stretchedThroats": int((found.inGas & found.opened & ~found.cracked).sum()),
        "rigidThroats": int((found.inGas & ~found.opened & ~_within(now, start)).sum()),
        "parts": graph.connectedParts(found, now),
        "largestAperture [m]": float(aperture.max()) if len(aperture) else 0.0,
        "meanAperture [m]": float(aperture.mean()) if len(aperture) else 0.0,
        "growth [m^2]": boxes[0] - boxes[1],
        "brokenBonds": _brokenBonds(now),
        "orientation": {
            "extent": _orientation(*_extent(now, found)),
            "branches": _orientation(*_branchLines(found)),
            "apertures": _orientation(crackAngles(now, now.throatIds[inCrack]), np.maximum(aperture, 0)),
        },
    }
    return numbers, found


def _within(now, start):
    return throats.gapsOf(start, now.throatIds) > throats.mergeGap(start)


def crackAngles(shot, pairs):
    """(m,) directions of the crack between pairs of bodies [degrees] in [0, 180): across the line that joins them."""
    ends = shot.endsOf(pairs)
    along = ends[:, 1] - ends[:, 0]
    return (np.degrees(np.arctan2(along[:, 1], along[:, 0])) + 90) % 180


def _extent(shot, found):
    """Where the cracked throats with gas lie as seen from the middle of the inlet: directions [degrees] and squared
    distances [m^2].
    """
    middle = inlet.inletMiddle(shot)
    if middle is None:
        return np.array([]), np.array([])
    away = shot.endsOf(shot.throatIds[found.inGas & found.cracked]).mean(axis=1) - middle
    return np.degrees(np.arctan2(away[:, 1], away[:, 0])) % 180, (away**2).sum(axis=1)


def _branchLines(found):
    """Directions [degrees] and lengths [m] of the lines from root to tip of the fracture branches."""
    lines = np.array([b.path[-1] - b.path[0] for b in found.fractureBranches]).reshape(-1, 2)
    return np.degrees(np.arctan2(lines[:, 1], lines[:, 0])) % 180, np.hypot(lines[:, 0], lines[:, 1])


def _orientation(angles, weights):
    if not np.sum(weights) > 0:
        return {"mean [degrees]": None, "resultant": None, "vector": None}
    vector = orientation.orientationVector(angles, weights)
    mean, length = orientation.axialMean(vector)
    return {"mean [degrees]": mean, "resultant": length, "vector": [vector.real, vector.imag]}


def _brokenBonds(shot):
    ends = shot.endsOf(shot.brokenBonds)
    known = np.all(np.isfinite(ends), axis=(1, 2))
    return [
        {
            "bodies": list(map(int, pair)),
            "x [m]": float(middle[0]),
            "y [m]": float(middle[1]),
            "angle [degrees]": float(angle),
        }
        for pair, middle, angle in zip(
            shot.brokenBonds[known], ends[known].mean(axis=1), crackAngles(shot, shot.brokenBonds[known])
        )
    ]


def tipAdvance(found, events):
    """How the tips moved: a dict of columns, one row an event that lies on a fracture branch, in the order of time.

    ``events``: dict of the columns ``time [s]``, ``capillaryPressure [Pa]``, ``x [m]``, ``y [m]``, ``kind`` of
    events.csv. An event belongs to the branch whose path it is nearest to, within two mean diameters. ``tipDistance
    [m]``: how far from the inlet, along the gas, that tip had come; ``tipSpeed [m/s]``: its advance over the time since
    its last one. Time is that of the simulation, in which ``invasionInterval`` sets how fast gas takes pores: speeds
    compare tips of one run and are no speeds of nature.
    """
    rows = {
        name: []
        for name in (
            "event",
            "branch",
            "time [s]",
            "capillaryPressure [Pa]",
            "x [m]",
            "y [m]",
            "kind",
            "tipDistance [m]",
            "tipSpeed [m/s]",
        )
    }
    reached = {}
    for k, (time, pressure, x, y, kind) in enumerate(
        zip(*(events[name] for name in ("time [s]", "capillaryPressure [Pa]", "x [m]", "y [m]", "kind")))
    ):
        nearest = [(float(np.hypot(*(b.path - (x, y)).T).min()), n) for n, b in enumerate(found.fractureBranches)]
        if not nearest or min(nearest)[0] > 2 * found.diameter:
            continue
        n = min(nearest)[1]
        branch = found.fractureBranches[n]
        distance = float(branch.distance[np.argmin(np.hypot(*(branch.path - (x, y)).T))])
        before, last = reached.get(n, (float(branch.distance[0]), None))
        speed = (
            (distance - before) / (time - last) if last is not None and time > last and distance > before else math.nan
        )
        if distance > before or last is None:
            reached[n] = (max(distance, before), time)
        for name, value in zip(rows, (k + 1, n + 1, time, pressure, x, y, kind, max(distance, before), speed)):
            rows[name].append(value)
    return rows


def readEvents(path, integers=()):
    """events.csv of a run folder as columns of numbers (and texts), with these ``integers`` besides;
    :class:`RunFolderError` when it cannot be read.
    """
    try:
        rows = readRows(path)
        numeric = ("time [s]", "capillaryPressure [Pa]", "x [m]", "y [m]")
        return {
            **{name: [float(row[name]) for row in rows] for name in numeric},
            "kind": [row["kind"] for row in rows],
            **{name: [int(row[name]) for row in rows] for name in integers},
        }
    except (OSError, KeyError, ValueError, TypeError) as problem:
        raise RunFolderError(f"{path} cannot be read as the events of a run: {problem}") from None


def orientationOfRuns(summaries, kind="extent"):
    """Whether the fractures of several runs have a direction in common: a dict.

    ``summaries``: those of runs of one case with different seeds (``summary["fracture"]``); each is one draw, with its
    orientation vector T of ``kind`` ('extent', 'branches' or 'apertures'). ``mean [degrees]`` and ``resultant`` of the
    mean T; ``p``: of no preferred direction, ``pVertical``: of the same against the vertical (see
    :func:`orientation.rotationTest`); ``runs`` with a fracture. :class:`CaseError` where there is none.
    """
    if kind not in ("extent", "branches", "apertures"):
        raise CaseError(f"kind = {kind!r}, allowed: 'extent', 'branches', 'apertures'")
    vectors = [
        complex(*s["fracture"]["orientation"][kind]["vector"])
        for s in summaries
        if s["fracture"]["orientation"][kind]["vector"]
    ]
    if not vectors:
        raise CaseError("summaries: no run with a fracture, allowed: at least one")
    mean, resultant = orientation.axialMean(complex(np.mean(vectors)))
    return {
        "runs": len(vectors),
        "mean [degrees]": mean,
        "resultant": resultant,
        "p": orientation.rotationTest(vectors),
        "pVertical": orientation.rotationTest(vectors, direction=90.0),
    }
