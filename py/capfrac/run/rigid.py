# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid networks: invasion percolation on lattices and triangulations of 1e5 pores and more, by the very code of the
engines.

Where no grain moves, nothing is left of the model but its network. :func:`drain` hands one, given as arrays, to the
code that ``GasInvasionEngine`` calls at every step (``pkg/invasion/Drainage``), so what is measured here, on networks
far too large for grains, holds for it::

    from capfrac import rigid
    network = rigid.squareLattice(512, 1024, seed=1)
    found = rigid.drain(network, trapping=True)
    print(found.saturation, len(found.pores))

Needs neither YADE nor a scene. Lengths of lattices are in spacings of pores, of triangulations in metres; pressures in
Pa.
"""

import math
from dataclasses import dataclass

import numpy as np

from capfrac.errors import CaseError
from capfrac.run.rigid_networks import (
    INLETS,
    MOST_PORES,
    RigidNetwork,
    delaunay,
    entryPressures,
    kernelsOf,
    squareLattice,
)

__all__ = [
    "INLETS",
    "MOST_PORES",
    "RigidDrainage",
    "RigidNetwork",
    "delaunay",
    "drain",
    "entryPressures",
    "squareLattice",
]


@dataclass(frozen=True)
class RigidDrainage:
    """What :func:`drain` found: ``pores`` entered and ``throats`` passed, in the order of invasion; ``trapped`` pores
    of water; ``saturation``, the share
    of the pores that was entered [-]; ``brokeThrough``, whether gas has reached an outlet."""

    pores: np.ndarray
    throats: np.ndarray
    trapped: np.ndarray
    saturation: float
    brokeThrough: bool


def drain(network, capillaryPressure=math.inf, trapping=False, untilBreakthrough=True):
    """Let gas into a network at ``capillaryPressure`` [Pa], infinity: all that it takes; returns a
    :class:`RigidDrainage`.

    Invasion percolation: the lowest entry pressure that the gas touches comes next. ``trapping``: water that is cut off
    from every outlet stays. ``untilBreakthrough`` ends with the first outlet; what came before does not depend on the
    pressure nor on the end. Raises :class:`CaseError` naming the array and the entry at fault, :class:`CapfracError`
    where the kernels were not built.
    """
    kernels = kernelsOf()
    integers = [np.ascontiguousarray(a, dtype=np.int32) for a in (network.left, network.right)]
    numbers = [np.ascontiguousarray(a, dtype=np.float64) for a in (network.entryPressure, network.x, network.y)]
    flags = [np.ascontiguousarray(a, dtype=np.uint8) for a in (network.gas, network.outlet)]
    try:
        throats, pores, trapped = kernels.drain(
            *integers, *numbers, *flags, float(capillaryPressure), bool(trapping), bool(untilBreakthrough)
        )
    except ValueError as problem:
        raise CaseError(str(problem)) from None
    pores = np.array(pores, dtype=np.int64)
    return RigidDrainage(
        pores,
        np.array(throats, dtype=np.int64),
        np.array(trapped, dtype=np.int64),
        len(pores) / network.count,
        bool(np.any(np.asarray(network.outlet)[pores])),
    )
