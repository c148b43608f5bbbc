# SPDX-License-Identifier: GPL-2.0-or-later
"""Cycles of the gas pressure: drainage, imbibition, drainage again; the loop of P_c and S_g, and the gas that stays.

The engine does what a pressure does; this drives the pressure, level by level, each until the grains are at rest::

    gas = injection.startInjection(start=100, increment=0, max=0, pores=3, imbibition=True, snapOff=True)
    table = cycles.pressureCycle(gas, [("drainage", 215), ("imbibition", 0), ("second drainage", 215)], increment=2)
    print(cycles.measure(table))
"""

import numpy as np

from capfrac.errors import CaseError, SceneError
from capfrac.plot import figures
from capfrac.scene import sediment
from capfrac.values import isNotNegative, isPositive, shown

#: Columns of the table of :func:`pressureCycle` that are numbers.
COLUMNS = ("capillaryPressure", "gasSaturation", "trappedGas", "iteration")
_COLOURS_OF_CELLS = ("#ffffff", figures.COLOURS["gas"], "#e8862e")  # water, gas, trapped gas
_COLOURS = {"drainage": "#1f5fa8", "imbibition": "#c7641b", "second drainage": "#3aa0d8"}


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


def cellMap(gas):
    """The cells as they are now, for :func:`drawCycle`: a dict of ``grains`` (x, y, r [m]), ``polygons`` and ``state``
    (0 water, 1 gas, 2 trapped gas).
    """
    cells = gas.cells()
    state = [0 if not phase else 2 if held else 1 for phase, held in zip(cells["phase"], cells["cutOff"])]
    grains = [(b.state.pos[0], b.state.pos[1], b.shape.radius) for b in sediment.grainBodies()]
    return {"grains": grains, "polygons": [list(map(tuple, polygon)) for polygon in cells["polygon"]], "state": state}


def drawCycle(tables, path, maps=()):
    """Draw the loops of several samples (the first one strong), and maps of where the gas is: (title, :func:`cellMap`)
    pairs, to ``path``.
    """
    width = 4.6 + 3.0 * len(maps)
    with figures.newFigure((width, 4.4)) as figure:
        columns = figure.add_gridspec(
            1,
            1 + len(maps),
            width_ratios=[1.4] + [1] * len(maps),
            left=0.6 / width,
            right=0.995,
            bottom=0.24,
            top=0.92,
            wspace=0.06 if maps else None,
        )
        _drawLoops(figure.add_subplot(columns[0]), tables)
        for column, (title, one) in enumerate(maps, start=1):
            _drawMap(figure.add_subplot(columns[column]), title, one, legend=column == 1)
        figures.saveFigure(figure, path)


def _drawLoops(axes, tables):
    for number, table in reversed(list(enumerate(tables))):
        for name in dict.fromkeys(table["stage"]):
            rows = [k for k, stage in enumerate(table["stage"]) if stage == name]
            rows = ([rows[0] - 1] if rows[0] > 0 else []) + rows
            axes.plot(
                [table["gasSaturation"][k] for k in rows],
                [table["capillaryPressure"][k] for k in rows],
                color=_COLOURS.get(name, "#555555"),
                lw=2 if number == 0 else 0.8,
                alpha=1 if number == 0 else 0.35,
                label=name if number == 0 else None,
            )
    if len(tables) > 1:
        axes.plot([], [], color="#555555", lw=0.8, alpha=0.6, label="other samples, thin")
    table = tables[0]
    back = [k for k, stage in enumerate(table["stage"]) if stage == "imbibition"]
    axes.plot(
        [table["trappedGas"][k] for k in back],
        [table["capillaryPressure"][k] for k in back],
        color=_COLOURS["imbibition"],
        lw=1.3,
        ls=":",
        label="trapped, on imbibition",
    )
    axes.set(xlim=(0, 1), xlabel="gas saturation $S_g$ [-]", ylabel="capillary pressure $P_c$ [Pa]")
    axes.set_ylim(bottom=0)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=2, frameon=False, fontsize=8)


def _drawMap(axes, title, one, legend):
    from matplotlib.collections import PatchCollection, PolyCollection
    from matplotlib.patches import Circle, Patch

    colours = [_COLOURS_OF_CELLS[state] for state in one["state"]]
    axes.add_collection(PolyCollection(one["polygons"], facecolors=colours, edgecolors=colours, linewidths=0.3))
    axes.add_collection(
        PatchCollection(
            [Circle((x, y), r) for x, y, r in one["grains"]],
            facecolor=figures.COLOURS["grain"],
            edgecolor=figures.COLOURS["outline"],
            linewidth=0.4,
        )
    )
    corners = np.array([corner for polygon in one["polygons"] for corner in polygon])
    axes.set(
        xlim=(corners[:, 0].min(), corners[:, 0].max()),
        ylim=(corners[:, 1].min(), corners[:, 1].max()),
        xticks=[],
        yticks=[],
        aspect="equal",
    )
    axes.set_title(title, fontsize=9)
    if legend:
        names = zip(_COLOURS_OF_CELLS, ("water", "gas on the inlet", "trapped gas"))
        axes.legend(
            handles=[
                Patch(facecolor=colour, edgecolor=figures.COLOURS["outline"], label=label) for colour, label in names
            ],
            loc="upper left",
            bbox_to_anchor=(0, -0.04),
            ncol=3,
            frameon=False,
            fontsize=8,
        )
