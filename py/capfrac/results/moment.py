# SPDX-License-Identifier: GPL-2.0-or-later
"""The arrays of one moment of a sample, as objects and as files: :class:`Snapshot`."""

import math
import zipfile
from dataclasses import MISSING, dataclass, fields

import numpy as np

from capfrac.errors import CapfracError, CaseError

#: Phases of a cell, as in ``cells()["phase"]`` of the engines.
WATER, GAS = 0, 1

#: Version of the file; a file of another version is refused rather than misread.
FILE_VERSION = 1

#: Axis of a wall's normal, and its place in ``box`` and ``wallIds``.
WALL_AXIS = {"left": 0, "right": 0, "bottom": 1, "top": 1}

WALL_NAMES = list(WALL_AXIS)

# Kinds and shapes of the arrays. Letters are lengths: arrays with the same letter belong together row by row.
_ARRAYS = {
    "ids": (int, "n"),
    "x": (float, "n"),
    "y": (float, "n"),
    "r": (float, "n"),
    "displacement": (float, "n2"),
    "rattler": (bool, "n"),
    "contacts": (int, "m2"),
    "contactEnds": (float, "m22"),
    "normalForce": (float, "m"),
    "shearForce": (float, "m"),
    "bonded": (bool, "m"),
    "brokenBonds": (int, "k2"),
    "cellVertices": (int, "c3"),
    "polygonOffsets": (int, "o"),
    "polygonCorners": (float, "p2"),
    "cellPhase": (int, "c"),
    "cellPressure": (float, "c"),
    "cellVoid": (float, "c"),
    "cellDomain": (int, "c"),
    "cellInlet": (bool, "c"),
    "throatIds": (int, "t2"),
    "throatGap": (float, "t"),
    "throatOpen": (bool, "t"),
    "entryPressure": (float, "t"),
    "throatCells": (int, "t2"),
    "box": (float, "4"),
    "wallIds": (int, "4"),
    "inletPoints": (float, "i2"),
}


