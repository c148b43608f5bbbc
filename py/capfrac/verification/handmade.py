# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixed grains that are set by hand, and `SinglePhaseFlowEngine` alone among them.

Disks are lists of (x, y, radius) [m], boxes are (left, right, bottom, top) [m]. Walls mirror: a grain whose centre is
half a spacing from a wall has its image behind it, so that samples of a few rows behave like endless ones.
"""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.scene import sediment
from capfrac.values import asFloat, asInt, isPositive, shown


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


def requirePositive(**values):
    """Raise :class:`CaseError` that names the first of the values that is not a finite number > 0."""
    for name, value in values.items():
        if not isPositive(value):
            raise CaseError(f"{name} = {shown(value)}, allowed: a finite number > 0")


def _requireCounts(least, **counts):
    for name, value in counts.items():
        if (asInt(value) or 0) < least:
            raise CaseError(f"{name} = {shown(value)}, allowed: a whole number >= {least}")


def _spacing(radius, gap):
    requirePositive(radius=radius)
    if asFloat(gap) is None or gap <= -2 * radius:
        raise CaseError(f"gap = {shown(gap)} m, allowed: > -2 radius = {-2 * radius:g} m")
    return 2 * radius + gap


def alone(**attributes):
    """Make the engine, with its ``attributes``, the only one of the scene: grains stand still, whatever forces they
    have; returns it.
    """
    from yade import O
    from yade.wrapper import SinglePhaseFlowEngine

    engine = SinglePhaseFlowEngine(**{"timeIntegration": "implicit", **attributes})
    O.engines = [engine]
    return engine


def fill(disks, box, **attributes):
    """Put the disks into a new scene, with the engine :func:`alone`; returns the engine.

    The scene is replaced. Throats have the constant shape factor 0.026 and steps are implicit unless ``attributes`` of
    the engine say otherwise.
    """
    from yade import O

    x, y, radii = np.array(disks, dtype=float).T
    O.reset()
    sediment.buildScene(
        sediment.Sediment(grainCount=len(disks), rMin=float(radii.min()), rMax=float(radii.max())), x, y, radii, box
    )
    return alone(**{"conductanceLaw": "constantShape", **attributes})


def advance(time, steps=1):
    """Run ``steps`` equal steps that make up ``time`` [s]."""
    from yade import O

    O.dt = time / steps
    sediment.advance(steps)


def poresOf(engine):
    """What the engine reports of its pores, as arrays."""
    return {name: np.array(values) for name, values in engine.pores().items()}


def drainedAt(flow, axis, pressure):
    """Where along ``axis`` the pores lie that are held at ``pressure``: the mean of their centroids [m]."""
    pores = poresOf(flow)
    at = pores["pressure"] == pressure
    return float(np.average(pores["xy"[axis]][at], weights=pores["volume"][at]))
