"""The course of an injection to the very end of a run, by pressure levels and in time, and its picture."""

import math

import numpy as np

from capfrac.figures import COLOURS, newFigure, saveFigure
from capfrac.fracture.passage import gasOfTheInlet


def levelsToTheEnd(gas, shot):
    """The levels of a ``GasInvasionEngine``, a dict of lists as of ``gas.levels()`` with ``finished`` (bool) besides, up to the present state.

    The level at which a run ended, because gas was through, time was over or the sample came apart, is not finished: its row, the last
    one, is the state of the snapshot ``shot``, taken just now.
    """
    from yade import O

    levels = gas.levels()
    levels["finished"] = [True] * len(levels["pressure"])
    if gas.rampDone:
        return levels
    moved = np.hypot(*shot.displacement.T) / shot.r
    contact = float(np.abs(shot.normalForce).mean()) if len(shot.normalForce) else 0.0
    resultant = float(np.mean([O.forces.f(int(i)).norm() for i in shot.ids]))
    row = {"pressure": shot.gasPressure, "gasSaturation": shot.gasSaturation, "brokenBonds": len(shot.brokenBonds),
           "displacement": float(np.max(moved[~shot.rattler], initial=0.0)), "displacementWithRattlers": float(moved.max()),
           "unbalanced": resultant / contact if contact > 0 else math.inf if resultant > 0 else 0.0, "atRest": False, "iteration": shot.iteration,
           "gasVolume": gas.volumes()["gas"], "finished": False}
    return {name: values + [row[name]] for name, values in levels.items()}


def courseToTheEnd(gas, shot):
    """The history of a ``GasInvasionEngine``, a dict of lists as of ``gas.history()``, up to the state of the snapshot ``shot``, taken just now."""
    course = gas.history()
    if course["iteration"] and course["iteration"][-1] >= shot.iteration:
        return course
    connected = float(np.array(gas.cells()["gas"])[gasOfTheInlet(shot)].sum())
    row = {"time": shot.time, "iteration": shot.iteration, "gasPressure": shot.gasPressure, "connectedVolume": connected, "mass": gas.gasLedger()["injected"],
           "gasSaturation": shot.gasSaturation, "brokenBonds": len(shot.brokenBonds), "level": shot.level}
    return {name: values + [row[name]] for name, values in course.items()}


def drawHistory(history, path, events=None, breakthroughIter=-1, startTime=0.0, waterPressure=0.0, title=None):
    """Draw P_c over time, with the pores that the gas entered, and below it saturation and broken bonds.

    ``history`` and ``events`` are the dicts of ``gas.history()`` and ``gas.events()``; ``breakthroughIter`` is the
    engine's, -1 where the gas did not reach the outlet. Times count from ``startTime`` [s]; ``waterPressure`` [Pa] is
    taken off the pressures. The first throat that had opened and the breakthrough are marked. Without a row of the
    history the panels stay empty.
    """
    time = np.array(history["time"], dtype=float) - startTime
    pressure = np.array(history["gasPressure"], dtype=float) - waterPressure
    second, unit = _prefix(np.max(time, initial=0.0), "s")
    pascal, pressureUnit = _prefix(np.max(pressure, initial=0.0), "Pa")
    with newFigure((6.4, 4.2)) as figure:
        grid = {"left": 0.115, "right": 0.885, "bottom": 0.115, "top": 0.915 if title else 0.97, "hspace": 0.12, "height_ratios": (2, 1)}
        above, below = figure.subplots(2, 1, sharex=True, gridspec_kw=grid)
        # Through the entries, too: between two rows of the history the pressure may jump.
        entries = events if events is not None else {"time": [], "gasPressure": []}
        at = np.concatenate([time, np.array(entries["time"], dtype=float) - startTime])
        values = np.concatenate([pressure, np.array(entries["gasPressure"], dtype=float) - waterPressure])
        order = np.argsort(at, kind="stable")
        above.plot(at[order] / second, values[order] / pascal, color=COLOURS["gas"], linewidth=1.3, zorder=2)
        if events is not None and len(events["time"]):
            at = (np.array(events["time"]) - startTime) / second
            entered = (np.array(events["gasPressure"]) - waterPressure) / pascal
            opened = np.array(events["opened"], dtype=bool)
            above.plot(at[~opened], entered[~opened], ".", color=COLOURS["dot"], markersize=4, zorder=3, label="pore entered, rigid throat")
            above.plot(at[opened], entered[opened], ".", color=COLOURS["broken"], markersize=4, zorder=3, label="pore entered, opened throat")
            if opened.any():
                first = int(np.flatnonzero(opened)[0])
                above.plot(at[first], entered[first], "^", color=COLOURS["broken"], markersize=8, markerfacecolor="none", zorder=4, label="first opened throat")
            if breakthroughIter in events["iteration"]:
                last = at[events["iteration"].index(breakthroughIter)]
                for axes in (above, below):
                    axes.axvline(last, color="0.45", linewidth=0.9, linestyle=(0, (4, 3)), zorder=1, label="breakthrough" if axes is above else None)
            above.legend(fontsize=7, frameon=False, loc="best")
        above.set(ylabel=f"capillary pressure $P_c$ [{pressureUnit}]")
        below.plot(time / second, history["gasSaturation"], color=COLOURS["dot"], linewidth=1.3)
        below.set(xlabel=f"time since the start of the injection [{unit}]", ylabel="gas saturation $S_g$")
        below.set_ylim(bottom=0)
        bonds = below.twinx()
        bonds.plot(time / second, history["brokenBonds"], color=COLOURS["broken"], linewidth=1.1, drawstyle="steps-post")
        bonds.set_ylabel("broken bonds", color=COLOURS["broken"])
        bonds.set_ylim(0, 1.05 * max(1, *history["brokenBonds"], 1))
        below.yaxis.label.set_color(COLOURS["dot"])
        for axes in figure.axes:
            axes.tick_params(labelsize=8)
            axes.spines["top"].set_visible(False)
        above.spines["right"].set_visible(False)
        if title:
            figure.suptitle(title, fontsize=10, y=0.985)
        saveFigure(figure, path)


def _prefix(highest, unit):
    """The power of a thousand that makes `highest` a number from 1 to 1000, and the unit with its prefix."""
    if not highest > 0:
        return 1.0, unit
    power = min(max(3 * math.floor(math.log10(highest) / 3 + 1e-12), -9), 6)
    return 10.0**power, {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M"}[power] + unit