@dataclass(eq=False)
class Snapshot:
    """A sample at one moment. Raises :class:`CaseError` where the arrays do not fit together.

    Grains are in ascending order of their body ids. Compare with :meth:`equals`.
    """

    ids: np.ndarray  #: (n,) body ids of the grains
    x: np.ndarray  #: (n,) centres [m]
    y: np.ndarray  #: (n,) centres [m]
    r: np.ndarray  #: (n,) radii [m]
    displacement: np.ndarray  #: (n, 2) since the start [m]
    rattler: np.ndarray  #: (n,) bool: bore no load at the start, or bears none now

    contacts: np.ndarray  #: (m, 2) body ids; of a contact with a wall, too
    contactEnds: np.ndarray  #: (m, 2, 2) centres of the two grains; for a wall the foot of the other's centre on it [m]
    normalForce: np.ndarray  #: (m,) positive in compression [N]
    shearForce: np.ndarray  #: (m,) magnitude [N]
    bonded: np.ndarray  #: (m,) bool: bears tension
    brokenBonds: np.ndarray  #: (k, 2) body ids of pairs that were bonded at the start and are not any more

    cellVertices: np.ndarray  #: (c, 3) body ids of grains and walls, anticlockwise
    polygonOffsets: np.ndarray  #: (c + 1,) where the corners of each cell begin in polygonCorners
    polygonCorners: np.ndarray  #: (p, 2) corners of the cells, one cell after the other [m]
    cellPhase: np.ndarray  #: (c,) WATER or GAS
    cellPressure: np.ndarray  #: (c,) [Pa]
    cellVoid: np.ndarray  #: (c,) volume of the void [m^3]
    cellDomain: np.ndarray  #: (c,) the pore that the cell belongs to
    cellInlet: np.ndarray  #: (c,) bool: gas was injected here

    throatIds: np.ndarray  #: (t, 2) body ids
    throatGap: np.ndarray  #: (t,) [m]; negative where grains overlap
    throatOpen: np.ndarray  #: (t,) bool: joins the cells on its sides into one domain
    entryPressure: np.ndarray  #: (t,) [Pa]; NaN where there is none
    throatCells: np.ndarray  #: (t, 2) cells left and right, -1 outside

    box: np.ndarray  #: (left, right, bottom, top) [m]
    wallIds: np.ndarray  #: body ids of the walls in that order
    inletPoints: np.ndarray  #: (i, 2) points of injection [m], if the inlet is not a stretch of wall
    inletWall: str = ""  #: wall with the inlet; empty where there is none
    inletFrom: float = 0.0  #: begin of the inlet on its wall [m]
    inletTo: float = 0.0  #: end of the inlet on its wall [m]

    gasPressure: float = math.nan  #: [Pa]
    waterPressure: float = 0.0  #: [Pa]
    gasSaturation: float = 0.0  #: share of the void [-]
    time: float = 0.0  #: [s]
    iteration: int = 0  #: of YADE [-]
    level: int = 0  #: pressure levels that are finished [-]
    thickness: float = 1.0  #: of the slice [m]

    def __post_init__(self):
        lengths = {}
        for name, (kind, shape) in _ARRAYS.items():
            rest = tuple(int(s) for s in shape if s.isdigit())
            letter = None if shape[0].isdigit() else shape[0]
            array = np.asarray(getattr(self, name), dtype=kind).reshape((-1, *rest) if letter else rest)
            setattr(self, name, array)
            if letter and len(array) != lengths.setdefault(letter, len(array)):
                raise CaseError(
                    f"{name} has {len(array)} rows, allowed: {lengths[letter]}, as many as the arrays that it"
                    " belongs to"
                )
        ends = self.polygonOffsets
        if (
            len(ends) != len(self.cellVertices) + 1
            or ends[0] != 0
            or ends[-1] != len(self.polygonCorners)
            or np.any(np.diff(ends) < 3)
        ):
            raise CaseError(
                f"polygonOffsets = {ends[:3]} … {ends[-1:]} ({len(ends)} values), allowed: from 0 to"
                f" {len(self.polygonCorners)} in steps of 3 or more, {len(self.cellVertices) + 1} values"
            )

    @property
    def capillaryPressure(self):
        """Gas pressure less water pressure [Pa]."""
        return self.gasPressure - self.waterPressure

    @property
    def gasCells(self):
        """(c,) bool: the cells that hold gas."""
        return self.cellPhase == GAS

    def polygon(self, cell):
        """(corners, 2) corners of a cell [m]."""
        return self.polygonCorners[self.polygonOffsets[cell] : self.polygonOffsets[cell + 1]]

    def rowOf(self, ids):
        """Row of each body id among the grains; -1 for walls and strangers. Takes any shape."""
        ids = np.asarray(ids, dtype=int)
        if len(self.ids) == 0:
            return np.full(ids.shape, -1)
        row = np.clip(np.searchsorted(self.ids, ids), 0, len(self.ids) - 1)
        return np.where(self.ids[row] == ids, row, -1)

    def endsOf(self, pairs):
        """(m, 2, 2) ends of lines between pairs of bodies, as ``contactEnds`` [m]; NaN for two walls or strangers."""
        pairs = np.asarray(pairs, dtype=int).reshape(-1, 2)
        row = self.rowOf(pairs)
        ends = np.full((len(pairs), 2, 2), np.nan)
        isGrain = row >= 0
        ends[isGrain] = np.column_stack([self.x, self.y])[row[isGrain]]
        for wall, name in zip(self.wallIds, WALL_NAMES):
            for side in (0, 1):
                hit = (pairs[:, side] == wall) & isGrain[:, 1 - side]
                ends[hit, side] = ends[hit, 1 - side]
                ends[hit, side, WALL_AXIS[name]] = self.box[WALL_NAMES.index(name)]
        return ends

    def equals(self, other):
        """Whether all values are the same to the last bit (NaN equals NaN)."""
        return all(
            np.array_equal(getattr(self, f.name), getattr(other, f.name), equal_nan=_isFloat(getattr(self, f.name)))
            for f in fields(self)
        )

    def save(self, path):
        """Write to a ``.npz`` file that :func:`load` reads back exactly."""
        with open(path, "wb") as stream:  # np.savez would append .npz to other names
            np.savez_compressed(
                stream, fileVersion=FILE_VERSION, **{f.name: getattr(self, f.name) for f in fields(self)}
            )


def _isFloat(value):
    return np.asarray(value).dtype.kind == "f"


def load(path):
    """The snapshot in a file that :meth:`Snapshot.save` wrote. :class:`CapfracError` when it is none."""
    try:
        with np.load(path, allow_pickle=False) as stored:
            version = int(stored["fileVersion"])
            if version != FILE_VERSION:
                raise CapfracError(f"{path}: snapshot of version {version}, allowed: {FILE_VERSION}")
            # What earlier versions of capfrac did not write has its default.
            values = {f.name: stored[f.name] for f in fields(Snapshot) if f.name in stored or f.default is MISSING}
    except OSError as problem:
        raise CapfracError(f"the snapshot {path} cannot be read: {problem.strerror or problem}") from None
    except (ValueError, KeyError, EOFError, TypeError, IndexError, AttributeError, zipfile.BadZipFile) as problem:
        raise CapfracError(f"{path} is not a snapshot: {problem}") from None
    return Snapshot(**{name: value if name in _ARRAYS else value.item() for name, value in values.items()})
