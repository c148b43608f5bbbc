"""PoreNetworkEngine: its forces are the gradient of sum p V, its volumes fill the box, its domains follow the contacts.

The grains stand where a test puts them (all degrees of freedom blocked); the engine alone is run.
"""

import math

import numpy as np
import pytest
from yade import O
from yade.wrapper import ForceResetter, PoreNetworkEngine

R = 1e-3


def energy(engine, pressures):
    """sum p V [J] of the cells as the grains stand now."""
    return float(np.dot(pressures, engine.cells()["void"]))


def forcesInScene():
    return {body.id: np.array(O.forces.f(body.id))[:2] for body in O.bodies}


def randomPressures(engine, seed=3):
    return np.random.default_rng(seed).uniform(0, 1e3, len(engine.cells()["void"]))


@pytest.fixture
def networkOf(handScene):
    """A function (disks, box, **attributes) -> engine in O.engines, alone with the reset of forces, prepared."""

    def make(disks, box, **attributes):
        handScene(disks, box)
        O.engines = [ForceResetter(), PoreNetworkEngine(label="network", **attributes)]
        engine = O.engines[1]
        engine.prepare()
        return engine

    return make


@pytest.fixture
def square(networkOf):
    """A function (gap, **attributes) -> engine of four grains of radius R on a square, `gap` apart and from the walls."""

    def make(gap, **attributes):
        low, high, side = R + gap, 3 * R + 2 * gap, 4 * R + 3 * gap
        return networkOf([(low, low, R), (high, low, R), (low, high, R), (high, high, R)], (0, side, 0, side), **attributes)

    return make


def overlapping(disks):
    """The same disks 3 % larger: some pairs then overlap."""
    return [(x, y, 1.03 * r) for x, y, r in disks]


@pytest.mark.parametrize("change", [lambda disks: disks, overlapping])
def test_forcesAreTheGradientOfPressureTimesVolume(networkOf, looseDisks, change):
    disks, box = looseDisks(count=14, seed=5)
    # No remeshing between the two sides of the difference: it would drop the pressures.
    engine = networkOf(change(disks), box, thickness=0.5, remeshDisplacement=1)
    pressures = randomPressures(engine)
    engine.setCellPressures(list(pressures))
    O.step()
    forces, reported = forcesInScene(), engine.fluidForces()
    # Central difference with the step h: error h^2/6 |V'''| ~ (h/R)^2 relative, and round-off 1e-16 sum(p V)/(p R h) of
    # some 10 R/h 1e-16. Both are below 1e-9 at h = 1e-5 R; where a pair just touches V''' is singular: hence 1e-6.
    h, scale = 1e-5 * R, max(np.linalg.norm(f) for f in forces.values())
    for body in O.bodies:
        axes = [body.shape.axis] if not hasattr(body.shape, "radius") else [0, 1]
        start = body.state.pos
        for axis in axes:
            sides = []
            for sign in (1, -1):
                step = [0, 0, 0]
                step[axis] = sign * h
                body.state.pos = start + type(start)(*step)
                sides.append(energy(engine, pressures))
            body.state.pos = start
            difference = (sides[0] - sides[1]) / (2 * h)
            assert forces[body.id][axis] == pytest.approx(difference, abs=1e-6 * scale)
            assert reported[body.id][axis] == pytest.approx(forces[body.id][axis], abs=1e-14 * scale)


@pytest.mark.parametrize("change", [lambda disks: disks, overlapping])
def test_forcesSumToZero(networkOf, looseDisks, change):
    disks, box = looseDisks(seed=2)
    engine = networkOf(change(disks), box)
    engine.setCellPressures(list(randomPressures(engine)))
    forces = np.array(list(engine.fluidForces().values()))
    assert np.all(np.abs(forces.sum(axis=0)) < 1e-12 * np.abs(forces).sum())


def test_uniformPressureLoadsTheWallsWithItsLength(networkOf, looseDisks):
    # The grains stand off the walls, so the fluid touches all of each wall and goes all the way round each grain.
    disks, box = looseDisks(seed=4)
    networkOf(disks, box, waterPressure=2e5, thickness=0.3)
    O.step()
    forces, side = forcesInScene(), box[1]
    load = 2e5 * side * 0.3
    for wall, direction in zip(range(4), ([-1, 0], [1, 0], [0, -1], [0, 1])):
        np.testing.assert_allclose(forces[wall], np.multiply(direction, load), rtol=1e-12, atol=1e-12 * load)
    for body in list(O.bodies)[4:]:
        assert np.linalg.norm(forces[body.id]) < 1e-12 * load


def test_voidsFillTheBoxBesideTheGrains(networkOf, looseDisks):
    disks, box = looseDisks(seed=6)
    engine = networkOf(disks, box, thickness=2)
    void = box[1] ** 2 - sum(math.pi * r**2 for _, _, r in disks)
    assert math.fsum(engine.cells()["void"]) == pytest.approx(2 * void, rel=1e-12)
    assert engine.volumes()["void"] == pytest.approx(2 * void, rel=1e-12)


def test_voidsCountOverlapsOnce(square):
    # Neighbours overlap by u: four lenses inside, and eight segments that the walls cut off.
    u = 0.01 * R
    engine = square(-u)
    half = R - u / 2
    lens = 2 * (R**2 * math.acos(half / R) - half * math.sqrt(R**2 - half**2))
    segment = R**2 * math.acos((R - u) / R) - (R - u) * math.sqrt(R**2 - (R - u) ** 2)
    void = (4 * R - 3 * u) ** 2 - 4 * math.pi * R**2 + 4 * lens + 8 * segment
    assert math.fsum(engine.cells()["void"]) == pytest.approx(void, rel=1e-12)


