# SPDX-License-Identifier: GPL-2.0-or-later
"""The packing that a case names: whether it can be meant as it is, and agrees with what else the case says.

A file knows nothing of the case, so a unit that was forgotten shows only where the two are compared: radii of 0.94 (mm)
beside ``grains.rMin = 0.94e-3`` (m) would make a box of 15 m and entry pressures of a thousandth.
"""

import functools
import math
from pathlib import Path

import numpy as np

from capfrac.case.checks import MAX_SIZE_RATIO
from capfrac.case.keys import KEYS
from capfrac.errors import CaseError
from capfrac.io.namedfiles import digests
from capfrac.scene.packing import BOULDER, checkOverlaps, readPackingTable

#: Number of grains of a case that does not say it.
DEFAULT_COUNT = next(key.default for key in KEYS if key.path == "grains.count")
#: Factor by which a radius of the file and one of the case may differ [-]. More is refused: the two cannot be meant for
#: the same grains. Twice may be a diameter for a radius, or a packing that was scaled: it is told, and no more.
CONTRADICTION = 3
#: The same, up to which they are rounded numbers [-].
ROUNDED = 1.1
#: Share of the box around them that grains fill at least [-]; a loose pile fills half of it.
LEAST_FILLED = 0.01
#: Units that are forgotten: power of ten -> name.
_UNITS = {2: "cm", 3: "mm", 6: "um", 9: "nm"}


def packingOf(case):
    """The case's packing as a :class:`~capfrac.io.tables.Table`, or None where the grains are generated."""
    name = case["grains"]["packing"]
    return readPackingTable(Path(case["case"].get("folder", ".")) / name) if name else None


def checkPacking(case):
    """Read and check the case's packing, if it has one; returns warnings, a list of texts.

    Raises :class:`CaseError` naming file, line and key for one that cannot be read, whose grains lie in each other or
    far apart, or that contradicts ``grains.rMin``, ``grains.rMax`` or ``grains.count``.
    """
    grains, folder = case["grains"], case["case"].get("folder", ".")
    if not grains["packing"]:
        return []
    content = digests(case, folder)["grains.packing"]["sha256"]
    return list(_checked(Path(folder) / grains["packing"], content, grains["rMin"], grains["rMax"], grains["count"]))


@functools.lru_cache(maxsize=16)  # the points of a sweep share a packing
def _checked(path, content, rMin, rMax, count):
    """The same of a file, whose ``content`` is told by its digest."""
    table = readPackingTable(path)
    r = table.values["r"]
    low, high = int(r.argmin()), int(r.argmax())
    if r[high] > MAX_SIZE_RATIO * r[low]:
        raise CaseError(
            f"{table.where(high)}: r = {r[high]:g} m, {r[high] / r[low]:.3g} times that of line "
            f"{table.lines[low]}, {r[low]:g} m; allowed: up to {MAX_SIZE_RATIO} times"
        )
    told = _compare(table, low, "rMin", rMin, "smallest")
    if rMax is not None and (rMin is None or rMax != 2 * rMin):  # else it is the default
        told += _compare(table, high, "rMax", rMax, "largest")
    if count not in (DEFAULT_COUNT, len(r)):
        raise CaseError(
            f"grains.count = {count}, but {table.path} holds {len(r)} grains; allowed: their number, or no grains.count"
        )
    _checkPlaces(table)
    if r[high] > BOULDER:
        told.append(
            f"{table.where(high)}: r = {r[high]:g} m, a boulder; are the numbers of the file in mm or um? Then "
            "write the unit behind the names of its columns, r [mm]"
        )
    return told


def _checkPlaces(table):
    """Refuse grains that lie in each other, or so far apart that x and y are in another unit than r."""
    x, y, r = (table.values[name] for name in "xyr")
    checkOverlaps(x, y, r, table)
    area = float((np.max(x + r) - np.min(x - r)) * (np.max(y + r) - np.min(y - r)))
    share = math.pi * float(np.sum(r**2)) / area
    if share < LEAST_FILLED:
        far = int(np.argmax(np.hypot(x - np.median(x), y - np.median(y))))
        raise CaseError(
            f"{table.path}: the grains fill {share:.2g} of the box around them, allowed: at least "
            f"{LEAST_FILLED}; are x and y in another unit than r, or does a grain lie astray? Farthest out "
            f"is that of line {table.lines[far]}: x = {x[far]:g} m, y = {y[far]:g} m, r = {r[far]:g} m"
        )


def _compare(table, row, name, given, word):
    """What to tell of a radius of the file beside that of the case (None: nothing was given): a list of texts."""
    if given is None:
        return []
    found = float(table.values["r"][row])
    ratio = found / given
    text = (
        f"grains.{name} = {given:g} m, but the {word} radius in {table.path} (line {table.lines[row]}) is {found:g} m"
    )
    if not 1 / CONTRADICTION <= ratio <= CONTRADICTION:
        raise CaseError(
            f"{text}, {ratio:.4g} times that; allowed: about the same, or no grains.{name}; {_meant(ratio)}"
        )
    if 1 / ROUNDED <= ratio <= ROUNDED:
        return []
    twice = "; are these diameters? Then call the column d" if 1.8 < ratio < 2.2 else ""
    return [f"{text}; the file counts{twice}"]


def _meant(ratio):
    """What may have been meant where a radius of the file is that many times what is expected."""
    unit = _UNITS[min(_UNITS, key=lambda power: abs(power - abs(math.log10(ratio))))]
    if ratio < 1:
        return f"is that of the case in {unit}? Its unit is m"
    return f"are the numbers of the file in {unit}? Then name its columns x [{unit}], y [{unit}], r [{unit}]"
