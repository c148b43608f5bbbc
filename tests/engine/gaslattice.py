# SPDX-License-Identifier: GPL-2.0-or-later
"""Snapshots set by hand: a square lattice of touching grains between walls, gas in chosen columns, grains moved as a
test likes.

Grains of radius 1/2 stand at (i + 1/2, j + 1/2) in the box [0, COLUMNS] x [0, ROWS] [m]. A pore is a square of four of
them, two triangles that hang together over its diagonal, which is open; along floor and roof it is a cell of two grains
and the wall. So the way up a column passes ROWS throats, and a column holds COLUMN_VOID of void, as long as nothing
moves.
"""

import numpy as np

from capfrac.results.snapshot import GAS, Snapshot

COLUMNS, ROWS = 12, 12
#: Void of a column of pores [m^2]: its area less that of ROWS grains.
COLUMN_VOID = ROWS * (1 - np.pi / 4)
BOTTOM, TOP = COLUMNS * ROWS + 2, COLUMNS * ROWS + 3


def grain(i, j):
    """Body id of the grain in column i and row j."""
    return j * COLUMNS + i


def topology():
    """Bodies of the cells (c, 3) anticlockwise, and of the edges, ids (t, 2), cells on their sides (t, 2), whether open
    (t,).
    """
    cells, number = [], {}

    def cell(key, *bodies):
        number[key] = len(cells)
        cells.append(bodies)

    for i in range(COLUMNS - 1):
        cell(("low", i, -1), grain(i + 1, 0), grain(i, 0), BOTTOM)
        cell(("up", i, -1), grain(i, ROWS - 1), grain(i + 1, ROWS - 1), TOP)
        for j in range(ROWS - 1):
            cell(("low", i, j), grain(i, j), grain(i + 1, j), grain(i + 1, j + 1))
            cell(("up", i, j), grain(i, j), grain(i + 1, j + 1), grain(i, j + 1))
    edges = []
    for i in range(COLUMNS - 1):
        for j in range(ROWS):
            below = number["up", i, j - 1] if j else number["low", i, -1]
            above = number["low", i, j] if j < ROWS - 1 else number["up", i, -1]
            edges.append((grain(i, j), grain(i + 1, j), below, above, False))
        for j in range(ROWS - 1):
            edges.append((grain(i, j), grain(i + 1, j + 1), number["low", i, j], number["up", i, j], True))
            edges.append((grain(i, j), grain(i, j + 1), number.get(("low", i - 1, j), -1), number["up", i, j], False))
    for i in range(1, COLUMNS - 1):
        edges.append((grain(i, 0), BOTTOM, number["low", i - 1, -1], number["low", i, -1], False))
        edges.append((grain(i, ROWS - 1), TOP, number["up", i - 1, -1], number["up", i, -1], False))
    table = np.array(edges)
    return np.array(cells), table[:, :2], table[:, 2:4], table[:, 4].astype(bool)


CELLS, EDGES, SIDES, OPEN = topology()


def columnOf(cell):
    """The column of pores that a cell belongs to: the smaller of its grains' columns."""
    return min(body % COLUMNS for body in CELLS[cell] if body < COLUMNS * ROWS)


def lattice(gas=(), moved=None, rattlers=(), upTo=ROWS, inlet=None, iteration=1):
    """A snapshot with gas in the columns of pores ``gas``, up to the row ``upTo``, from an inlet below the columns
    ``inlet`` (first, last); None: below the gas.

    ``moved``: displacements of the grains (n, 2) [m], None: nothing has moved. ``rattlers``: ids of grains without
    load.
    """
    count = COLUMNS * ROWS
    moved = np.zeros((count, 2)) if moved is None else np.asarray(moved, dtype=float)
    places = np.array([(i + 0.5, j + 0.5) for j in range(ROWS) for i in range(COLUMNS)]) + moved
    phase = np.zeros(len(CELLS), dtype=int)
    for k, bodies in enumerate(CELLS):
        row = min(body // COLUMNS for body in bodies if body < count) if BOTTOM not in bodies else -1
        if columnOf(k) in gas and row < upTo:
            phase[k] = GAS
    polygons = [_polygon(bodies, places) for bodies in CELLS]
    area = np.array([0.5 * np.sum(p[:, 0] * np.roll(p[:, 1], -1) - np.roll(p[:, 0], -1) * p[:, 1]) for p in polygons])
    first, last = inlet or (min(gas, default=0), max(gas, default=0))
    ends = places[np.minimum(EDGES, count - 1)]
    for side in (0, 1):
        for wall, y in ((BOTTOM, 0.0), (TOP, float(ROWS))):
            on = EDGES[:, side] == wall
            ends[on, side] = np.column_stack([ends[on, 1 - side, 0], np.full(on.sum(), y)])
    gap = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) - np.where(EDGES < count, 0.5, 0).sum(axis=1)
    return Snapshot(
        ids=np.arange(count),
        x=places[:, 0],
        y=places[:, 1],
        r=np.full(count, 0.5),
        displacement=moved,
        rattler=np.isin(np.arange(count), list(rattlers)),
        contacts=np.zeros((0, 2)),
        contactEnds=np.zeros((0, 2, 2)),
        normalForce=[],
        shearForce=[],
        bonded=[],
        brokenBonds=np.zeros((0, 2)),
        cellVertices=CELLS,
        polygonOffsets=np.cumsum([0] + [len(p) for p in polygons]),
        polygonCorners=np.concatenate(polygons),
        cellPhase=phase,
        cellPressure=100.0 * phase,
        cellVoid=area - np.pi / 8,
        cellDomain=np.arange(len(CELLS)),
        cellInlet=np.zeros(len(CELLS), dtype=bool),
        throatIds=EDGES,
        throatGap=gap,
        throatOpen=OPEN,
        entryPressure=np.full(len(EDGES), 100.0),
        throatCells=SIDES,
        box=(0, COLUMNS, 0, ROWS),
        wallIds=[count, count + 1, BOTTOM, TOP],
        inletPoints=np.zeros((0, 2)),
        inletWall="bottom",
        inletFrom=first + 0.5,
        inletTo=last + 1.5,
        gasPressure=100.0,
        iteration=iteration,
        gasSaturation=float(area[phase == GAS].sum() / area.sum()),
    )


def _polygon(bodies, places):
    a, b = places[bodies[0]], places[bodies[1]]
    if bodies[2] not in (BOTTOM, TOP):
        return np.array([a, b, places[bodies[2]]])
    y = 0.0 if bodies[2] == BOTTOM else float(ROWS)
    return np.array([a, b, (b[0], y), (a[0], y)])


def opened(column, by, rows=ROWS):
    """Displacements that part the lattice along a column of pores: all grains right of it, up to ``rows``, by ``by``
    [m] to the right.
    """
    moved = np.zeros((COLUMNS * ROWS, 2))
    for j in range(rows):
        for i in range(column + 1, COLUMNS):
            moved[grain(i, j), 0] = by
    return moved
