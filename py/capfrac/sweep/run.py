# SPDX-License-Identifier: GPL-2.0-or-later
"""Carry out a sweep: :func:`runSweep`."""

import os
import time
from concurrent import futures

from capfrac import environment
from capfrac.errors import CaseError
from capfrac.sweep import execution
from capfrac.sweep.folder import SweepFolder
from capfrac.values import asInt, shown


def runSweep(sweep, folder, processes=1, points=None, retry=False, report=lambda text: None, executor=None, threads=1):
    """Run the points of a :class:`~capfrac.sweep.sweepfile.Sweep` that are not finished; returns a dict.

    ``folder``: see :mod:`capfrac.sweep.folder`; ``processes`` at a time (>= 1); ``points``: only the first so many;
    ``retry``: points that failed earlier, too. ``threads`` of each point: see :mod:`capfrac.environment`.
    ``report(text)`` gets a line for each point. ``executor`` carries the points out in place of ``processes`` on this
    machine, and stays open (see :func:`capfrac.sweep.execution.runAll`). Interrupted (Ctrl-C), the folder is left
    usable and the interruption goes on to the caller; the same call then goes on. The result: counts of ``finished``,
    ``failed`` and all ``points`` (the rest are points whose future was cancelled), ``failures`` (pairs of a point's
    name and what it said), ``table`` (its path), ``seconds`` of this call. Raises :class:`CapfracError`
    where the executor breaks, :class:`CaseError` for numbers of points, processes or threads that are none.
    """
    environment.checkThreads(threads)
    for name, value in (("processes", processes), ("points", points)):
        if not (name == "points" and value is None) and not (asInt(value) or 0) >= 1:
            raise CaseError(f"{name} = {shown(value)}, allowed: a whole number >= 1")
    if executor is not None:
        execution.checkExecutor(executor)
    place = SweepFolder(folder, sweep)
    try:
        return _run(sweep, place, processes, sweep.points[:points], retry, report, executor, threads)
    finally:
        place.close()


def _run(sweep, place, processes, points, retry, report, executor, threads):
    states = {point.name: place.state(point) for point in points}
    for point in points:
        if retry and states[point.name] == "failed":
            place.forgive(point)
            states[point.name] = "open"
    todo = [point for point in points if states[point.name] in ("open", "begun")]
    counts = {state: list(states.values()).count(state) for state in ("finished", "failed")}
    byName, start = {point.name: point for point in todo}, time.monotonic()
    how = f"{processes} at a time" if executor is None else f"by {type(executor).__name__}"
    report(f"{len(points)} points: {counts['finished']} finished, {counts['failed']} failed, {len(todo)} to run, {how}")
    place.writeTable(points)

    def done(outcome):
        point = byName[outcome["name"]]
        state = place.state(point)
        if state != "finished" and outcome["status"] is None and outcome["error"] is None:
            report(f"{point.name}: cancelled")
            return
        if state != "finished":
            place.fail(point, outcome["error"] or f"ended with status {outcome['status']} and without a result")
            state = "failed"
        else:
            place.forgive(point)  # what failed was a run of other parameters
        counts[state] += 1
        place.writeTable(points)
        ended = counts["finished"] + counts["failed"]
        remaining = (time.monotonic() - start) / (ended - len(points) + len(todo)) * (len(points) - ended)
        report(
            f"{ended}/{len(points)} {point.name}: {_told(place, point, state)}, {outcome['seconds']:.0f} s;"
            f" {asTime(remaining)} to go"
        )

    # Elsewhere in a cluster the working folder may be another.
    jobs = [
        {
            "name": point.name,
            "place": os.getcwd(),
            "folder": str(place.run(point)),
            "key": point.key,
            "threads": threads,
            "arguments": list(point.arguments),
        }
        for point in todo
    ]
    stop = place.stop.absolute()
    if executor is not None:
        execution.runAll(jobs, executor, stop, done)
    elif jobs:
        with futures.ThreadPoolExecutor(processes, "point") as workers:
            execution.runAll(jobs, workers, stop, done)
    failures = [(point.name, place.row(point)["error"]) for point in points if place.state(point) == "failed"]
    return {
        **counts,
        "failures": failures,
        "points": len(points),
        "table": place.path / "table.csv",
        "seconds": time.monotonic() - start,
    }


def _told(place, point, state):
    line = place.row(point)
    if state == "failed":
        return f"FAILED ({line['error'][:120]})"
    pressure = line["breakthroughPressure [Pa]"]
    if pressure is None:
        return f"{line['mode']}, ended at {line['endPressure [Pa]']:.4g} Pa"
    bound = " or below" if "breakthroughPressure" in line["upperBounds"] else ""
    return f"{line['mode']}, gas through at {pressure:.4g} Pa{bound}"


def asTime(seconds):
    """Seconds as people say them."""
    minutes = round(seconds / 60)
    return (
        f"{seconds:.0f} s"
        if seconds < 90
        else f"{minutes} min"
        if minutes < 90
        else f"{minutes // 60} h {minutes % 60:02d} min"
    )
