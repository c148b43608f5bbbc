# SPDX-License-Identifier: GPL-2.0-or-later
"""One moment of a sample as plain arrays: all that a picture or a field needs, without YADE.

A snapshot is taken from YADE's scene, kept as a file, and drawn or exported later, on another machine if need be::

    from capfrac import snapshot
    first = snapshot.takeSnapshot(gas)                # before the injection
    ...
    now = snapshot.takeSnapshot(gas, start=first)     # with displacements since then
    now.save("level012.npz")
    now = snapshot.load("level012.npz")

All quantities are in SI units and those of a slice of the engine's thickness (1 m unless told otherwise).
"""

from capfrac.results.moment import FILE_VERSION, GAS, WALL_AXIS, WALL_NAMES, WATER, Snapshot, load
from capfrac.results.taking import takeSnapshot

__all__ = ["FILE_VERSION", "GAS", "WALL_AXIS", "WALL_NAMES", "WATER", "Snapshot", "load", "takeSnapshot"]
