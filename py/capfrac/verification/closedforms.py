# SPDX-License-Identifier: GPL-2.0-or-later
"""Water between grains that are set by hand, run by `SinglePhaseFlowEngine` itself, against formulas in closed form.

All throats have the conductance of Eqs. 8 and 9 of Jain & Juanes (2008), G = C/L, with the constant shape factor 0.026,
which :func:`capfrac.verification.lattices.conductance` writes out anew. L is the distance of the pores' centroids; a
wall mirrors, so that a grain that touches it leaves half a throat. A contact with d = 0 separates two pores and lets
water pass.

* Two pores on either side of a column of touching grains: p1 - p2 decays as exp(-G K_f (1/V1 + 1/V2) t).
* Several columns: throats in series add their resistances, the throats of one column, side by side, their conductances.
* Lattices and a pressure that spreads in them: :mod:`capfrac.verification.lattices`.
* The same problem in other units: :mod:`capfrac.verification.units`.
"""

import math

import numpy as np

from capfrac.lab.fluid import advance, fill, poresOf
from capfrac.lab.orders import orders
from capfrac.lab.run import LabRun
from capfrac.values import requirePositive
from capfrac.verification import lattices, units
from capfrac.verification.handmade import besideColumn, column
from capfrac.verification.lattices import conductance

#: Numbers of time steps in the decay time of the two pores.
STEPS = (5, 10, 20, 40, 80, 160)
#: Columns of one to six grains, whose throats lie side by side: radii over the smallest. Symmetric, so that both pores
#: have their centroids half-way up.
COLUMNS = ((1,), (1, 1), (1, 2, 1), (2, 1, 1, 2), (1, 2, 3, 2, 1), (2, 1, 3, 3, 1, 2))


def checkClosedForms(sample=None, bulkModulus=1e7, viscosity=1e-3, pressure=1e3, run=None):
    """All checks of this module: a dict of ``twoPores``, ``network``, ``lattices``, ``pulse`` and ``units``. The scene
    is replaced.

    ``sample``: a :class:`~capfrac.sediment.Sediment` whose ``rMin`` [m] is the grains' smallest radius, with the
    contacts of the moving grains; the fluid's ``bulkModulus`` [Pa] and ``viscosity`` [Pa s], all > 0; ``pressure`` [Pa]
    that drives it. The parts: :func:`twoPores`, :func:`network`, :func:`lattices.permeabilities`,
    :func:`lattices.pulse` (over ten diameters), :func:`units.checkUnits`. :class:`CaseError` for
    impossible values.
    """
    sample = sample or units.defaultSample()
    run = run or LabRun("closed-forms", {})
    requirePositive(bulkModulus=bulkModulus, viscosity=viscosity, pressure=pressure)
    radius = sample.rMin
    return {
        "twoPores": run.result("two pores", lambda: twoPores(radius, bulkModulus, viscosity, pressure)),
        "network": run.result("network", lambda: network(radius, viscosity, pressure)),
        "lattices": run.result("lattices", lambda: lattices.permeabilities(radius, viscosity, pressure)),
        "pulse": run.result("pulse", lambda: lattices.pulse(20 * radius, bulkModulus, viscosity, pressure)),
        "units": units.checkUnits(sample, bulkModulus, viscosity, run=run),
    }


def summary(found):
    """What :func:`checkClosedForms` ``found``, in numbers: its errors, orders and differences, without the curves; a
    dict.
    """
    pores, pulse = found["twoPores"], found["pulse"]
    return {
        "twoPores": {
            name: {key: value for key, value in one.items() if key != "curve"} if isinstance(one, dict) else one
            for name, one in pores.items()
        },
        "network": found["network"]["errors"],
        "lattices": found["lattices"]["errors"],
        "pulse": {
            "spacings": pulse["spacings"],
            **{name: [run[name] for run in pulse["runs"]] for name in ("error", "predicted", "misfit")},
            "orders": pulse["orders"],
        },
        "units": {problem: one["differences"] for problem, one in found["units"].items()},
    }


