# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the gas comes in, as places and as nodes of the graph."""

import numpy as np

from capfrac.results.moment import WALL_AXIS, WALL_NAMES


def _inletPoints(now):
    if len(now.inletPoints) or not (now.inletWall and now.inletTo > now.inletFrom):
        return now.inletPoints
    axis = WALL_AXIS[now.inletWall]
    along = np.linspace(now.inletFrom, now.inletTo, max(2, int((now.inletTo - now.inletFrom) / float(np.mean(now.r)))))
    points = np.empty((len(along), 2))
    points[:, axis], points[:, 1 - axis] = now.box[WALL_NAMES.index(now.inletWall)], along
    return points


def inletMiddle(now):
    """(2,) middle of the inlet [m]; None for a snapshot without one."""
    points = _inletPoints(now)
    return points.mean(axis=0) if len(points) else None


def inletNodes(now, place):
    """Rows of the gas cells at the inlet: of each of its points, or points along its stretch of wall, the nearest
    within two mean diameters.

    (``cellInlet`` is no help: it is the engine's mark of gas that hangs on the inlet, and spreads with the gas wherever
    edges flip.)
    """
    points, diameter = _inletPoints(now), 2 * float(np.mean(now.r))
    if len(points) == 0 or len(place) == 0:
        return np.array([], dtype=int)
    away = np.linalg.norm(place[None] - points[:, None], axis=2)
    nearest = away.argmin(axis=1)
    return np.unique(nearest[away.min(axis=1) <= 2 * diameter])
