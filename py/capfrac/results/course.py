# SPDX-License-Identifier: GPL-2.0-or-later
"""The course of an injection to the very end of a run, by pressure levels and in time."""

import math

import numpy as np

from capfrac.results.fracture.passage import gasOfTheInlet


def levelsToTheEnd(gas, shot):
    """The levels of a ``GasInvasionEngine``, a dict of lists as of ``gas.levels()`` with ``finished`` (bool) besides,
    up to the present state.

    The level at which a run ended, because gas was through, time was over or the sample came apart, is not finished:
    its row, the last one, is the state of the snapshot ``shot``, taken just now.
    """
    from yade import O

    levels = gas.levels()
    levels["finished"] = [True] * len(levels["pressure"])
    if gas.rampDone:
        return levels
    moved = np.hypot(*shot.displacement.T) / shot.r
    contact = float(np.abs(shot.normalForce).mean()) if len(shot.normalForce) else 0.0
    resultant = float(np.mean([O.forces.f(int(i)).norm() for i in shot.ids]))
    row = {
        "pressure": shot.gasPressure,
        "gasSaturation": shot.gasSaturation,
        "brokenBonds": len(shot.brokenBonds),
        "displacement": float(np.max(moved[~shot.rattler], initial=0.0)),
        "displacementWithRattlers": float(moved.max()),
        "unbalanced": resultant / contact if contact > 0 else math.inf if resultant > 0 else 0.0,
        "atRest": False,
        "iteration": shot.iteration,
        "gasVolume": gas.volumes()["gas"],
        "finished": False,
    }
    return {name: values + [row[name]] for name, values in levels.items()}


def courseToTheEnd(gas, shot):
    """The history of a ``GasInvasionEngine``, a dict of lists as of ``gas.history()``, up to the state of the snapshot
    ``shot``, taken just now.
    """
    course = gas.history()
    if course["iteration"] and course["iteration"][-1] >= shot.iteration:
        return course
    connected = float(np.array(gas.cells()["gas"])[gasOfTheInlet(shot)].sum())
    row = {
        "time": shot.time,
        "iteration": shot.iteration,
        "gasPressure": shot.gasPressure,
        "connectedVolume": connected,
        "mass": gas.gasLedger()["injected"],
        "gasSaturation": shot.gasSaturation,
        "brokenBonds": len(shot.brokenBonds),
        "level": shot.level,
    }
    return {name: values + [row[name]] for name, values in course.items()}
