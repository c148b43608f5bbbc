"""Where grains come from, before there is a scene: random numbers, or a file of the user's own."""

import csv
import math

import numpy as np

from capfrac.errors import CaseError


def drawRadii(sample):
    """Radii [m] from the sample's grading and seed; uniform in [rMin, rMax] without a grading."""
    if sample.grading is not None:
        return sample.grading.draw(sample.grainCount, np.random.default_rng(sample.seed))
    return np.random.default_rng(sample.seed).uniform(sample.rMin, sample.rMax, sample.grainCount)


def placeGrains(sample, radii):
    """Loose random positions for grains about to settle.

    The grains lie on a grid wide enough that none touch, each moved at random within its square, rows filled from
    the bottom. Returns ``(x, y, width, height)`` [m] with the box's lower left corner in the origin.
    """
    solid = math.pi * float(np.sum(radii**2))
    # 0.84: share of solids in a settled pack of disks; only the shape of the box depends on it.
    width = max(math.sqrt(solid / 0.84 / sample.aspect), 4 * sample.rMax)
    pitch = 2.3 * sample.rMax
    columns = max(1, int(width / pitch))
    pitchX = width / columns
    rng = np.random.default_rng([sample.seed, 1])
    k = np.arange(len(radii))
    x = (k % columns + 0.5) * pitchX + rng.uniform(-1, 1, len(radii)) * (0.5 * pitchX - 1.01 * radii)
    y = (k // columns + 0.5) * pitch + rng.uniform(-1, 1, len(radii)) * (0.5 * pitch - 1.01 * radii)
    return x, y, width, pitch * math.ceil(len(radii) / columns)


def readPacking(path):
    """A packing of the user's own: CSV with the columns x, y, r [m]. Returns arrays ``(x, y, r)``.

    Raises :class:`CaseError` naming the line and what is wrong with it.
    """
    rows = []
    try:
        with open(path, newline="", encoding="utf-8") as stream:
            reader = csv.DictReader(line for line in stream if not line.lstrip().startswith("#"))
            header = [name.strip() for name in reader.fieldnames or []]
            if not {"x", "y", "r"} <= set(header):
                raise CaseError(f"{path}: columns {header}, needed: x, y, r (in metres)")
            reader.fieldnames = header
            for number, row in enumerate(reader, start=1):
                try:
                    x, y, r = (float(row[name]) for name in ("x", "y", "r"))
                except (TypeError, ValueError):
                    raise CaseError(f"{path}: grain {number} is {dict(row)}, needed: three numbers x, y, r") from None
                if not all(map(math.isfinite, (x, y, r))) or r <= 0:
                    raise CaseError(f"{path}: grain {number} has x = {x}, y = {y}, r = {r}; allowed: finite, r > 0")
                rows.append((x, y, r))
    except OSError as problem:
        raise CaseError(f"the packing {path} cannot be read: {problem.strerror}") from None
    except UnicodeDecodeError:
        raise CaseError(f"the packing {path} is not a text in UTF-8") from None
    if not rows:
        raise CaseError(f"{path}: holds no grains")
    return tuple(np.array(rows).T)


def checkOverlaps(x, y, r):
    """Refuse grains that lie in each other: :class:`CaseError` naming the first two (counted from 1) and by how much.

    Contacts push such grains apart with forces that have nothing to do with the sample, and of coincident ones no
    contact knows in which direction.
    """
    for i in range(1, len(x)):
        overlap = r[i] + r[:i] - np.hypot(x[:i] - x[i], y[:i] - y[i])
        j = int(np.argmax(overlap / np.minimum(r[i], r[:i])))
        if overlap[j] > 0.5 * min(r[i], r[j]):
            raise CaseError(f"grains {j + 1} and {i + 1} of the packing overlap by {overlap[j]:.4g} m, allowed: up to half of the smaller radius, {0.5 * min(r[i], r[j]):.4g} m")


def hexagonal(count, radius, aspect=1.0):
    """About ``count`` equal disks of ``radius`` [m] on a triangular lattice, touching, height over width about ``aspect``; (x, y, radii) [m].

    A material without disorder: every pore deforms like every other. Every second row has a disk less. :class:`CaseError` for fewer than 7 disks.
    """
    if count < 7 or not radius > 0 or not aspect > 0:
        raise CaseError(f"count = {count}, radius = {radius} m, aspect = {aspect}; allowed: at least 7 disks, radius and aspect > 0")
    rows = max(3, round(math.sqrt(count * aspect * 2 / math.sqrt(3))))
    columns = max(3, round(count / rows))
    x, y = [], []
    for row in range(rows):
        for column in range(columns - row % 2):
            x.append(radius * (1 + 2 * column + row % 2))
            y.append(radius * (1 + math.sqrt(3) * row))
    return np.array(x), np.array(y), np.full(len(x), float(radius))
