"""GasInvasionEngine on packings that stand still: which pores the gas enters, in which order, at which pressure.

The oracle below is written on the lists that the engine reports of its initial state and on nothing else of it: no heap,
no union-find, every throat looked at again before each step. Entry pressures are those of the lists, so the comparison
is exact. (tests/verification checks the entry pressures themselves.)
"""

import numpy as np
import pytest
from yade import O
from yade.wrapper import ForceResetter, GasInvasionEngine

R = 1e-3


@pytest.fixture
def rigid(loadSample, looseDisks, handScene):
    """A function (packing, order, **attributes) -> gas engine, alone with the reset of forces; nothing moves.

    ``packing``: "settled" (grains touch: pores of several cells) or "loose" (25 disks that do not touch).
    ``order`` renumbers the grains.
    """

    def make(packing, order=None, **attributes):
        if packing == "settled":
            loadSample()
            disks = [(b.state.pos[0], b.state.pos[1], b.shape.radius) for b in O.bodies if hasattr(b.shape, "radius")]
            walls = [b.state.pos[b.shape.axis] for b in list(O.bodies)[:4]]
        else:
            disks, walls = looseDisks(seed=7)
        handScene([disks[k] for k in (range(len(disks)) if order is None else order)], walls)
        # Without contacts there is no rest in the sense of small forces: let every level end by itself.
        gas = GasInvasionEngine(checkInvariants=True, minLevelSteps=1, maxLevelSteps=1, **attributes)
        if "inletPoints" not in attributes and "inletTo" not in attributes:
            gas.inletFrom, gas.inletTo = gas.inletStretch(2, 0.5 * (walls[0] + walls[1]))
        O.engines = [ForceResetter(), gas]
        return O.engines[1]

    return make


class Oracle:
    """Drainage by looking at everything again at each step."""

    def __init__(self, gas, trapping, outlet=3):
        cells, self.trapping = gas.cells(), trapping
        throats = gas.throats()
        self.edges = [(tuple(ids), left, right, p, isOpen) for ids, p, (left, right), isOpen in
                      zip(throats["ids"], throats["entryPressure"], throats["cells"], throats["open"]) if left >= 0 and right >= 0]
        self.vertices = [tuple(v) for v in cells["vertices"]]
        self.gas = set(c for c, phase in enumerate(cells["phase"]) if phase)
        self.joined = gas.poreMode == "domain"
        self.atOutlet = {c for c, v in enumerate(self.vertices) if outlet in v}
        self.events = []

    def grow(self, seed, members, through):
        """All of `members` that can be reached from `seed` over the edges that `through` lets pass."""
        found = set(seed)
        while True:
            more = {b for ids, left, right, p, isOpen in self.edges if through(isOpen)
                    for a, b in ((left, right), (right, left)) if a in found and b in members and b not in found}
            if not more:
                return found
            found |= more

    def pore(self, cell):
        """The cells of water that hang together with this one without a throat between."""
        water = set(range(len(self.vertices))) - self.gas
        return self.grow({cell}, water, lambda isOpen: isOpen) if self.joined else {cell}

    def drained(self):
        """Cells of water that the outlet can be reached from."""
        water = set(range(len(self.vertices))) - self.gas
        return self.grow(water & self.atOutlet, water, lambda isOpen: True) if self.trapping else water

    def advance(self, pressure):
        while True:
            free = self.drained()
            front = [(p, ids, a if a in free else b) for ids, a, b, p, _ in self.edges
                     if p <= pressure and ((a in self.gas and b in free) or (b in self.gas and a in free))]
            if not front:
                return
            p, ids, cell = min(front)
            entered = self.pore(cell)
            self.events.append((ids, p, {self.vertices[c] for c in entered}))
            self.gas |= entered


def assertSameEvents(events, oracle):
    assert len(events["throat"]) == len(oracle.events)
    for k, (ids, pressure, cells) in enumerate(oracle.events):
        assert tuple(events["throat"][k]) == ids, f"event {k}"
        assert events["entryPressure"][k] == pressure
        assert tuple(events["pore"][k]) in cells and events["cells"][k] == len(cells)