def table(found):
    """The errors, orders and differences of :func:`summary` as a table: columns ``check``, ``measure`` and ``value
    [-]``.
    """
    rows, inUnits = [], ("rate", "volumes", "steps")

    def add(name, value):
        if isinstance(value, dict):
            for key, entry in value.items():
                add((*name, key), entry)
        elif isinstance(value, list):
            for number, entry in enumerate(value, start=1):
                add((*name, str(number)), entry)
        else:
            rows.append((name[0], " ".join(name[1:]), value))

    numbers = summary(found)
    add(
        (), {**numbers, "twoPores": {name: value for name, value in numbers["twoPores"].items() if name not in inUnits}}
    )
    return dict(zip(("check", "measure", "value [-]"), map(list, zip(*rows))))


def columnConductance(radii, viscosity):
    """C of all contacts of a column of touching grains of ``radii`` [m], side by side [m^4/(Pa s)]; half a throat at
    either wall.
    """
    contacts = [conductance(0.0, 0.5 * (a + b), viscosity) for a, b in zip(radii, radii[1:])]
    return sum(contacts) + 0.5 * (conductance(0.0, radii[0], viscosity) + conductance(0.0, radii[-1], viscosity))


# --- two pores -----------------------------------------------------------------------------------


def twoPores(radius=1e-3, bulkModulus=1e7, viscosity=1e-3, pressure=1e3):
    """The decay of a difference of pressure between two pores of different size: a dict.

    A column of grains of one, one and a half and one ``radius`` [m] parts a box at three tenths of its width; the pore
    on its left is set to ``pressure`` [Pa]. ``rate``: G K_f (1/V1 + 1/V2) as expected [1/s]; ``volumes`` as expected
    [m^3] and their relative ``volumeError``; ``steps`` in one decay time, and for the schemes ``implicit`` and
    ``explicit`` the ``errors`` of p1 - p2 with them against exp(-1), over the first difference, their ``orders`` of
    convergence; ``roundOff``: largest distance from (1 + rate dt)^-n or (1 - rate dt)^n, what the schemes make of the
    exponential; ``mass``: relative change of the water's mass; ``curve``: p1 - p2 after each tenth of three decay
    times.
    """
    requirePositive(radius=radius, bulkModulus=bulkModulus, viscosity=viscosity, pressure=pressure)
    radii = [radius, 1.5 * radius, radius]
    width, height, place = 12 * radius, 2 * sum(radii), 3.6 * radius
    solid = 0.5 * math.pi * sum(r * r for r in radii)
    volumes = [place * height - solid, (width - place) * height - solid]
    distance = width - besideColumn(place, radii) - besideColumn(width - place, radii)
    rate = columnConductance(radii, viscosity) / distance * bulkModulus * (1 / volumes[0] + 1 / volumes[1])
    fluid = {"bulkModulus": bulkModulus, "viscosity": viscosity}
    found = {"rate": rate, "volumes": volumes, "steps": list(STEPS)}
    for scheme, factor in (("implicit", lambda dt: 1 / (1 + rate * dt)), ("explicit", lambda dt: 1 - rate * dt)):
        runs = [
            _decay(
                column(place, radii),
                (0, width, 0, height),
                place,
                pressure,
                1 / rate,
                n,
                {**fluid, "timeIntegration": scheme},
            )
            for n in STEPS
        ]
        exact = [
            np.abs(run["curve"] - factor(1 / (rate * n)) ** np.arange(1, n + 1)).max() for n, run in zip(STEPS, runs)
        ]
        errors = [abs(float(run["curve"][-1]) - math.exp(-1)) for run in runs]
        shown = _decay(
            column(place, radii),
            (0, width, 0, height),
            place,
            pressure,
            3 / rate,
            30,
            {**fluid, "timeIntegration": scheme},
        )
        found[scheme] = {
            "curve": shown["curve"].tolist(),
            "errors": errors,
            "orders": orders(errors),
            "roundOff": float(max(exact)),
            "mass": max(run["mass"] for run in runs),
        }
    found["volumeError"] = float(np.max(np.abs(shown["volumes"] / volumes - 1)))
    return found


def _decay(disks, box, place, pressure, time, steps, fluid):
    engine = fill(disks, box, **fluid)
    inLeft = [np.mean([corner[0] for corner in polygon]) < place for polygon in engine.cells()["polygon"]]
    engine.setCellPressures([pressure if left else 0.0 for left in inLeft])
    before = poresOf(engine)
    order, curve = np.argsort(before["x"]), []
    for _ in range(steps):
        advance(time / steps)
        left, right = poresOf(engine)["pressure"][order]
        curve.append((left - right) / pressure)
    after = poresOf(engine)
    return {
        "curve": np.array(curve),
        "volumes": after["volume"][order],
        "mass": float(abs(after["water"].sum() / before["water"].sum() - 1)),
    }


