# SPDX-License-Identifier: GPL-2.0-or-later
"""Lattices of equal grains with water between them: permeability, and a pressure that spreads into a long one.

With the spacing a, the conductance C of Eq. 9 and G = C/L for the distance L of two pores,

    squares     L = a            k = mu G/w
    triangles   L = a/sqrt(3)    k = mu G/(sqrt(3) w)       the pores form a honeycomb

and both are mu C/(a w). With rows along the flow that is exact for any number of rows, walls included: along a wall
that touches a row there are half throats of length a, which carry just the share of half a spacing. Where pressures are
prescribed the pores of triangles are not in line; what that does to the field dies out within a few heights, and the
gradient is read in the middle. Across the rows the walls stand off every other row: a layer of its own, which the
difference of two widths leaves out.

A pressure set at the end of a long sample spreads as p = p0 + (p1 - p0) erfc(x/sqrt(4 D t)), D = k K_f/(mu phi).
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.lab.fluid import advance, fill, poresOf
from capfrac.lab.orders import orders
from capfrac.values import requirePositive
from capfrac.verification.handmade import besideColumn, squareLattice, triangularLattice

#: Shape factor of the law 'constantShape' [-].
SHAPE = 0.026

#: Gaps over the diameter, from overlaps to gaps that still count as contacts [-].
GAPS = (-0.2, -0.1, -0.05, 0.0, 0.05, 0.1, 0.2, 0.3)

#: Spacings of the pulse's lattices over sqrt(4 D t) [-], and D dt/a^2 of its steps [-]: time errs an eighth of what
#: space does.
SPACINGS, FOURIER = (0.4, 0.2, 0.1, 0.05), 0.02


def conductance(gap, radius, viscosity, shape=SHAPE):
    """C of Eq. 9 for w = 1 m [m^4/(Pa s)]: ``gap`` d [m] > -2r, mean ``radius`` r [m], ``viscosity`` mu [Pa s],
    ``shape`` factor [-].

    C = (shape/mu) A^2/(2r), A = r^2 (4c - pi + 2 (acos c - c sqrt(1 - c^2))), c = 1 + d/(2r), the last term for c < 1
    only.
    """
    c = 1 + gap / (2 * radius)
    area = 4 * c - math.pi + (2 * (math.acos(c) - c * math.sqrt(1 - c * c)) if c < 1 else 0.0)
    return shape / viscosity * (area * radius**2) ** 2 / (2 * radius)


def permeabilities(radius=1e-3, viscosity=1e-3, pressure=1e3, gaps=GAPS):
    """Permeability of square and triangular lattices with ``gaps`` over the diameter, > -0.29 and <= 1: a dict.

    ``square``, ``triangular`` (along the rows) and ``across`` (triangles, across the rows): k/radius^2 for each of
    ``gaps`` [-]; ``expected``: mu C/(a w radius^2); ``errors``: largest relative difference of each. :class:`CaseError`
    for impossible values.
    """
    requirePositive(radius=radius, viscosity=viscosity, pressure=pressure)
    # Below -0.29 the diagonals of squares are contacts, too; above 1 a contact is none any more.
    if any(not -0.29 < gap <= 1 for gap in gaps):
        raise CaseError(f"gaps = {list(gaps)}, allowed: > -0.29 and <= 1 of the diameter")
    found = {"gaps": list(gaps), "expected": [], **{name: [] for name in _MEASURES}}
    for gap in gaps:
        d = 2 * radius * gap
        found["expected"].append(viscosity * conductance(d, radius, viscosity) / (2 * radius + d) / radius**2)
        # The engine is to take every gap of the lattice, and no other, for a contact.
        fluid = {"bulkModulus": math.inf, "viscosity": viscosity, "mergeTolerance": max(1e-3, 2.2 * gap)}
        for name, measure in _MEASURES.items():
            found[name].append(viscosity * measure(radius, d, pressure, fluid) / radius**2)
    found["errors"] = {name: float(np.max(np.abs(np.divide(found[name], found["expected"]) - 1))) for name in _MEASURES}
    return found


def _square(radius, gap, pressure, fluid):
    """Flow over section and gradient of pressure [m^2/(Pa s)], upwards."""
    disks, box = squareLattice(4, 6, radius, gap)
    engine = fill(disks, box, wallPressures=[math.nan, math.nan, pressure, 0.0], **fluid)
    advance(1.0)
    y = poresOf(engine)["y"]
    return engine.inflow()["bottom"] * (y.max() - y.min()) / (box[1] * pressure)


def _triangular(radius, gap, pressure, fluid):
    # Five rows: after one height of the box e^-pi is left of what the ends do to the field, e^-13 where the gradient is
    # read.
    a, (disks, box) = 2 * radius + gap, triangularLattice(60, 5, radius, gap)
    engine = fill(disks, box, wallPressures=[pressure, 0.0, math.nan, math.nan], **fluid)
    advance(1.0)
    return engine.inflow()["left"] / (box[3] * _gradient(poresOf(engine), "x", 20.1 * a, a, 20))


def _across(radius, gap, pressure, fluid):
    a, rise, flows = 2 * radius + gap, 0.5 * math.sqrt(3), []
    for columns in (6, 12):
        disks, (left, right, bottom, top) = triangularLattice(columns, 121, radius, gap)
        # With the walls half a spacing off, two triangulations of the layer along them are equally good; a little
        # nearer, one is.
        engine = fill(
            disks,
            (left + 0.01 * a, right - 0.01 * a, bottom, top),
            wallPressures=[math.nan, math.nan, pressure, 0.0],
            **fluid,
        )
        advance(1.0)
        flows.append(
            engine.inflow()["bottom"] / _gradient(poresOf(engine), "y", a * (0.5 + 40.1 * rise), 2 * rise * a, 20)
        )
    return (flows[1] - flows[0]) / (6 * a)


def _gradient(pores, axis, start, period, count):
    """Fall of the pressure with the distance [Pa/m] between two periods of the lattice, ``count`` of them apart.

    Pores along walls have pressures of their own, the same in each period: their means fall as the pressure does.
    ``start`` lies between pores.
    """
    at = pores[axis] - start
    upper, lower = (pores["pressure"][(at >= shift) & (at < shift + period)].mean() for shift in (0, count * period))
    return float(upper - lower) / (count * period)


_MEASURES = {"square": _square, "triangular": _triangular, "across": _across}


def pulseProfile(x, length):
    """(p - p0)/(p1 - p0) at the distances ``x`` [m] from the end; ``length`` sqrt(4 D t) [m] > 0."""
    return np.array([math.erfc(v / length) for v in np.atleast_1d(x)])


def pulseError(x, length, spacing, fourier):
    """What pores ``spacing`` a [m] apart and implicit steps add to :func:`pulseProfile` [-], to leading order;
    ``fourier`` D dt/a^2 [-].

    In the interior they solve p_t = D p_xx + a^2 D (1/12 + fourier/2) p_xxxx. The first pore lies beta a from the end,
    and in the Laplace transform of the chain, e^(q (beta - x/a))/(1 + beta (e^q - 1))/s with s a^2/D = 2 cosh q - 2,
    the end leaves an impulse of (a^2/D) (1/12 - beta (1 - beta)/2) besides. At t = length^2/(4 D) both together are
    (a/length)^2 ((1/12 + fourier/2) erfc''''(eta)/4 + (1/3 - 2 beta (1 - beta)) eta exp(-eta^2)/sqrt(pi)), eta =
    x/length. 1 - beta is the place of the centroid of the void between a wall and the first row, over a.
    """
    eta, beta = np.atleast_1d(x) / length, 1 - besideColumn(0.5, [0.5])
    fourth = 2 / math.sqrt(math.pi) * (8 * eta**3 - 12 * eta) * np.exp(-(eta**2))
    return (spacing / length) ** 2 * (
        (1 / 12 + fourier / 2) / 4 * fourth
        + (1 / 3 - 2 * beta * (1 - beta)) * eta * np.exp(-(eta**2)) / math.sqrt(math.pi)
    )


def pulse(length=0.02, bulkModulus=1e7, viscosity=1e-3, pressure=1e3, start=2e3, spacings=SPACINGS, fourier=FOURIER):
    """A pressure that spreads into square lattices of several spacings: a dict.

    The pores along the bottom are set from ``start`` to ``start`` + ``pressure`` [Pa]; profiles are read where sqrt(4 D
    t) is a quarter, a half and all of ``length`` [m]. ``spacings``: a over length, <= 0.5; ``fourier``: D dt/a^2 of the
    implicit steps. ``runs``: for each spacing ``profiles`` (``length``, ``x`` [m], ``pressure`` and ``expected`` as (p
    - p0)/(p1 - p0)), and at the last of them ``error``, the largest difference, ``predicted`` by :func:`pulseError`,
    and ``misfit``, largest distance from that prediction over its largest value; ``orders`` of convergence in the
    spacing. :class:`CaseError` for impossible values.
    """
    requirePositive(length=length, bulkModulus=bulkModulus, viscosity=viscosity, pressure=pressure, fourier=fourier)
    if not spacings or any(not 0 < s <= 0.5 for s in spacings):
        raise CaseError(f"spacings = {list(spacings)}, allowed: > 0 and <= 0.5 of the length")
    runs = [_pulse(length, s * length, bulkModulus, viscosity, pressure, start, fourier) for s in spacings]
    return {"spacings": list(spacings), "runs": runs, "orders": orders([run["error"] for run in runs])}


def _pulse(length, spacing, bulkModulus, viscosity, pressure, start, fourier):
    radius, porosity = 0.5 * spacing, 1 - 0.25 * math.pi
    diffusivity = conductance(0.0, radius, viscosity) / spacing * bulkModulus / porosity
    disks, box = squareLattice(2, math.ceil(5 * length / spacing), radius)  # erfc(5) = 2e-12 at the far end
    engine = fill(
        disks,
        box,
        bulkModulus=bulkModulus,
        viscosity=viscosity,
        waterPressure=start,
        wallPressures=[math.nan, math.nan, start + pressure, math.nan],
    )
    time, profiles = 0.0, []
    for share in (0.25, 0.5, 1.0):
        end = (share * length) ** 2 / (4 * diffusivity)
        steps = math.ceil((end - time) * diffusivity / (fourier * spacing**2))
        advance(end - time, steps)
        time = end
        pores = poresOf(engine)
        x = pores["y"] - pores["y"].min()
        free = x > 0
        measured, expected = (pores["pressure"][free] - start) / pressure, pulseProfile(x[free], share * length)
        profiles.append(
            {
                "length": share * length,
                "x": x[free].tolist(),
                "pressure": measured.tolist(),
                "expected": expected.tolist(),
            }
        )
    # Steps of the last stretch are the longest part by far and a little shorter than asked for, to end in time.
    off, predicted = measured - expected, pulseError(x[free], length, spacing, fourier)
    return {
        "spacing": spacing,
        "porosity": float(pores["volume"].sum() / (box[1] * box[3])),
        "profiles": profiles,
        "error": float(np.max(np.abs(off))),
        "predicted": float(np.max(np.abs(predicted))),
        "misfit": float(np.max(np.abs(off - predicted)) / np.max(np.abs(predicted))),
    }