@pytest.mark.parametrize("trapping", [False, True])
@pytest.mark.parametrize("packing, poreMode", [("settled", "domain"), ("settled", "triangle"), ("loose", "triangle")])
def test_eventsAreThoseOfTheOracle(rigid, packing, poreMode, trapping):
    gas = rigid(packing, poreMode=poreMode, trapping=trapping)
    oracle = Oracle(gas, trapping)
    entry = sorted(p for p in gas.throats()["entryPressure"] if p > 0)
    for pressure in np.linspace(entry[0], entry[-1], 15):
        gas.gasPressure = pressure
        O.step()
        oracle.advance(pressure)
        assertSameEvents(gas.events(), oracle)
        phases = gas.cells()["phase"]
        assert {c for c, phase in enumerate(phases) if phase} == oracle.gas
    assert len(oracle.events) > 10
    if trapping:
        stays = set(range(len(phases))) - oracle.gas - oracle.drained()
        assert stays or packing == "loose"
        assert gas.nTrappedWater == len({gas.cells()["domain"][c] for c in stays})
    else:
        assert all(phases) and gas.gasSaturation == pytest.approx(1, abs=1e-14)


@pytest.mark.parametrize("packing, poreMode, trapping", [("settled", "domain", False), ("settled", "domain", True), ("loose", "triangle", False)])
def test_renumberedGrainsGiveTheSameEvents(rigid, packing, poreMode, trapping):
    def run(order):
        gas = rigid(packing, order, poreMode=poreMode, trapping=trapping, gasPressure=20, pressureIncrement=10, maxPressure=300)
        O.run(400, True)
        assert gas.rampDone
        return gas, gas.events()

    count = 60 if packing == "settled" else 25
    plain, events = run(range(count))
    order = np.random.default_rng(4).permutation(count)
    shuffled, events2 = run(order)
    name = lambda body: int(order[body - 4]) + 4 if body >= 4 else body
    assert [frozenset(t) for t in events["throat"]] == [frozenset(map(name, t)) for t in events2["throat"]]
    for column in ("iteration", "level", "gasPressure", "cells"):
        assert events[column] == events2[column]
    # Sums of a few numbers in another order; places are some 20 radii from the origin, volumes of cells some r^2.
    for column, size in (("entryPressure", 300), ("gap", R), ("x", 20 * R), ("y", 20 * R), ("volume", 10 * R**2)):
        np.testing.assert_allclose(events[column], events2[column], rtol=0, atol=1e-14 * size)
    assert plain.breakthroughPressure == shuffled.breakthroughPressure


def test_rampIsMonotoneAndNoThroatOpensBelowItsEntryPressure(rigid):
    gas = rigid("settled", gasPressure=100, pressureIncrement=5, maxPressure=250, waterPressure=30)
    O.run(1000, True)
    events, levels = gas.events(), gas.levels()
    assert gas.rampDone and gas.nEvents == len(events["throat"]) > 20
    assert all(p <= g - 30 for p, g in zip(events["entryPressure"], events["gasPressure"]))
    assert levels["pressure"] == sorted(levels["pressure"]) == [100 + 5 * k for k in range(31)]
    for column in ("gasSaturation", "gasVolume", "iteration"):
        assert levels[column] == sorted(levels[column])
    assert events["level"] == sorted(events["level"]) and events["iteration"] == sorted(events["iteration"])
    assert not any(events["opened"]) and not any(events["bondBroken"])  # nothing moved
    assert levels["gasVolume"][-1] == pytest.approx(gas.volumes()["gas"], rel=1e-14)


def test_breakthroughIsNoted(rigid):
    gas = rigid("settled", gasPressure=100, pressureIncrement=5, maxPressure=250)
    while gas.breakthroughIter < 0:
        assert np.isnan(gas.breakthroughPressure)
        cells = gas.cells()
        assert not any(phase and 3 in v for phase, v in zip(cells["phase"], cells["vertices"]))
        pressure = gas.gasPressure
        O.step()
    cells = gas.cells()
    assert any(phase and 3 in v for phase, v in zip(cells["phase"], cells["vertices"]))
    assert (gas.breakthroughPressure, gas.breakthroughIter) == (pressure, O.iter - 1)
    assert gas.breakthroughBroken == 0 and gas.breakthroughDisplacement == 0


def test_inletAtTheOutletHasBrokenThrough(rigid):
    gas = rigid("settled", outletWall="bottom")
    O.run(20, True)
    assert gas.breakthroughIter >= 0