# --- series and parallel -------------------------------------------------------------------------


def network(radius=1e-3, viscosity=1e-3, pressure=1e3):
    """Steady flow of an incompressible fluid past columns: a dict.

    ``series``: columns one behind the other, four equal ones at unequal distances, and four of one to four grains:
    ``name``, ``place`` [m] and ``pressure`` (over the whole difference) of each pore and its ``expected`` pressure,
    ``columns`` (places [m]), ``flow`` and ``expectedFlow`` [m^3/s]. ``parallel``: one column, its throats side by side,
    of one to six grains of different size: ``radii`` (over the smallest, ``radius`` [m]), ``flow`` and
    ``expectedFlow``. ``errors``: largest relative difference of the ``series`` and ``parallel`` flows, largest
    difference of a ``pressure`` (over the whole) and of a pore's ``place`` (over the width, where it is known: between
    equal columns).
    """
    requirePositive(radius=radius, viscosity=viscosity, pressure=pressure)
    fluid = {"bulkModulus": math.inf, "viscosity": viscosity, "wallPressures": [pressure, 0.0, math.nan, math.nan]}
    series = [
        _series("equal columns", (3, 3, 3, 3), (4, 12, 18, 28), radius, pressure, fluid),
        _series("different columns", (1, 2, 4, 3), (9, 22, 31, 40), radius, pressure, fluid),
    ]
    parallel = [_parallel(shape, radius, pressure, fluid) for shape in COLUMNS]
    return {
        "series": series,
        "parallel": parallel,
        "errors": {
            "series": max(abs(one["flow"] / one["expectedFlow"] - 1) for one in series),
            "parallel": max(abs(one["flow"] / one["expectedFlow"] - 1) for one in parallel),
            "pressure": max(float(np.max(np.abs(np.subtract(one["pressure"], one["expected"])))) for one in series),
            "place": max(one["placeError"] for one in series),
        },
    }


def _series(name, numbers, places, radius, pressure, fluid):
    """Columns of ``numbers`` of touching grains at ``places`` (in radii) in a box of a height of 12 radii."""
    height, columns = 12 * radius, [radius * place for place in places]
    width = columns[0] + columns[-1]
    radii = [[0.5 * height / n] * n for n in numbers]
    engine = fill(
        [disk for place, stack in zip(columns, radii) for disk in column(place, stack)], (0, width, 0, height), **fluid
    )
    advance(1.0)
    pores = poresOf(engine)
    order = np.argsort(pores["x"])
    centre, edges = pores["x"][order], np.array([0, *columns, width])
    middle, alike = 0.5 * (edges[1:] + edges[:-1]), len(set(numbers)) == 1
    middle[0], middle[-1] = besideColumn(columns[0], radii[0]), width - besideColumn(width - columns[-1], radii[-1])
    # Between equal columns a pore is its own image and its centroid half-way. Between different ones the engine's
    # centroids are taken.
    distance = np.diff(middle) if alike else np.hypot(np.diff(centre), np.diff(pores["y"][order]))
    resistance = distance / [columnConductance(stack, fluid["viscosity"]) for stack in radii]
    expected = 1 - np.concatenate([[0], np.cumsum(resistance)]) / resistance.sum()
    return {
        "name": name,
        "place": centre.tolist(),
        "columns": columns,
        "width": width,
        "pressure": (pores["pressure"][order] / pressure).tolist(),
        "expected": expected.tolist(),
        "flow": engine.inflow()["left"],
        "expectedFlow": pressure / float(resistance.sum()),
        "placeError": float(np.max(np.abs(centre - middle)) / width) if alike else 0.0,
    }


def _parallel(shape, radius, pressure, fluid):
    radii = [radius * s for s in shape]
    width = 16 * radius
    distance = width - besideColumn(0.4 * width, radii) - besideColumn(0.6 * width, radii)
    engine = fill(column(0.4 * width, radii), (0, width, 0, 2 * sum(radii)), **fluid)
    advance(1.0)
    return {
        "radii": list(shape),
        "flow": engine.inflow()["left"],
        "expectedFlow": columnConductance(radii, fluid["viscosity"]) * pressure / distance,
    }
