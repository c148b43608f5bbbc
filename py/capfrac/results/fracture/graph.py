# SPDX-License-Identifier: GPL-2.0-or-later
"""The fracture as a graph: which throats have opened, where its tips are, how it branches.

Nodes are cells that hold gas. Two of them hang together where the throat between them is *cracked* (its bond broken, or
its gap grown by more than ``CRACKED`` mean radii since the start: more than an intact bond stretches) or was open at
the start, the inside of a pore. Throats that gas entered without that are bridges: where a part of the fracture hangs
on the inlet through them only, the fewest that will do are taken, and counted. The distance of a node is its way to the
inlet.

Where the distance is largest locally there is a tip; a tip's branch ends where, on the way in, its part of the fracture
meets that of a tip farther out (the elder rule of persistent homology; Kanari et al. 2018, Neuroinformatics 16, 3-13,
describe the shape of neurons so). A branch counts if it is ``SHORTEST`` mean grain diameters or longer. So a straight
crack has two tips when the inlet is within it and one when it is at its end, a star has one for each arm, and a round
blob has one, however rough its rim.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, dijkstra

from capfrac.errors import CaseError
from capfrac.results.fracture.inlet import inletNodes
from capfrac.results.fracture.throats import cellCentres, gapsOf, mergeGap, openedThroats

#: Length of the shortest branch that counts, in mean grain diameters [-]: a pore of this model is one or two across.
SHORTEST = 4.0

#: Growth of a gap from which a throat is cracked though its bond may hold, in mean radii [-]. Bonds break at a stretch
#: of 2 chi gamma w/k_n, 0.067 mean radii in the softest of the shipped cases.
CRACKED = 0.1

#: Share of cracked throats on a branch, from which it is one of the fracture and not of capillary invasion [-]; as in
#: mode.RULE_BY_THROATS.
MOST_OPENED = 0.5

#: How much longer a way through a bridge is taken to be than one through the fracture [-].
_DETOUR = 20.0


@dataclass(eq=False)
class Branch:
    """A branch, from its root to its tip. Angles are axial: in [0, 180) degrees from the horizontal, anticlockwise."""

    path: np.ndarray  #: (k, 2) from root to tip, centres of cells [m]
    distance: np.ndarray  #: (k,) of these to the inlet through the gas [m]
    openedThroats: int  #: cracked throats on the path [-]
    rigidThroats: int  #: bridges on the path: neither cracked nor open at the start [-]

    @property
    def tip(self):
        """(2,) where it ends [m]."""
        return self.path[-1]

    @property
    def length(self):
        """Along the gas [m]."""
        return float(self.distance[-1] - self.distance[0])

    @property
    def angle(self):
        """Direction from root to tip [degrees], in [0, 180)."""
        x, y = self.path[-1] - self.path[0]
        return float(np.degrees(np.arctan2(y, x)) % 180)

    @property
    def openedShare(self):
        """Cracked throats over these and bridges on the path [-]; NaN where it crosses neither."""
        throats = self.openedThroats + self.rigidThroats
        return self.openedThroats / throats if throats else float("nan")

    @property
    def isFracture(self):
        """Whether at least ``MOST_OPENED`` of its throats are cracked."""
        return bool(self.openedShare >= MOST_OPENED)


@dataclass(eq=False)
class Fracture:
    """What :func:`findFracture` finds."""

    #: (t,) growth of the gap of each throat of the snapshot since the start [m]; NaN between two walls
    aperture: np.ndarray
    opened: np.ndarray  #: (t,) bool: grown by more than the engine's openingThreshold, or the bond broken
    cracked: np.ndarray  #: (t,) bool: grown by more than ``CRACKED`` mean radii, or the bond broken
    inGas: np.ndarray  #: (t,) bool: gas on both sides
    cells: np.ndarray  #: (k,) rows of the cells that are nodes, in the snapshot
    place: np.ndarray  #: (k, 2) their centres [m]
    distance: np.ndarray  #: (k,) to the inlet along the fracture [m]
    diameter: float  #: mean diameter of the grains [m]
    branches: list = field(default_factory=list)  #: of any kind, the longest first

    @property
    def fractureBranches(self):
        """The branches of which most throats are cracked."""
        return [branch for branch in self.branches if branch.isFracture]

    def branchesAt(self, distance):
        """How many fracture branches reach past this ``distance`` from the inlet [m] and have their root nearer."""
        return sum(bool(branch.distance[0] <= distance < branch.distance[-1]) for branch in self.fractureBranches)


def findFracture(now, start, openingThreshold=0.01, shortest=SHORTEST):
    """The :class:`Fracture` in a snapshot ``now``; ``start`` is the snapshot before the injection.

    ``openingThreshold``: growth of a gap in mean radii from which a throat counts as opened [-], > 0 (that of the
    engine). ``shortest``: length of the shortest branch in mean grain diameters [-], > 0. Gas that does not hang
    together with the inlet belongs to no branch. :class:`CaseError` for impossible values and snapshots of different
    grains.
    """
    if not (np.isfinite(shortest) and shortest > 0):
        raise CaseError(f"shortest = {shortest}, allowed: > 0 mean grain diameters")
    aperture, opened = openedThroats(now, start, openingThreshold)
    cracked = openedThroats(now, start, CRACKED)[1]
    inGas = np.all(now.throatCells >= 0, axis=1) & np.all(now.gasCells[now.throatCells], axis=1)
    within = gapsOf(start, now.throatIds) > mergeGap(start)

    gas = np.flatnonzero(now.gasCells)
    place, row = cellCentres(now, gas), np.full(len(now.cellPhase), -1)
    row[gas] = np.arange(len(gas))
    throats = np.flatnonzero(inGas)
    kinds = np.where(cracked[throats], "cracked", np.where(within[throats], "within", "bridge"))
    ends = row[now.throatCells[throats]]
    distance, parent, via = _distances(place, ends, kinds, inletNodes(now, place))
    isNode = _fractureNodes(distance, parent, ends, kinds)
    joined = isNode[ends].all(axis=1) & ((kinds != "bridge") | np.isin(np.arange(len(throats)), via[isNode]))
    found = Fracture(
        aperture=aperture,
        opened=opened,
        cracked=cracked,
        inGas=inGas,
        cells=gas[isNode],
        place=place[isNode],
        distance=distance[isNode],
        diameter=2 * float(np.mean(now.r)),
    )
    for tip, root in _bars(np.where(isNode, distance, np.inf), ends[joined], shortest * found.diameter):
        found.branches.append(_branch(tip, root, distance, parent, via, place, kinds))
    found.branches.sort(key=lambda branch: (-branch.length, tuple(branch.tip)))
    return found


def _distances(place, ends, kinds, inlet):
    """Ways to the inlet with as few bridges as may be: length (k,), the next node on the way and the edge to it (-1 at
    the inlet).
    """
    n = len(place)
    if n == 0 or len(inlet) == 0:
        return np.full(n, np.inf), np.full(n, -1), np.full(n, -1)
    order = np.argsort(kinds == "bridge", kind="stable")  # of several edges between two nodes the first is kept
    pairs, first = np.unique(np.sort(ends[order], axis=1), axis=0, return_index=True)
    edge = order[first]
    # A length of zero would be no edge for scipy.
    length = np.maximum(np.linalg.norm(place[pairs[:, 0]] - place[pairs[:, 1]], axis=1), np.finfo(float).tiny)
    cost = length * np.where(kinds[edge] == "bridge", _DETOUR, 1.0)
    graph = coo_array((cost, (pairs[:, 0], pairs[:, 1])), shape=(n, n)).tocsr()
    far, parent, _ = dijkstra(graph, directed=False, indices=inlet, min_only=True, return_predecessors=True)
    edgeOf = {tuple(pair): (int(e), float(size)) for pair, e, size in zip(pairs.tolist(), edge, length)}
    distance, via = np.where(np.isfinite(far), 0.0, np.inf), np.full(n, -1)
    parent = np.where(parent >= 0, parent, -1)
    for node in np.argsort(far, kind="stable"):
        if parent[node] >= 0:
            via[node], step = edgeOf[min(node, parent[node]), max(node, parent[node])]
            distance[node] = distance[parent[node]] + step
    return distance, parent, via


def _fractureNodes(distance, parent, ends, kinds):
    """(k,) bool: nodes of parts with a cracked throat, and those on their ways to the inlet."""
    n = len(distance)
    hanging = ends[kinds != "bridge"]
    part = (
        connected_components(
            coo_array((np.ones(len(hanging)), (hanging[:, 0], hanging[:, 1])), shape=(n, n)), directed=False
        )[1]
        if n
        else np.array([], dtype=int)
    )
    isNode = np.isin(part, part[ends[kinds == "cracked"].ravel()]) & np.isfinite(distance)
    for node in np.flatnonzero(isNode):
        while parent[node] >= 0 and not isNode[parent[node]]:
            node = parent[node]
            isNode[node] = True
    isNode[np.isfinite(distance) & (distance <= 0)] |= isNode.any()
    return isNode


def _bars(distance, ends, shortest):
    """Tips and the distances of their roots: pairs (node, distance) with ``distance[node] - root >= shortest``.

    Nodes are taken from the farthest inwards. A node without a taken neighbour is a new tip; one that joins two parts
    ends the branch of the nearer tip. What is left at the end reaches the inlet.
    """
    neighbours = [[] for _ in distance]
    for a, b in ends.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    part, bars = {}, []

    def find(node):
        while part[node] != node:
            part[node] = part[part[node]]
            node = part[node]
        return node

    for node in sorted(np.flatnonzero(np.isfinite(distance)).tolist(), key=lambda k: (-distance[k], k)):
        if distance[node] <= 0:  # the inlet: all that arrives here has its root here, and does not end another
            break
        part[node] = node  # a part is named by its tip, which is its oldest node
        for other in sorted(
            {find(k) for k in neighbours[node] if k in part and k != node}, key=lambda k: (-distance[k], k)
        ):
            elder, younger = sorted((find(node), other), key=lambda k: (-distance[k], k))
            if elder == younger:
                continue
            if younger != node:
                bars.append((younger, distance[node]))
            part[younger] = elder
    bars += [(tip, 0.0) for tip in {find(k) for k in list(part)}]
    return sorted((tip, root) for tip, root in bars if distance[tip] - root >= shortest)


def _branch(tip, root, distance, parent, via, place, kinds):
    path, edges = [tip], []
    while distance[path[-1]] > root and parent[path[-1]] >= 0:
        edges.append(via[path[-1]])
        path.append(parent[path[-1]])
    crossed = kinds[edges] if edges else np.array([], dtype=str)
    return Branch(
        path=place[path[::-1]],
        distance=distance[path[::-1]],
        openedThroats=int((crossed == "cracked").sum()),
        rigidThroats=int((crossed == "bridge").sum()),
    )


def connectedParts(fracture, snapshot):
    """Number of separate parts of the cracked, gas-filled throats [-]: 1 for a fracture that hangs together."""
    throats = np.flatnonzero(fracture.inGas & fracture.cracked)
    if len(throats) == 0:
        return 0
    cells, ends = np.unique(snapshot.throatCells[throats], return_inverse=True)
    ends = ends.reshape(-1, 2)
    graph = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(len(cells), len(cells)))
    return int(connected_components(graph, directed=False)[0])
