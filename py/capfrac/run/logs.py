# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run folder keeps of the engine's logs: events, levels, the course in time; columns and units."""


def writeLogs(folder, gas, levels=None, history=None):
    """Write events.csv, pc_saturation.csv and history.csv into a run folder from the logs of the engine ``gas``.

    ``levels`` and ``history``: those of a run that has ended (see :mod:`capfrac.results.course`); default: the
    engine's.
    """
    e, levels, history = gas.events(), levels or gas.levels(), history or gas.history()
    folder.writeTable(
        "events.csv",
        {
            "event": list(range(1, len(e["time"]) + 1)),
            "time [s]": e["time"],
            "iteration": e["iteration"],
            "level": e["level"],
            "capillaryPressure [Pa]": [p - gas.waterPressure for p in e["gasPressure"]],
            "throat": ["-".join(map(str, ids)) for ids in e["throat"]],
            "pore": ["-".join(map(str, ids)) for ids in e["pore"]],
            "x [m]": e["x"],
            "y [m]": e["y"],
            "entryPressure [Pa]": e["entryPressure"],
            "gap [m]": e["gap"],
            "gapGrowth [m]": e["gapGrowth"],
            "bondBroken": [int(b) for b in e["bondBroken"]],
            "kind": ["opened" if o else "rigid" for o in e["opened"]],
            "cells": e["cells"],
            "volume [m^3]": e["volume"],
        },
    )
    folder.writeTable(
        "pc_saturation.csv",
        {
            "level": list(range(1, len(levels["pressure"]) + 1)),
            "capillaryPressure [Pa]": [p - gas.waterPressure for p in levels["pressure"]],
            "gasSaturation": levels["gasSaturation"],
            "gasVolume [m^3]": levels["gasVolume"],
            "brokenBonds": levels["brokenBonds"],
            "displacement [r]": levels["displacement"],
            "displacementWithRattlers [r]": levels["displacementWithRattlers"],
            "unbalanced": levels["unbalanced"],
            "atRest": [int(rest) for rest in levels["atRest"]],
            "iteration": levels["iteration"],
            "finished": [int(done) for done in levels.get("finished", [True] * len(levels["pressure"]))],
        },
    )
    folder.writeTable(
        "history.csv",
        {
            "time [s]": history["time"],
            "iteration": history["iteration"],
            "capillaryPressure [Pa]": [p - gas.waterPressure for p in history["gasPressure"]],
            "connectedVolume [m^3]": history["connectedVolume"],
            "mass [kg]": history["mass"],
            "gasSaturation": history["gasSaturation"],
            "brokenBonds": history["brokenBonds"],
            "level": history["level"],
        },
    )