@pytest.mark.parametrize("wall, axis", [("bottom", 0), ("top", 0), ("left", 1), ("right", 1)])
def test_inletOfSomePores(rigid, wall, axis):
    gas = rigid("settled", inletTo=1, inletWall=wall)
    middle = 0.5 * sum(b.state.pos[axis] for b in list(O.bodies)[2 * axis:2 * axis + 2])
    gas.inletFrom, gas.inletTo = gas.inletStretch(3, middle)
    gas.prepare()
    assert gas.inletPores == 3
    cells = gas.cells()
    assert len({d for d, inlet in zip(cells["domain"], cells["inlet"]) if inlet}) == 3
    assert [bool(phase) for phase in cells["phase"]] == cells["inlet"]
    # Width on record: what the polygons of the inlet's cells have of the wall.
    place = O.bodies[["left", "right", "bottom", "top"].index(wall)].state.pos[1 - axis]
    width = 0
    for polygon, inlet in zip(cells["polygon"], cells["inlet"]):
        on = [corner[axis] for corner in polygon if corner[1 - axis] == place]
        width += max(on) - min(on) if inlet and on else 0
    assert gas.inletWidth == pytest.approx(width, rel=1e-13)
    assert gas.inletWidth == pytest.approx(gas.inletTo - gas.inletFrom, rel=1e-13)
    assert abs(0.5 * (gas.inletFrom + gas.inletTo) - middle) < 4 * R  # as near to the middle as pores of 2-4 mm allow


def wallExtent():
    """Begin and end of the bottom wall [m]."""
    return tuple(b.state.pos[0] for b in list(O.bodies)[:2])


def test_inletOfTheWholeWall(rigid):
    gas = rigid("settled", inletTo=1)
    gas.inletFrom, gas.inletTo = wallExtent()
    cells = gas.cells()
    assert all(inlet for v, inlet in zip(cells["vertices"], cells["inlet"]) if 2 in v)
    assert gas.inletWidth == pytest.approx(gas.inletTo - gas.inletFrom, rel=1e-13)


def test_inletTakesPoresByTheirMiddle(rigid):
    gas = rigid("settled", inletTo=1)
    begin, end = gas.inletStretch(1, np.mean(wallExtent()))
    for low, high, taken in ((0.45, 0.55, 1), (0.55, 0.9, 0)):
        gas = rigid("settled", inletFrom=begin + low * (end - begin), inletTo=begin + high * (end - begin))
        if taken:
            gas.prepare()
            assert gas.inletPores == taken and gas.inletWidth == pytest.approx(end - begin, rel=1e-12)
        else:
            with pytest.raises(ValueError, match="no inlet: no pore of the bottom wall has its middle between inletFrom and inletTo"):
                gas.prepare()


def test_inletOfPoints(rigid):
    gas = rigid("settled", inletTo=1)
    gas.inletFrom, gas.inletTo = wallExtent()
    polygons = [np.array(polygon) for polygon in gas.cells()["polygon"]]
    target = max(range(len(polygons)), key=lambda c: polygons[c][:, 1].min())  # the highest: certainly not at the inlet wall
    gas = rigid("settled", inletPoints=[tuple(polygons[target].mean(axis=0))])
    cells = gas.cells()
    assert gas.inletPores == 1 and gas.inletWidth == 0
    assert cells["inlet"][target] and cells["phase"][target] == 1
    assert {cells["domain"][c] for c, inlet in enumerate(cells["inlet"]) if inlet} == {cells["domain"][target]}


def test_nextEntryPressureIsThatOfTheNextEvent(rigid):
    gas = rigid("settled", gasPressure=1)
    for _ in range(10):
        pressure = gas.nextEntryPressure()
        gas.gasPressure = pressure * (1 - 1e-12)
        before = gas.nEvents
        O.step()
        assert gas.nEvents == before
        gas.gasPressure = pressure
        O.step()
        assert gas.nEvents > before and gas.events()["entryPressure"][before] == pressure


def test_cellPressuresAreNotToBeSet(rigid):
    gas = rigid("settled")
    with pytest.raises(ValueError, match="use a PoreNetworkEngine"):
        gas.setCellPressures([5.0] * len(gas.cells()["void"]))
