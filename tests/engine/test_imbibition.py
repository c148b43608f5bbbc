# SPDX-License-Identifier: GPL-2.0-or-later
"""Imbibition, snap-off and trapped gas in packings that stand still, against an oracle that is written on the grains
alone.

The oracle computes thresholds from the disks by formulas of its own (a root finder for the widest place of a cell), and
looks at everything again after each event. Its order of events is not compared: at one pressure the state that they
lead to is.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq, fsolve
from yade import O

from capfrac import cycles

GAMMA = 0.05


def passing(rho, r):
    """Radius of the sphere midway between two layers of spheres of radius r, rho off their centres in the plane."""
    return math.hypot(rho, r) - r


class Oracle:
    """Gas cells, cut-off cells and snapped throats, in domains as the engine reports them when all is water or gas."""

    def __init__(self, gas, snapOff):
        cells, throats = gas.cells(), gas.throats()
        self.vertices, self.polygon = cells["vertices"], cells["polygon"]
        self.disks = {
            b.id: (np.array(tuple(b.state.pos)[:2]), b.shape.radius) for b in O.bodies if hasattr(b.shape, "radius")
        }
        self.walls = {b.id: (b.shape.axis, b.state.pos[b.shape.axis]) for b in list(O.bodies)[:4]}
        self.edges = [
            (k, left, right, isOpen)
            for k, ((left, right), isOpen) in enumerate(zip(throats["cells"], throats["open"]))
            if left >= 0 and right >= 0
        ]
        self.inscribed = []
        for (a, b), gap in zip(throats["ids"], throats["gap"]):
            r, d = (
                (self.disks[max(a, b)][1], 2 * gap)
                if min(a, b) in self.walls
                else (0.5 * (self.disks[a][1] + self.disks[b][1]), gap)
            )
            self.inscribed.append(passing(r + 0.5 * d, r))
        self.snapOff = snapOff
        self.entry = [2 * GAMMA / r for r in self.inscribed]
        self.joined = gas.poreMode == "domain"
        self.gas, self.cutOff, self.snapped = set(), set(), set()
        self.inlet = {c for c, inlet in enumerate(cells["inlet"]) if inlet}
        self.atOutlet = {c for c, v in enumerate(self.vertices) if 3 in v}
        self.domainOf = self.domains()
        self.refill = self.refillPressures()

    def domains(self):
        label = list(range(len(self.vertices)))
        for changed in iter(
            lambda: self.joined and any([self.join(label, a, b) for _, a, b, isOpen in self.edges if isOpen]), False
        ):
            pass
        return label

    @staticmethod
    def join(label, a, b):
        low = min(label[a], label[b])
        changed = label[a] != low or label[b] != low
        label[a] = label[b] = low
        return changed

    def widest(self, cell):
        """Radius of the largest sphere whose centre lies in the cell, away from its sides; 0 if there is none."""
        grains = [self.disks[v] for v in self.vertices[cell] if v in self.disks]
        walls = [self.walls[v] for v in self.vertices[cell] if v in self.walls]
        r = np.mean([radius for _, radius in grains])
        if len(grains) == 3:
            start = np.append(np.mean([x for x, _ in grains], axis=0), 0.3 * r)
            x, y, s = fsolve(
                lambda u: [math.hypot(u[0] - c[0], u[1] - c[1]) - u[2] - radius for c, radius in grains],
                start,
                xtol=1e-12,
            )
            ring = [np.array(p) for p in self.polygon[cell]]
            if any(np.cross(ring[(k + 1) % 3] - ring[k], (x, y) - ring[k]) < 0 for k in range(3)):
                return 0
        elif len(grains) == 2:
            (axis, at), ((a, ra), (b, rb)) = walls[0], grains

            def place(t):
                return np.array([at, t] if axis == 0 else [t, at])

            def room(t):
                return np.linalg.norm(place(t) - a) - ra - np.linalg.norm(place(t) - b) + rb

            low, high = a[1 - axis], b[1 - axis]
            if room(low) * room(high) > 0:
                return 0
            s = np.linalg.norm(place(brentq(room, low, high, xtol=1e-18, rtol=1e-15)) - a) - ra
        else:
            corner = {axis: at for axis, at in walls}
            s = math.hypot(corner[0] - grains[0][0][0], corner[1] - grains[0][0][1]) - grains[0][1]
        return passing(r + s, r)

    def refillPressures(self):
        widest = {d: 0 for d in set(self.domainOf)}
        for c, d in enumerate(self.domainOf):
            widest[d] = max(widest[d], self.widest(c))
        for k, left, right, _ in self.edges:
            for c in (left, right):
                widest[self.domainOf[c]] = max(widest[self.domainOf[c]], self.inscribed[k])
        return {d: 2 * GAMMA / r for d, r in widest.items()}

    def throats(self):
        return [(k, a, b) for k, a, b, _ in self.edges if self.domainOf[a] != self.domainOf[b]]

    def hanging(self):
        found, frontier = set(self.inlet), True
        while frontier:
            frontier = {
                y
                for k, a, b, _ in self.edges
                for x, y in ((a, b), (b, a))
                if x in found and y in self.gas and y not in found and k not in self.snapped
            }
            found |= frontier
        return found

    def members(self, cell):
        return {c for c, d in enumerate(self.domainOf) if d == self.domainOf[cell]}

    def go(self, pressure):
        """Drain and imbibe (films feed all water) until nothing happens at this pressure."""
        self.gas |= {c for i in self.inlet for c in self.members(i)}
        moved = True
        while moved:
            moved = False
            free = self.hanging()
            for k, a, b in self.throats():
                for x, y in ((a, b), (b, a)):
                    if x in free and pressure >= self.entry[k] and (y not in self.gas or k in self.snapped):
                        self.gas |= self.members(y)
                        self.snapped.discard(k)
                        moved = True
            if moved:
                continue
            events = [
                (self.entry[k] / 2, 0, k)
                for k, a, b in self.throats()
                if self.snapOff and a in free and b in free and k not in self.snapped
            ]
            wet = {
                c for k, a, b in self.throats() for x, c in ((a, b), (b, a)) if x not in self.gas or k in self.snapped
            } | self.atOutlet
            wet = {self.domainOf[c] for c in wet}
            events += [
                (self.refill[d], 1, d)
                for d in {self.domainOf[c] for c in free} & wet - {self.domainOf[i] for i in self.inlet}
            ]
            best = max(events, default=(0, 0, 0))
            if best[0] > pressure:
                moved = True
                if best[1]:
                    self.gas -= self.members(best[2])
                    self.snapped -= {k for k, a, b in self.throats() if a not in self.gas or b not in self.gas}
                else:
                    self.snapped.add(best[2])
        self.cutOff = self.gas - self.hanging()


@pytest.mark.parametrize(
    "packing, poreMode, snapOff",
    [
        ("settled", "domain", False),
        ("settled", "domain", True),
        ("loose", "triangle", True),
        ("settled", "triangle", True),
    ],
)
def test_cyclesAreThoseOfTheOracle(rigid, packing, poreMode, snapOff):
    gas = rigid(packing, poreMode=poreMode, imbibition=True, snapOff=snapOff)
    oracle = Oracle(gas, snapOff)
    top = 1.01 * max(oracle.entry)
    trapped = 0
    for pressure in [
        *np.linspace(0.3 * top, top, 8),
        *np.linspace(top, 0, 20),
        *np.linspace(0, top, 12),
        *np.linspace(top, 0, 6),
    ]:
        gas.gasPressure = pressure
        O.step()
        oracle.go(pressure)
        cells = gas.cells()
        assert {c for c, phase in enumerate(cells["phase"]) if phase} == oracle.gas, f"at {pressure} Pa"
        assert {c for c, held in enumerate(cells["cutOff"]) if held} == oracle.cutOff, f"at {pressure} Pa"
        trapped += len(oracle.cutOff)
        assert gas.volumes()["error"] < 1e-13
    kinds = gas.imbibitionEvents()["kind"]
    assert kinds.count("refill") > 20 and (
        not snapOff or (trapped and kinds.count("snapOff") and kinds.count("reopening"))
    )


def test_withoutImbibitionNothingComesBack(rigid):
    gas = rigid("settled", gasPressure=300)
    O.step()
    full = gas.gasSaturation
    gas.gasPressure = 0
    O.run(5, True)
    assert gas.gasSaturation == full and gas.nReturns == 0 and not any(gas.cells()["cutOff"])


def test_nothingTurnsBackAtOnePressure(rigid):
    # At exactly its entry pressure a pore that is nowhere wider than its throat could be refilled at once: it is not.
    gas = rigid("settled", imbibition=True, poreMode="triangle", gasPressure=1)
    while math.isfinite(gas.nextEntryPressure()):
        gas.gasPressure = max(gas.gasPressure, gas.nextEntryPressure())
        O.run(3, True)
    assert gas.nReturns == 0 and gas.nEvents > 50


def test_eventsOfImbibitionAreLogged(rigid):
    gas = rigid("settled", imbibition=True, snapOff=True, gasPressure=300)
    O.step()
    before = gas.volumes()["gas"]
    table = cycles.pressureCycle(gas, [("imbibition", 0)], increment=20)
    log = gas.imbibitionEvents()
    assert len(log["kind"]) == gas.nReturns > 10
    refills = [k for k, kind in enumerate(log["kind"]) if kind == "refill"]
    snaps = [k for k, kind in enumerate(log["kind"]) if kind == "snapOff"]
    assert math.fsum(log["volume"][k] for k in refills) == pytest.approx(before - gas.volumes()["gas"], rel=1e-12)
    assert all(log["threshold"][k] > log["gasPressure"][k] for k in refills + snaps)
    entry = {tuple(sorted(ids)): p for ids, p in zip(gas.throats()["ids"], gas.throats()["entryPressure"])}
    for k in snaps:  # half of the entry pressure at theta = 0: two roundings
        assert log["threshold"][k] == pytest.approx(0.5 * entry[tuple(sorted(log["throat"][k]))], rel=1e-14)
    assert table["gasSaturation"][-1] < 1 and table["trappedGas"][-1] <= table["gasSaturation"][-1]


def test_trappedGasKeepsItsAmountAndPressure(rigid):
    gas = rigid("settled", imbibition=True, snapOff=True, gasPressure=300, waterPressure=50)
    O.step()
    amounts = {}
    for pressure in np.linspace(300, 50, 26):
        gas.gasPressure = pressure
        O.step()
        cells = gas.cells()
        for c, held in enumerate(cells["cutOff"]):
            if not held:
                assert c not in amounts  # while the pressure falls nothing is let go
            elif c not in amounts:
                amounts[c] = (cells["gas"][c], pressure)
            assert not held or (cells["gas"][c], cells["pressure"][c]) == amounts[c]
    assert len(amounts) > 5 and len({p for _, p in amounts.values()}) > 1


@pytest.mark.parametrize(
    "attributes, message",
    [
        (dict(snapOff=True, contactAngle=0.8), r"contactAngle \[rad\] = 0.8, allowed: < pi/4 with snapOff"),
        (dict(filmConductance=-1.0, trapping=True), r"filmConductance \[m³/\(Pa·s\)\] = -1, allowed: finite and >= 0"),
        (dict(filmConductance=1e-12), "filmConductance .* allowed: 0 without trapping"),
        (dict(fluidDensity=-1.0), r"fluidDensity \[kg/m³\] = -1"),
        (dict(gravity=(0, float("nan"))), r"gravity \[m/s²\] = nan"),
    ],
)
def test_impossibleValuesAreRefused(attributes, message):
    from yade.wrapper import GasInvasionEngine

    with pytest.raises(ValueError, match=message):
        GasInvasionEngine(**attributes)


def test_refusedAssignmentsChangeNothing():
    from yade.wrapper import GasInvasionEngine

    gas = GasInvasionEngine(snapOff=True, contactAngle=0.5)
    for name, bad, good in (("contactAngle", 0.9, 0.1), ("fluidDensity", -5.0, 5.0), ("filmConductance", 1.0, 0.0)):
        before = getattr(gas, name)
        with pytest.raises(ValueError, match="allowed:"):
            setattr(gas, name, bad)
        assert getattr(gas, name) == before
        setattr(gas, name, good)
    gas.snapOff, gas.contactAngle = False, 0.9
    with pytest.raises(ValueError, match="with snapOff"):
        gas.snapOff = True
    assert not gas.snapOff and gas.contactAngle == 0.9


def test_waterNeedsAWayOut(handScene):
    from yade.wrapper import GasInvasionEngine

    handScene([(1e-3, 1e-3, 1e-3)], (0, 2.2e-3, 0, 2.2e-3))
    with pytest.raises(
        ValueError,
        match="no outlet for the water: outletWall = 'bottom', allowed: a wall with a pore that is not the inlet's",
    ):
        GasInvasionEngine(
            inletWall="bottom", outletWall="bottom", inletFrom=0, inletTo=2.2e-3, imbibition=True
        ).prepare()


def test_cycleInGrainsThatMove(loadSample):
    """The books through a whole cycle, and the loop: coarse, bonded grains under load."""
    from capfrac import injection

    loadSample()
    gas = injection.startInjection(
        start=100,
        increment=0,
        max=101,
        pores=2,
        imbibition=True,
        snapOff=True,
        checkInvariants=True,
        minLevelSteps=10,
        maxLevelSteps=2000,
    )
    errors = []
    table = cycles.pressureCycle(
        gas,
        [("drainage", 230), ("imbibition", 0), ("second drainage", 230)],
        increment=25,
        progress=lambda *_: errors.append(gas.volumes()["error"]),
    )
    assert max(errors) < 1e-10
    found = cycles.measure(table)
    assert (
        found["maximum"] > 0.9 and found["area"] > 0 and 0 <= found["trapped"] <= found["residual"] < found["maximum"]
    )


@pytest.mark.parametrize(
    "arguments, message",
    [((dict(increment=0),), "increment = 0 Pa"), ((dict(stages=[("down", -1)]),), "a stage ends at -1 Pa")],
)
def test_impossibleCyclesAreRefused(rigid, arguments, message):
    from capfrac.errors import CaseError

    with pytest.raises(CaseError, match=message):
        cycles.pressureCycle(rigid("settled"), **{"stages": [("up", 10)], "increment": 1, **arguments[0]})
