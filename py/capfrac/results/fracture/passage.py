# SPDX-License-Identifier: GPL-2.0-or-later
"""How gas came through a sediment: on which way, past which throats, and whose room it stands in.

The gas of a snapshot is a graph. Its nodes are cells (not pores: a throat that opens joins the pores on its sides), its
edges the lines between two grains with gas on both sides. Such an edge is one of three things, by what its two bodies
did since the start:

``opened``
    its gap has grown by more than ``openingThreshold`` mean radii, or its bodies were no neighbours and have moved
    against each other by as much: room that the grains have made.
``pore``
    it was open at the start already (the inside of a pore), or one of its grains bore no load then: a grain that floats
    holds nothing together.
``rigid``
    a throat that is as narrow as it was. Gas had to enter it.

When gas entered does not matter: a throat that opens behind the front counts as opened.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from capfrac.errors import CaseError
from capfrac.results.fracture.inlet import inletNodes
from capfrac.results.fracture.throats import cellCentres, gapsOf, meanRadii, mergeGap, signedAreas
from capfrac.results.moment import WALL_NAMES

#: Kinds of edges between two cells of gas.
OPENED, PORE, RIGID = "opened", "pore", "rigid"


@dataclass(eq=False)
class Way:
    """A way of the gas from the inlet to the outlet, or to the gas that is farthest from the inlet."""

    cells: np.ndarray  #: (k,) rows of the cells in the snapshot, from the inlet on
    opened: int  #: throats on the way that grains have opened [-]
    rigid: int  #: throats on the way that are as they were [-]

    @property
    def openedShare(self):
        """Opened throats over all throats on the way [-]; NaN where it passes none."""
        return self.opened / (self.opened + self.rigid) if self.opened + self.rigid else float("nan")


@dataclass(eq=False)
class Passage:
    """What :func:`findPassage` finds."""

    throats: np.ndarray  #: (t,) rows of the edges with gas on both sides, in the snapshot
    kinds: np.ndarray  #: (t,) OPENED, PORE or RIGID
    through: bool  #: whether the gas that hangs on the inlet touches an outlet
    fewestRigid: Way  #: the way with the fewest rigid throats; of these the one with the fewest throats
    fewestOpened: Way  #: the way with the fewest opened throats; of these the one with the fewest throats
    madeRoom: float  #: share of the gas volume that stands in room that the grains made [-]; see :func:`madeRoom`


def findPassage(now, start, outlet="top", openingThreshold=0.01):
    """The :class:`Passage` of the gas in the snapshot ``now``; ``start`` is the one before the injection.

    ``outlet``: a wall, or 'any'. ``openingThreshold``: growth of a gap in mean radii of its bodies from which a throat
    has opened [-], > 0, as of the engine. :class:`CaseError` for another outlet or threshold, and for snapshots of
    different grains.
    """
    if outlet not in (*WALL_NAMES, "any"):
        raise CaseError(f"outlet = {outlet!r}, allowed: {', '.join(map(repr, WALL_NAMES))}, 'any'")
    edges = np.flatnonzero(gasOnBothSides(now))
    kinds = kindsOf(now, start, edges, openingThreshold)
    gas = np.flatnonzero(now.gasCells)
    row = np.full(len(now.cellPhase), -1)
    row[gas] = np.arange(len(gas))
    place = cellCentres(now, gas)
    graph = _Graph(len(gas), row[now.throatCells[edges]], kinds)
    inlet = inletNodes(now, place)
    ends, through = _ends(now, gas, place, graph, inlet, outlet)
    ways = [graph.way(inlet, ends, avoided) for avoided in (RIGID, OPENED)]
    for way in ways:
        way.cells = gas[way.cells]
    return Passage(edges, kinds, through, *ways, madeRoom(now, start))


def gasOfTheInlet(now):
    """(c,) bool: cells of gas that hang on the inlet, through whatever edges."""
    edges, gas = np.flatnonzero(gasOnBothSides(now)), np.flatnonzero(now.gasCells)
    row = np.full(len(now.cellPhase), -1)
    row[gas] = np.arange(len(gas))
    graph = _Graph(len(gas), row[now.throatCells[edges]], np.full(len(edges), PORE))
    found = np.zeros(len(now.cellPhase), dtype=bool)
    found[gas[graph.reached(inletNodes(now, cellCentres(now, gas)))]] = True
    return found


def gasOnBothSides(now):
    """(t,) bool: edges of the snapshot between two cells of gas."""
    return np.all(now.throatCells >= 0, axis=1) & np.all(now.gasCells[now.throatCells], axis=1)


def kindsOf(now, start, edges, openingThreshold=0.01):
    """(k,) OPENED, PORE or RIGID for these rows of edges of ``now``; see the module and :func:`findPassage`."""
    if not np.array_equal(now.ids, start.ids):
        raise CaseError(f"start holds {len(start.ids)} grains, allowed: a snapshot of the same {len(now.ids)} grains")
    if not (np.isfinite(openingThreshold) and openingThreshold > 0):
        raise CaseError(f"openingThreshold = {openingThreshold}, allowed: > 0")
    pairs = now.throatIds[edges]
    then = gapsOf(start, pairs)
    growth = gapsOf(now, pairs) - then
    least = openingThreshold * meanRadii(now, pairs)
    neighbours = {tuple(pair) for pair in np.sort(start.throatIds, axis=1).tolist()}
    wereNear = np.array([tuple(pair) in neighbours for pair in np.sort(pairs, axis=1).tolist()], dtype=bool)
    grains = now.rowOf(pairs)
    floating = np.any((grains >= 0) & start.rattler[grains], axis=1) | np.all(grains < 0, axis=1)
    inPore = floating | (then > mergeGap(start)) & (wereNear | (np.abs(growth) <= least))
    return np.where(inPore, PORE, np.where((growth > least) | ~wereNear & (np.abs(growth) > least), OPENED, RIGID))


def madeRoom(now, start):
    """The share of the gas in ``now`` that stands in room that the grains made since ``start`` [-]; 0 without gas.

    It is the growth of the region that the gas holds, over the gas volume: the area of its cells now, less that of
    cells between the same bodies where these were at the start. What happens within the region cancels in that sum, as
    in the area of any polygon: a grain that tumbles in the gas and cells that flip change nothing. 0 for gas between
    grains that stand still, 1 for gas between the walls of a crack that were one; below 0 where grains have closed up
    around the gas.
    """
    gas = np.flatnonzero(now.gasCells)
    volume = float(now.cellVoid[gas].sum())
    if not volume > 0:
        return 0.0
    bodies = now.cellVertices[gas]
    return float(np.sum(signedAreas(now, bodies) - signedAreas(start, bodies))) * now.thickness / volume


def _ends(now, gas, place, graph, inlet, outlet):
    """Nodes at which a way may end, and whether these are at the outlet: else the one farthest from the inlet."""
    walls = now.wallIds if outlet == "any" else now.wallIds[[WALL_NAMES.index(outlet)]]
    reached = graph.reached(inlet)
    atOutlet = np.flatnonzero(reached & np.isin(now.cellVertices[gas], walls).any(axis=1))
    if len(atOutlet) or not reached.any():
        return atOutlet, len(atOutlet) > 0
    away = np.linalg.norm(place[:, None] - place[None, inlet], axis=2).min(axis=1)
    return np.array([np.argmax(np.where(reached, away, -1.0))]), False


class _Graph:
    """Cells of gas and the edges between them."""

    def __init__(self, count, ends, kinds):
        self.count, self.kinds = count, kinds
        # Of several edges between two cells the easiest counts.
        rank = np.select([kinds == PORE, kinds == OPENED], [0, 1], 2)
        order = np.argsort(rank, kind="stable")
        self.pairs, first = np.unique(np.sort(ends[order], axis=1), axis=0, return_index=True)
        self.edge = order[first]

    def _search(self, inlet, cost):
        graph = coo_array((cost, (self.pairs[:, 0], self.pairs[:, 1])), shape=(self.count, self.count)).tocsr()
        far, parent, _ = dijkstra(graph, directed=False, indices=inlet, min_only=True, return_predecessors=True)
        return far, parent

    def reached(self, inlet):
        """(n,) bool: what hangs on the inlet."""
        if len(inlet) == 0:
            return np.zeros(self.count, dtype=bool)
        return np.isfinite(self._search(inlet, np.ones(len(self.edge)))[0])

    def way(self, inlet, ends, avoided):
        """The :class:`Way` to one of ``ends`` with the fewest edges of the kind ``avoided``; of these with the fewest
        throats, then with the fewest cells.
        """
        if len(inlet) == 0 or len(ends) == 0:
            return Way(np.array([], dtype=int), 0, 0)
        kinds, many = self.kinds[self.edge], self.count + 1.0
        far, parent = self._search(inlet, np.select([kinds == avoided, kinds == PORE], [1.0, many**-2], 1 / many))
        node = ends[np.argmin(far[ends])]
        edgeOf = dict(zip(map(tuple, self.pairs.tolist()), kinds))
        cells, passed = [node], []
        while parent[node] >= 0:
            passed.append(edgeOf[min(node, parent[node]), max(node, parent[node])])
            node = parent[node]
            cells.append(node)
        return Way(np.array(cells[::-1]), passed.count(OPENED), passed.count(RIGID))
