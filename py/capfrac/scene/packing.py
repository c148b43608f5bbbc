# SPDX-License-Identifier: GPL-2.0-or-later
"""Where grains come from, before there is a scene: random numbers, or a file of the user's own."""

import math

import numpy as np

from capfrac.errors import CaseError
from capfrac.io.tables import Column, readTable
from capfrac.scene import samplechecks
from capfrac.values import MOST_GRAINS, asInt, isPositive, shown

#: Radius from which on a grain is a boulder, and a unit may have been forgotten [m].
BOULDER = 0.1


def drawRadii(sample):
    """Radii [m] from the sample's grading and seed; uniform in [rMin, rMax] without a grading."""
    if sample.grading is not None:
        return sample.grading.draw(sample.grainCount, np.random.default_rng(sample.seed))
    return np.random.default_rng(sample.seed).uniform(sample.rMin, sample.rMax, sample.grainCount)


def placeGrains(sample, radii):
    """Loose random positions for grains about to settle.

    The grains lie on a grid wide enough that none touch, each moved at random within its square, rows filled from
    the bottom. Returns ``(x, y, width, height)`` [m] with the box's lower left corner in the origin. Raises
    :class:`CaseError` where so many grains cannot have the shape that the sample asks for.
    """
    area = math.pi * float(np.sum(radii**2)) / samplechecks.SETTLED  # only the shape of the box depends on it
    problems = list(samplechecks.aspectAmiss(sample.aspect, area, float(np.mean(radii)), float(np.max(radii))))
    if problems:
        raise CaseError(*problems)
    width = max(math.sqrt(area / sample.aspect), 4 * sample.rMax)
    pitch = 2.3 * sample.rMax
    columns = max(1, int(width / pitch))
    pitchX = width / columns
    rng = np.random.default_rng([sample.seed, 1])
    k = np.arange(len(radii))
    x = (k % columns + 0.5) * pitchX + rng.uniform(-1, 1, len(radii)) * (0.5 * pitchX - 1.01 * radii)
    y = (k // columns + 0.5) * pitch + rng.uniform(-1, 1, len(radii)) * (0.5 * pitch - 1.01 * radii)
    return x, y, width, pitch * math.ceil(len(radii) / columns)


#: What a packing is made of; z, where it is given, says that the grains lie in a plane.
COLUMNS = (
    Column("x", "m"),
    Column("y", "m"),
    Column("r", "m", {"radius": "1", "d": "0.5", "diameter": "0.5"}, low=0, openLow=True),
    Column("z", "m", optional=True),
)


def readPackingTable(path):
    """A packing of the user's own as a :class:`~capfrac.io.tables.Table` with the columns of :data:`COLUMNS` [m].

    Raises :class:`CaseError` naming file, line and column of what is wrong; see :mod:`capfrac.io.tables` for what is
    read.
    """
    table = readTable(path, COLUMNS, "the packing")
    z = table.values.get("z", np.zeros(1))
    apart = np.flatnonzero(np.abs(z - z[0]) > 1e-3 * table.values["r"].min())
    if len(apart):
        raise CaseError(
            f"{table.where(apart[0])}: z = {z[apart[0]]:g} m, in line {table.lines[0]} {z[0]:g} m; "
            "allowed: one for all, the grains are disks in a plane"
        )
    return table


def readPacking(path):
    """A packing of the user's own: arrays ``(x, y, r)`` [m]; see :func:`readPackingTable`."""
    values = readPackingTable(path).values
    return values["x"], values["y"], values["r"]


def checkOverlaps(x, y, r, table=None):
    """Refuse grains that lie in each other: :class:`CaseError` naming the first two and by how much.

    They are named by their number, counted from 1, or by their lines in the ``table`` that they are from. Contacts push
    such grains apart with forces that have nothing to do with the sample, and of coincident ones no contact knows in
    which direction.
    """
    for i in range(1, len(x)):
        overlap = r[i] + r[:i] - np.hypot(x[:i] - x[i], y[:i] - y[i])
        j = int(np.argmax(overlap / np.minimum(r[i], r[:i])))
        most = 0.5 * min(r[i], r[j])
        if overlap[j] > most:
            both = (
                f"grains {j + 1} and {i + 1} of the packing"
                if table is None
                else (f"{table.path}, lines {table.lines[j]} and {table.lines[i]}: the grains")
            )
            raise CaseError(
                f"{both} overlap by {overlap[j]:.4g} m, allowed: up to half of the smaller radius, {most:.4g} m"
            )


def hexagonal(count, radius, aspect=1.0):
    """About ``count`` equal disks of ``radius`` [m] on a triangular lattice, touching, height over width about
    ``aspect``; (x, y, radii) [m].

    A material without disorder: every pore deforms like every other. Every second row has a disk less.
    :class:`CaseError` for fewer than 7 disks.
    """
    if not 7 <= (asInt(count) or 0) <= MOST_GRAINS or not isPositive(radius) or not isPositive(aspect):
        raise CaseError(
            f"count = {shown(count)}, radius = {shown(radius)} m, aspect = {shown(aspect)}; "
            f"allowed: at least 7 disks (up to {MOST_GRAINS}), radius and aspect > 0"
        )
    rows = max(3, round(math.sqrt(count * aspect * 2 / math.sqrt(3))))
    columns = max(3, round(count / rows))
    x, y = [], []
    for row in range(rows):
        for column in range(columns - row % 2):
            x.append(radius * (1 + 2 * column + row % 2))
            y.append(radius * (1 + math.sqrt(3) * row))
    return np.array(x), np.array(y), np.full(len(x), float(radius))
