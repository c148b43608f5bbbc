# SPDX-License-Identifier: GPL-2.0-or-later
"""Cycles of the gas pressure: drainage, imbibition, drainage again; the loop of P_c and S_g, and the gas that stays.

The engine does what a pressure does; this drives the pressure, level by level, each until the grains are at rest::

    gas = injection.startInjection(start=100, increment=0, max=0, pores=3, imbibition=True, snapOff=True)
    table = cycles.pressureCycle(gas, [("drainage", 215), ("imbibition", 0), ("second drainage", 215)], increment=2)
    print(cycles.measure(table))
"""

import numpy as np

from capfrac.errors import CaseError, SceneError
from capfrac.plot.cycles import cellMap, drawCycle
from capfrac.scene import sediment
from capfrac.values import isNotNegative, isPositive, shown

__all__ = ["COLUMNS", "cellMap", "drawCycle", "measure", "pressureCycle"]

#: Columns of the table of :func:`pressureCycle` that are numbers.
COLUMNS = ("capillaryPressure", "gasSaturation", "trappedGas", "iteration")


def pressureCycle(gas, stages, increment, progress=None):
    """Take the gas pressure through ``stages`` and return what there is at the end of each level: a dict of lists.

    ``gas``: a prepared ``GasInvasionEngine``. ``stages``: pairs (name, P_c in Pa at its end); the pressure goes there
    from where it is in steps of ``increment`` [Pa] > 0, up or down, or of a third entry of the stage. Stages that
    follow each other may have one name. Columns: ``stage``, ``capillaryPressure`` [Pa], ``gasSaturation`` [-],
    ``trappedGas`` (the part of it that is cut off from the inlet) [-], ``atOutlet`` (gas that hangs on the inlet
    touches the outlet), ``iteration``. The engine's own ramp is switched off. ``progress(stage, P_c, saturation)`` is
    called after each level. Raises :class:`CaseError` for impossible values.
    """
    stages = [(str(stage[0]), stage[1], stage[2] if len(stage) > 2 else increment) for stage in stages]
    for _, end, step in stages:
        if not isPositive(step):
            raise CaseError(f"increment = {shown(step)} Pa, allowed: finite and > 0")
        if not isNotNegative(end):
            raise CaseError(f"a stage ends at {shown(end)} Pa, allowed: finite and >= 0")
    table = {
        name: [] for name in ("stage", "capillaryPressure", "gasSaturation", "trappedGas", "atOutlet", "iteration")
    }
    gas.pressureIncrement = 0
    for name, end, step in stages:
        begin = gas.gasPressure - gas.waterPressure
        count = max(1, int(np.ceil(abs(end - begin) / step - 1e-9)))
        for level in range(1, count + 1):
            pressure = begin + (end - begin) * level / count
            _hold(gas, gas.waterPressure + pressure)
            row = {"stage": name, "capillaryPressure": pressure, **_state(gas)}
            for column, value in row.items():
                table[column].append(value)
            if progress:
                progress(name, pressure, row["gasSaturation"])
    return table


def _hold(gas, pressure):
    """Set the pressure and wait until the engine calls the level finished."""
    from yade import O

    gas.maxPressure = pressure + 1.0  # above the pressure: the level counts as not done yet
    gas.gasPressure = pressure
    limit = O.iter + 2 * gas.maxLevelSteps + 1_000_000
    while not gas.rampDone:
        sediment.advance(10)  # the engine looks every ten steps
        if O.iter > limit:
            raise SceneError(
                f"the level of {pressure:g} Pa did not end: gas goes on moving (invasionInterval ="
                f" {gas.invasionInterval})"
            )


def _state(gas):
    from yade import O

    cells = gas.cells()
    void, amount = np.array(cells["void"]), np.array(cells["gas"])
    held, isGas = np.array(cells["cutOff"]), np.array(cells["phase"]) == 1
    walls = {body.id for name, body in sediment.wallBodies().items() if gas.outletWall in (name, "any")}
    atOutlet = any(free and walls & set(ids) for free, ids in zip(isGas & ~held, cells["vertices"]))
    return {
        "gasSaturation": float(amount.sum() / void.sum()),
        "trappedGas": float(amount[held].sum() / void.sum()),
        "atOutlet": bool(atOutlet),
        "iteration": O.iter,
    }


def measure(table, first="drainage", back="imbibition", second="second drainage"):
    """What a cycle says: a dict.

    ``advance``: for either drainage the lowest P_c [Pa] at which gas that hangs on the inlet has grown by a thousandth
    of the void over what it was when the drainage began; ``breakthrough``: the lowest P_c at which it touches the
    outlet; both None where it did not come to that. ``residual``: S_g at the end of the imbibition; ``trapped``: the
    part of it that is cut off. ``area``: the integral of P_c dS_g over ``first`` and ``back`` [Pa], the work per void
    volume that is not had back.
    """
    stage, pressure = np.array(table["stage"]), np.array(table["capillaryPressure"])
    saturation, trapped, atOutlet = (
        np.array(table["gasSaturation"]),
        np.array(table["trappedGas"]),
        np.array(table["atOutlet"]),
    )
    for name in (first, back):
        if name not in stage:
            raise CaseError(f"the table has no stage '{name}'; it has {sorted(set(table['stage']))}")
    free = saturation - trapped

    def drainage(name):
        rows = np.flatnonzero(stage == name)
        if not len(rows):
            return {"advance": None, "breakthrough": None}
        before = free[rows[0] - 1] if rows[0] > 0 else free[rows[0]]
        grown, through = rows[free[rows] > before + 1e-3], rows[atOutlet[rows]]
        return {
            "advance": float(pressure[grown[0]]) if len(grown) else None,
            "breakthrough": float(pressure[through[0]]) if len(through) else None,
        }

    end = np.flatnonzero(stage == back)[-1]
    loop = np.isin(stage, (first, back)) & (np.arange(len(stage)) <= end)
    p, s = pressure[loop], saturation[loop]
    return {
        first: drainage(first),
        second: drainage(second),
        "residual": float(saturation[end]),
        "trapped": float(trapped[end]),
        "maximum": float(saturation[stage == first].max()),
        "area": float(np.sum(0.5 * (p[1:] + p[:-1]) * np.diff(s))),
    }
