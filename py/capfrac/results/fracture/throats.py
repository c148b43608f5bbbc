# SPDX-License-Identifier: GPL-2.0-or-later
"""Throats and cells of a snapshot as numbers: gaps, what has opened since the start, centres."""

import numpy as np

from capfrac.errors import CaseError
from capfrac.results.moment import WALL_AXIS, WALL_NAMES


def gapsOf(snapshot, pairs):
    """(m,) gaps of pairs of bodies in a snapshot [m], negative in overlap; NaN for two walls or bodies that are not in
    it.
    """
    pairs = np.asarray(pairs, dtype=int).reshape(-1, 2)
    ends, rows = snapshot.endsOf(pairs), snapshot.rowOf(pairs)
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) - np.where(rows >= 0, snapshot.r[rows], 0.0).sum(axis=1)


def meanRadii(snapshot, pairs):
    """(m,) mean radius of the grains of each pair of bodies [m], the grain's own at a wall; 0 for two walls."""
    rows = snapshot.rowOf(np.asarray(pairs, dtype=int).reshape(-1, 2))
    return np.where(rows >= 0, snapshot.r[rows], 0.0).sum(axis=1) / np.maximum((rows >= 0).sum(axis=1), 1)


def openedThroats(now, start, openingThreshold=0.01):
    """Growth of the gaps since the start and which throats have opened: ``(aperture [m], opened)``, arrays (t,) over
    the throats of ``now``.

    A throat has opened, as in ``GasInvasionEngine``, when its gap grew by more than ``openingThreshold`` mean radii of
    its pair (the grain's radius at a wall), or when its bond is broken. :class:`CaseError` for snapshots of different
    grains.
    """
    if not np.array_equal(now.ids, start.ids):
        raise CaseError(f"start holds {len(start.ids)} grains, allowed: a snapshot of the same {len(now.ids)} grains")
    if not (np.isfinite(openingThreshold) and openingThreshold > 0):
        raise CaseError(f"openingThreshold = {openingThreshold}, allowed: > 0")
    growth, radius = gapsOf(now, now.throatIds) - gapsOf(start, now.throatIds), meanRadii(now, now.throatIds)
    broken = {tuple(sorted(map(int, pair))) for pair in now.brokenBonds}
    isBroken = np.array([tuple(sorted(map(int, pair))) in broken for pair in now.throatIds], dtype=bool)
    return growth, (growth > openingThreshold * radius) | isBroken


def mergeGap(start):
    """The gap beyond which the engine took an edge for open [m]: between the widest closed and the narrowest open one
    at the start.
    """
    gaps = gapsOf(start, start.throatIds)
    known = np.isfinite(gaps)
    closed, wide = gaps[known & ~start.throatOpen], gaps[known & start.throatOpen]
    return (
        0.5 * (closed.max() + wide.min())
        if len(closed) and len(wide) and closed.max() < wide.min()
        else 1e-3 * float(np.min(start.r))
    )


def signedAreas(snapshot, bodies):
    """(k,) areas of cells between these bodies (k, 3) in a snapshot, anticlockwise positive [m^2].

    A cell is the triangle of three grains, the trapezoid of two grains and their feet on a wall, or the rectangle of
    one grain in the corner of two walls. The bodies need not be neighbours in this snapshot: so the area of a region is
    followed back to where its bodies were, and the sum over a region is the area within its rim.
    """
    bodies = np.asarray(bodies, dtype=int).reshape(-1, 3)
    # Grains first, in their cyclic order: (a, b, c), (a, b, wall) or (a, wall, wall).
    isGrain = snapshot.rowOf(bodies) >= 0
    count = isGrain.sum(axis=1)
    first = np.select([count == 2, count == 1], [(np.argmin(isGrain, axis=1) + 1) % 3, np.argmax(isGrain, axis=1)], 0)
    turned = np.take_along_axis(bodies, (first[:, None] + np.arange(3)) % 3, axis=1)
    places = np.column_stack([snapshot.x, snapshot.y])
    a, b, c = (places[snapshot.rowOf(turned[:, k])] for k in range(3))
    areas = 0.5 * _cross(b - a, c - a)
    feet = [(_footOn(snapshot, a, turned[:, k]), _footOn(snapshot, b, turned[:, k])) for k in (1, 2)]
    # The diagonals of a quadrangle: half their cross product.
    onWall, inCorner = count == 2, count == 1
    areas[onWall] = 0.5 * _cross(feet[1][1] - a, feet[1][0] - b)[onWall]
    areas[inCorner] = _cross(feet[0][0] - a, feet[1][0] - a)[inCorner]
    return areas


def _cross(u, v):
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def _footOn(snapshot, points, walls):
    """(k, 2) feet of points on walls given by their ids; the points themselves where it is none."""
    feet = points.copy()
    for wall, name, place in zip(snapshot.wallIds, WALL_NAMES, snapshot.box):
        feet[walls == wall, WALL_AXIS[name]] = place
    return feet


def cellCentres(snapshot, cells):
    """(k, 2) centroids of the polygons of ``cells`` [m]."""
    return np.array([_centroid(snapshot.polygon(cell)) for cell in cells]).reshape(-1, 2)


def _centroid(corners):
    shifted = corners - corners[0]  # areas of far polygons would lose digits
    ahead = np.roll(shifted, -1, axis=0)
    cross = shifted[:, 0] * ahead[:, 1] - ahead[:, 0] * shifted[:, 1]
    area = cross.sum()
    if abs(area) <= 1e-12 * np.ptp(corners, axis=0).max() ** 2:
        return corners.mean(axis=0)
    return corners[0] + ((shifted + ahead) * cross[:, None]).sum(axis=0) / (3 * area)
