# SPDX-License-Identifier: GPL-2.0-or-later
"""GasInvasionEngine on packings that stand still: which pores the gas enters, in which order, at which pressure.

The oracle below is written on the lists that the engine reports of its initial state and on nothing else of it: no
heap, no union-find, every throat looked at again before each step. Entry pressures are those of the lists, so the
comparison is exact. (tests/verification checks the entry pressures themselves.)
"""

import numpy as np
import pytest
from yade import O

R = 1e-3


class Oracle:
    """Drainage by looking at everything again at each step."""

    def __init__(self, gas, trapping, outlet=3):
        cells, self.trapping = gas.cells(), trapping
        throats = gas.throats()
        self.edges = [
            (tuple(ids), left, right, p, isOpen)
            for ids, p, (left, right), isOpen in zip(
                throats["ids"], throats["entryPressure"], throats["cells"], throats["open"]
            )
            if left >= 0 and right >= 0
        ]
        self.vertices = [tuple(v) for v in cells["vertices"]]
        self.gas = set(c for c, phase in enumerate(cells["phase"]) if phase)
        self.joined = gas.poreMode == "domain"
        self.atOutlet = {c for c, v in enumerate(self.vertices) if outlet in v}
        self.events = []

    def grow(self, seed, members, through):
        """All of `members` that can be reached from `seed` over the edges that `through` lets pass."""
        found = set(seed)
        while True:
            more = {
                b
                for ids, left, right, p, isOpen in self.edges
                if through(isOpen)
                for a, b in ((left, right), (right, left))
                if a in found and b in members and b not in found
            }
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
            front = [
                (p, ids, a if a in free else b)
                for ids, a, b, p, _ in self.edges
                if p <= pressure and ((a in self.gas and b in free) or (b in self.gas and a in free))
            ]
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


@pytest.mark.parametrize(
    "packing, poreMode, trapping",
    [("settled", "domain", False), ("settled", "domain", True), ("loose", "triangle", False)],
)
def test_renumberedGrainsGiveTheSameEvents(rigid, packing, poreMode, trapping):
    def run(order):
        gas = rigid(
            packing, order, poreMode=poreMode, trapping=trapping, gasPressure=20, pressureIncrement=10, maxPressure=300
        )
        O.run(400, True)
        assert gas.rampDone
        return gas, gas.events()

    count = 60 if packing == "settled" else 25
    plain, events = run(range(count))
    order = np.random.default_rng(4).permutation(count)
    shuffled, events2 = run(order)

    def name(body):
        return int(order[body - 4]) + 4 if body >= 4 else body

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


def test_onePoreAtATimeEndsWhereTheAvalancheEnds(rigid):
    """In grains that stand still the pace of the gas changes when a pore is entered, not which and through what."""

    def run(interval):
        gas = rigid("settled", gasPressure=100, pressureIncrement=20, maxPressure=220, invasionInterval=interval)
        O.run(4000, True)
        assert gas.rampDone
        return gas.events()

    avalanche, paced = run(0), run(7)
    for column in ("throat", "pore", "entryPressure", "level", "gasPressure", "volume"):
        assert avalanche[column] == paced[column]
    assert len(set(avalanche["iteration"])) < len(avalanche["iteration"])  # several pores in one step
    assert min(np.diff(paced["iteration"])) >= 7


@pytest.mark.parametrize(
    "name, good, bad",
    [
        ("interfacialTension", 0.072, -1.0),
        ("contactAngle", 0.5, 2.0),
        ("gasPressure", 10.0, float("nan")),
        ("entryLaw", "mayerStowePrincen", "young"),
        ("inletWall", "left", "floor"),
        ("invasionInterval", 3, -1),
        ("minLevelSteps", 5, 0),
        ("thickness", 2.0, 0.0),
        ("poreMode", "triangle", "hexagon"),
    ],
)
def test_refusedAssignmentsChangeNothing(name, good, bad):
    from yade.wrapper import GasInvasionEngine

    gas = GasInvasionEngine()
    first = getattr(gas, name)
    with pytest.raises(ValueError, match="allowed:"):
        setattr(gas, name, bad)
    assert getattr(gas, name) == first
    setattr(gas, name, good)
    with pytest.raises(ValueError, match="allowed:"):
        setattr(gas, name, bad)
    assert getattr(gas, name) == good
    gas.thickness = 3.0  # nothing is left of the refused value
