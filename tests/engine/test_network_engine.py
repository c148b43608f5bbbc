# SPDX-License-Identifier: GPL-2.0-or-later
"""PoreNetworkEngine: its forces are the gradient of sum p V, its volumes fill the box, its domains follow the contacts.

The grains stand where a test puts them (all degrees of freedom blocked); the engine alone is run.
"""

import math

import numpy as np
import pytest
from yade import O
from yade.wrapper import PoreNetworkEngine

R = 1e-3


def energy(engine, pressures):
    """sum p V [J] of the cells as the grains stand now."""
    return float(np.dot(pressures, engine.cells()["void"]))


def forcesInScene():
    return {body.id: np.array(O.forces.f(body.id))[:2] for body in O.bodies}


def randomPressures(engine, seed=3):
    return np.random.default_rng(seed).uniform(0, 1e3, len(engine.cells()["void"]))


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

        def name(body):
            return int(numbering[body - 4]) if body >= 4 else body - 4

        cells = engine.cells()
        keys = [frozenset(map(name, v)) for v in cells["vertices"]]
        # A pressure that belongs to the place, not to the number.
        engine.setCellPressures([1e3 * (1 + sum(sorted(key))) for key in keys])
        domains = {}
        for key, domain in zip(keys, cells["domain"]):
            domains.setdefault(domain, set()).add(key)
        return (
            dict(zip(keys, cells["void"])),
            {frozenset(d) for d in domains.values()},
            {name(i): f for i, f in engine.fluidForces().items()},
        )

    voids, domains, forces = look(list(range(len(disks))))
    voids2, domains2, forces2 = look(order)
    assert domains == domains2
    assert voids.keys() == voids2.keys()
    scale = 1e3 * len(disks) ** 2 * R
    for key, void in voids.items():
        assert voids2[key] == pytest.approx(void, abs=1e-14 * R**2 * 10)  # a sum of some ten terms of size R^2
    for grain, force in forces.items():
        assert forces2[grain] == pytest.approx(force, abs=1e-13 * scale)


@pytest.mark.parametrize(
    "name, bad, message",
    [
        ("poreMode", "pores", "poreMode = 'pores', allowed: 'domain', 'triangle'"),
        ("mergeTolerance", -1, r"mergeTolerance \[-\] = -1, allowed: finite and >= 0"),
        ("mergeHysteresis", 1.5, r"mergeHysteresis \[-\] = 1.5, allowed: 0 … 1"),
        ("remeshDisplacement", math.nan, r"remeshDisplacement \[-\] = nan"),
        ("maxSizeRatio", 0.5, r"maxSizeRatio \[-\] = 0.5, allowed: >= 1"),
        ("thickness", 0, r"thickness \[m\] = 0, allowed: finite and > 0"),
        ("waterPressure", math.inf, r"waterPressure \[Pa\] = inf, allowed: finite"),
    ],
)
def test_impossibleValuesAreRefusedByName(name, bad, message):
    with pytest.raises(ValueError, match=message):
        PoreNetworkEngine(**{name: bad})
    with pytest.raises(ValueError, match=message):
        setattr(PoreNetworkEngine(), name, bad)