def test_domainsFollowContacts(square):
    # All grains and walls touch: the pore in the middle (two cells), four corners, one pore at the middle of each wall.
    engine = square(-1e-4 * R)
    assert (engine.nCells, engine.nDomains) == (10, 9)
    # The right pair moves away from the left one: middle, bottom and top pores become one.
    right = [6 - 1, 8 - 1]
    for i in right:
        O.bodies[i].state.pos += (0.005 * R, 0, 0)
    O.bodies[1].state.pos += (0.005 * R, 0, 0)
    O.step()
    assert engine.nDomains == 7
    # Back to a gap of 0.7 of the tolerance: still open, because it closes below half of it only.
    gaps = engine.throats()["gap"]
    here = max(gaps[k] for k, ids in enumerate(engine.throats()["ids"]) if tuple(ids) == (4, 5))
    for wanted, domains in ((0.7e-3 * R, 7), (0.4e-3 * R, 9), (0.7e-3 * R, 9), (1.1e-3 * R, 7)):
        for i in right + [1]:
            O.bodies[i].state.pos += (wanted - here, 0, 0)
        here = wanted
        O.step()
        assert engine.nDomains == domains


def test_openDomainIsOnePoreAndOneVolume(square):
    engine = square(0.1 * R)
    assert engine.nDomains == 1
    cells = engine.cells()
    assert set(cells["domain"]) == {0}
    assert math.fsum(cells["water"]) == pytest.approx(engine.volumes()["void"], rel=1e-14)
    assert not any(cells["gas"]) and not any(cells["phase"])


def test_trianglesAreTheirOwnPores(square):
    engine = square(0.1 * R, poreMode="triangle")
    assert engine.nDomains == engine.nCells == 10
    assert sorted(engine.cells()["domain"]) == list(range(10))


def test_poreModeCanBeChanged(square):
    engine = square(0.1 * R)
    engine.poreMode = "triangle"
    assert len(set(engine.cells()["domain"])) == 10


def test_pressuresMustFitTheCells(square):
    engine = square(0.1 * R)
    with pytest.raises(ValueError, match="9 values, allowed: one for each of the 10 cells"):
        engine.setCellPressures([0.0] * 9)
    engine.setCellPressures([5.0] * 10)
    assert set(engine.cells()["pressure"]) == {5.0}


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_pressuresMustBeFinite(square, bad):
    with pytest.raises(ValueError, match="cell 3"):
        square(0.1 * R).setCellPressures([0.0] * 3 + [bad] + [0.0] * 6)


@pytest.mark.parametrize("poreMode", ["domain", "triangle"])
def test_renumberingChangesNothing(networkOf, looseDisks, poreMode):
    disks, box = looseDisks(seed=8)
    disks = overlapping(disks)
    order = np.random.default_rng(1).permutation(len(disks))

    def look(numbering):
        """Voids, domains and forces, with grains called by their place in `disks`, walls by -1 … -4."""
        engine = networkOf([disks[k] for k in numbering], box, poreMode=poreMode)
        name = lambda body: int(numbering[body - 4]) if body >= 4 else body - 4
        cells = engine.cells()
        keys = [frozenset(map(name, v)) for v in cells["vertices"]]
        # A pressure that belongs to the place, not to the number.
        engine.setCellPressures([1e3 * (1 + sum(sorted(key))) for key in keys])
        domains = {}
        for key, domain in zip(keys, cells["domain"]):
            domains.setdefault(domain, set()).add(key)
        return dict(zip(keys, cells["void"])), {frozenset(d) for d in domains.values()}, {name(i): f for i, f in engine.fluidForces().items()}

    voids, domains, forces = look(list(range(len(disks))))
    voids2, domains2, forces2 = look(order)
    assert domains == domains2
    assert voids.keys() == voids2.keys()
    scale = 1e3 * len(disks) ** 2 * R
    for key, void in voids.items():
        assert voids2[key] == pytest.approx(void, abs=1e-14 * R**2 * 10)  # a sum of some ten terms of size R^2
    for grain, force in forces.items():
        assert forces2[grain] == pytest.approx(force, abs=1e-13 * scale)


@pytest.mark.parametrize("name, bad, message", [
    ("poreMode", "pores", "poreMode = 'pores', allowed: 'domain', 'triangle'"),
    ("mergeTolerance", -1, r"mergeTolerance \[-\] = -1, allowed: finite and >= 0"),
    ("mergeHysteresis", 1.5, r"mergeHysteresis \[-\] = 1.5, allowed: 0 … 1"),
    ("remeshDisplacement", math.nan, r"remeshDisplacement \[-\] = nan"),
    ("maxSizeRatio", 0.5, r"maxSizeRatio \[-\] = 0.5, allowed: >= 1"),
    ("thickness", 0, r"thickness \[m\] = 0, allowed: finite and > 0"),
    ("waterPressure", math.inf, r"waterPressure \[Pa\] = inf, allowed: finite")])
def test_impossibleValuesAreRefusedByName(name, bad, message):
    with pytest.raises(ValueError, match=message):
        PoreNetworkEngine(**{name: bad})
    with pytest.raises(ValueError, match=message):
        setattr(PoreNetworkEngine(), name, bad)
