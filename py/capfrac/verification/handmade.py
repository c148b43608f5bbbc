# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixed grains that are set by hand, and `SinglePhaseFlowEngine` alone among them.

Disks are lists of (x, y, radius) [m], boxes are (left, right, bottom, top) [m]. Walls mirror: a grain whose centre is
half a spacing from a wall has its image behind it, so that samples of a few rows behave like endless ones.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.values import asFloat, asInt, requirePositive, shown


def column(place, radii):
    """Touching grains, one on the other, from the floor up: the ``place`` x of their centres and their ``radii`` [m];
    disks.
    """
    centres = np.cumsum([2 * r for r in radii]) - np.array(radii)
    return [(place, float(y), r) for y, r in zip(centres, radii)]


def besideColumn(distance, radii):
    """How far from a wall the centroid of the void lies between the wall and a :func:`column` at ``distance`` of
    touching grains of ``radii``, all in m.
    """
    height, half = 2 * sum(radii), [0.5 * math.pi * r**2 for r in radii]
    # A half-disk of radius r has its centroid 4 r/(3 pi) from its straight side.
    moment = 0.5 * distance**2 * height - sum(
        area * (distance - 4 * r / (3 * math.pi)) for area, r in zip(half, radii)
    )
    return moment / (distance * height - sum(half))


def squareLattice(across, along, radius, gap=0.0):
    """``across`` times ``along`` grains at the corners of squares, with ``gap`` [m] > -2 radius between neighbours;
    disks and box.
    """
    _requireCounts(1, across=across, along=along)
    a = _spacing(radius, gap)
    return [(a * (i + 0.5), a * (j + 0.5), radius) for i in range(across) for j in range(along)], (
        0.0,
        across * a,
        0.0,
        along * a,
    )


def triangularLattice(columns, rows, radius, gap=0.0):
    """``rows`` of ``columns`` >= 2 grains, every other shifted by half a spacing and one grain shorter; ``gap`` as
    above; disks and box.
    """
    _requireCounts(2, columns=columns)
    _requireCounts(1, rows=rows)
    a, rise = _spacing(radius, gap), 0.5 * math.sqrt(3)
    disks = [
        (a * (0.5 + 0.5 * (j % 2) + i), a * (0.5 + rise * j), radius)
        for j in range(rows)
        for i in range(columns - j % 2)
    ]
    return disks, (0.0, columns * a, 0.0, a * (1 + rise * (rows - 1)))


def _requireCounts(least, **counts):
    for name, value in counts.items():
        if (asInt(value) or 0) < least:
            raise CaseError(f"{name} = {shown(value)}, allowed: a whole number >= {least}")


def _spacing(radius, gap):
    requirePositive(radius=radius)
    if asFloat(gap) is None or gap <= -2 * radius:
        raise CaseError(f"gap = {shown(gap)} m, allowed: > -2 radius = {-2 * radius:g} m")
    return 2 * radius + gap
