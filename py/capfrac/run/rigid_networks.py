# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid networks of pores: lattices and triangulations with random throats, as arrays."""

from dataclasses import dataclass
import math

import numpy as np

from capfrac import environment
from capfrac.errors import CapfracError, CaseError
from capfrac.values import asInt, isPositive, shown

#: Where the gas comes in: along the bottom, or in the middle.
INLETS = ("side", "centre")

#: Largest width or height of a network, and largest number of its pores: more do not fit into the memory of a machine.
MOST_PORES = 100_000_000

#: Width of the rim of points around a triangulation's box, in (area per pore)^(1/2): the outer triangles of random
#: points are slivers, and cut off.
_RIM = 8


@dataclass(frozen=True)
class RigidNetwork:
    """Pores and throats as arrays.

    Of each throat: ``left`` and ``right``, the pores on its sides; ``entryPressure`` [Pa] (a lattice's: random numbers
    in [0, 1)); ``x``, ``y`` its place, which decides between equal entry pressures. Of each pore: ``poreX``, ``poreY``
    its place; ``gas`` and ``outlet``, 1 where gas is at the start and where water leaves. ``spacing``: (area per
    pore)^(1/2). ``box``: (width, height). With the inlet along the bottom the last pore is the reservoir below, of
    place NaN, not counted in ``count``, the number of pores.
    """

    left: np.ndarray
    right: np.ndarray
    entryPressure: np.ndarray
    x: np.ndarray
    y: np.ndarray
    poreX: np.ndarray
    poreY: np.ndarray
    gas: np.ndarray
    outlet: np.ndarray
    spacing: float
    box: tuple

    @property
    def count(self):
        """Number of pores, without the reservoir [-]."""
        return int(np.count_nonzero(np.isfinite(self.poreX)))


def squareLattice(width, height, seed=0, inlet="side"):
    """Pores on a square lattice of ``width`` times ``height``, throats to the four neighbours with entry pressures that
    are independent and uniform in [0, 1).

    ``inlet`` 'side': gas along the bottom, water leaves along the top, sides closed; 'centre': gas in the middle, water
    leaves along the whole rim. The same seed gives the same network. Raises :class:`CaseError` for values out of range.
    """
    _check(width=(width, 2), height=(height, 2))
    _checkInlet(inlet)
    count = width * height
    pores = np.arange(count).reshape(height, width)
    pairs = [(pores[:, :-1], pores[:, 1:]), (pores[:-1], pores[1:])]
    row, column = np.divmod(np.arange(count), width)
    rim = row == height - 1
    if inlet == "side":
        pairs.append((np.full(width, count), pores[0]))
    else:
        rim = rim | (row == 0) | (column == 0) | (column == width - 1)
    left, right = (np.concatenate([pair[k].ravel() for pair in pairs]) for k in (0, 1))
    entry = np.random.default_rng(seed).random(len(left))
    start = (height // 2) * width + width // 2
    return _assemble(
        left,
        right,
        entry,
        column + 0.5,
        row + 0.5,
        rim,
        None if inlet == "side" else start,
        1.0,
        (float(width), float(height)),
    )


def delaunay(
    width, height, seed=0, inlet="side", rMin=1e-3, rMax=None, solid=0.84, tension=0.05, law="inscribedSphere"
):
    """Pores between disks at random places: triangles of the Delaunay triangulation of their centres, each with three
    throats, about ``width`` times ``height``.

    Radii are uniform in [``rMin``, ``rMax``] [m] (default 5/3 rMin), the sum of the disks' areas is ``solid`` times the
    box's [-]. The entry pressure of an edge is that of the ``law`` (see ``GasInvasionEngine``) with the gap of its two
    disks, interfacial ``tension`` [N/m]. Nothing keeps the disks apart: many overlap, as no sediment does, which
    spreads the entry pressures widely; the law holds for every distance > 0. Only their order matters to the invasion.
    Triangles with the centroid outside of the box are cut off. ``inlet`` as in :func:`squareLattice`. Raises
    :class:`CaseError` for values out of range.
    """
    from scipy.spatial import Delaunay

    _check(width=(width, 2), height=(height, 2))
    _checkInlet(inlet)
    rMax = 5 / 3 * rMin if rMax is None and isPositive(rMin) else rMax
    if not (isPositive(rMin) and isPositive(rMax) and rMax >= rMin):
        raise CaseError(f"rMin = {shown(rMin)}, rMax = {shown(rMax)} m, allowed: 0 < rMin <= rMax")
    if not isPositive(solid):
        raise CaseError(f"solid = {shown(solid)}, allowed: > 0")
    random = np.random.default_rng(seed)
    # Two triangles a grain; the mean of r^2 between the two radii is (rMin^2 + rMin rMax + rMax^2)/3.
    spacing = math.sqrt(0.5 * math.pi * (rMin**2 + rMin * rMax + rMax**2) / 3 / solid)
    size = spacing * np.array([width, height])
    rim = _RIM * spacing
    count = random.poisson(0.5 * (width + 2 * _RIM) * (height + 2 * _RIM))
    points = random.uniform(-rim, size + rim, (count, 2))
    radii = random.uniform(rMin, rMax, count)

    mesh = Delaunay(points)
    centre = points[mesh.simplices].mean(axis=1)
    inside = np.all((centre >= 0) & (centre < size), axis=1)
    number = np.where(inside, np.cumsum(inside) - 1, -1)
    cell, corner = np.divmod(np.arange(3 * len(mesh.simplices)), 3)
    other = mesh.neighbors[cell, corner]
    # Every edge between two triangles comes twice; those that leave the box come once from within.
    kept = inside[cell] & (other >= 0) & ((other > cell) | ~inside[other])
    cell, corner, other = cell[kept], corner[kept], other[kept]
    below, above = centre[other, 1] < 0, centre[other, 1] >= size[1]
    outlet = np.zeros(np.count_nonzero(inside), dtype=bool)
    outlet[number[cell[above if inlet == "side" else ~inside[other]]]] = True
    joins = inside[other] | (below if inlet == "side" else False)
    cell, corner, other = cell[joins], corner[joins], other[joins]
    a, b = mesh.simplices[cell, (corner + 1) % 3], mesh.simplices[cell, (corner + 2) % 3]
    radius = 0.5 * (radii[a] + radii[b])
    gap = np.hypot(*(points[a] - points[b]).T) - 2 * radius
    entry = entryPressures(gap, radius, tension, law=law)
    x, y = centre[inside].T
    start = int(np.argmin(np.hypot(x - 0.5 * size[0], y - 0.5 * size[1])))
    right = np.where(inside[other], number[other], len(x))  # what lies below is the reservoir
    return _assemble(
        number[cell], right, entry, x, y, outlet, None if inlet == "side" else start, spacing, tuple(map(float, size))
    )


def entryPressures(gap, radius, tension, contactAngle=0.0, law="inscribedSphere"):
    """Entry pressures [Pa] of throats with the gaps ``gap`` [m] between grains of mean ``radius`` [m] by the engines'
    laws, as an array.

    ``tension`` [N/m], ``contactAngle`` [rad]. Raises :class:`CaseError` naming the throat and what is allowed.
    """
    kernels = kernelsOf()
    try:
        return np.array(
            kernels.entryPressures(
                np.ascontiguousarray(gap, dtype=np.float64),
                np.ascontiguousarray(radius, dtype=np.float64),
                tension,
                contactAngle,
                law,
            )
        )
    except ValueError as problem:
        raise CaseError(str(problem)) from None


def _assemble(left, right, entry, poreX, poreY, outlet, start, spacing, box):
    """``start``: the pore with gas, None: a reservoir, which is added as the last pore."""
    if start is None:
        poreX, poreY, outlet = np.append(poreX, math.nan), np.append(poreY, math.nan), np.append(outlet, False)
        start = len(poreX) - 1
    gas = np.zeros(len(poreX), dtype=np.uint8)
    gas[start] = 1
    # Throats have the place of their middle; to the reservoir, that of the pore that it opens.
    x, y = (
        np.where(np.isnan(p[left]), p[right], np.where(np.isnan(p[right]), p[left], 0.5 * (p[left] + p[right])))
        for p in (poreX, poreY)
    )
    return RigidNetwork(
        np.asarray(left, dtype=np.int32),
        np.asarray(right, dtype=np.int32),
        entry,
        x,
        y,
        poreX,
        poreY,
        gas,
        np.asarray(outlet, dtype=np.uint8),
        spacing,
        box,
    )


def _check(**values):
    for name, (value, low) in values.items():
        if not low <= (asInt(value) or 0) <= MOST_PORES:
            raise CaseError(f"{name} = {shown(value)}, allowed: whole numbers >= {low}, up to {MOST_PORES}")
    if math.prod(value for value, _ in values.values()) > MOST_PORES:
        raise CaseError(
            f"{' x '.join(f'{name} = {value}' for name, (value, _) in values.items())}, "
            f"allowed: up to {MOST_PORES} pores"
        )


def _checkInlet(inlet):
    if inlet not in INLETS:
        raise CaseError(f"inlet = {inlet!r}, allowed: {', '.join(INLETS)}")


def kernelsOf():
    """The compiled module with the engines' own code; :class:`CapfracError` where it was not built."""
    try:
        with environment.settled():  # it loads OpenMP
            from capfrac import _kernels
    except ImportError as problem:
        raise CapfracError(
            f"capfrac's kernels cannot be loaded ({problem}); start Python with `capfrac python`"
        ) from problem
    return _kernels
