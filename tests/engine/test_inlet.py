# SPDX-License-Identifier: GPL-2.0-or-later
"""The gas inlet: some pores of a wall, a stretch of it, or pores that hold given points; its width is on record."""

import numpy as np
import pytest
from yade import O

from capfrac import casescene
from capfrac.case import resolveCase

R = 1e-3


def test_inletAtTheOutletHasBrokenThrough(rigid):
    gas = rigid("settled", outletWall="bottom")
    O.run(20, True)
    assert gas.breakthroughIter >= 0


@pytest.mark.parametrize("wall, axis", [("bottom", 0), ("top", 0), ("left", 1), ("right", 1)])
def test_inletOfSomePores(rigid, wall, axis):
    gas = rigid("settled", inletTo=1, inletWall=wall)
    middle = 0.5 * sum(b.state.pos[axis] for b in list(O.bodies)[2 * axis : 2 * axis + 2])
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
            with pytest.raises(
                ValueError, match="no inlet: no pore of the bottom wall has its middle between inletFrom and inletTo"
            ):
                gas.prepare()


def voidPoint(polygon):
    """A point of a triangular cell that lies in no grain, or None: of a grid, the one farthest from the grains."""
    share = np.array([(i, j, 40 - i - j) for i in range(1, 40) for j in range(1, 40 - i)]) / 40
    grains = [body for body in O.bodies if hasattr(body.shape, "radius")]
    places, radii = np.array([tuple(b.state.pos)[:2] for b in grains]), np.array([b.shape.radius for b in grains])
    points = share @ polygon
    room = (np.linalg.norm(points[:, None] - places, axis=2) - radii).min(axis=1)
    return tuple(points[room.argmax()]) if room.max() > 0 else None


@pytest.mark.parametrize("place", range(3))
def test_inletOfPoints(rigid, place):
    gas = rigid("settled", inletTo=1)
    gas.inletFrom, gas.inletTo = wallExtent()
    cells = gas.cells()
    # Between three grains: not at a wall.
    triangles = [c for c, vertices in enumerate(cells["vertices"]) if min(vertices) >= 4]
    points = {c: voidPoint(np.array(cells["polygon"][c])) for c in triangles}
    inside = [c for c, point in points.items() if point]
    target = inside[place * (len(inside) - 1) // 2]
    gas = rigid("settled", inletPoints=[points[target]])
    cells = gas.cells()
    assert gas.inletPores == 1 and gas.inletWidth == 0
    assert cells["inlet"][target] and cells["phase"][target] == 1
    assert {cells["domain"][c] for c, inlet in enumerate(cells["inlet"]) if inlet} == {cells["domain"][target]}


def test_aPointInAGrainIsNoInlet(rigid):
    gas = rigid("settled")
    grain = next(body for body in O.bodies if hasattr(body.shape, "radius"))
    at = (grain.state.pos[0], grain.state.pos[1])
    gas.inletPoints = [at]
    with pytest.raises(
        ValueError,
        match=(
            rf"inletPoints \[m\] = .*, allowed: a point in the void, at least one; this one lies in body #{grain.id},"
            r" of radius"
        ),
    ):
        gas.prepare()


def test_middleFindsTheVoidBetweenItsPoints(handScene):
    # A grain on the inner points and eight small ones on the outer: all that is looked at first lies in grains.
    turns = np.arange(8) * np.pi / 4
    around = [(3 * R * np.cos(turn), 3 * R * np.sin(turn), 0.4 * R) for turn in turns]
    handScene([(0, 0, 2.5 * R), *around], (-4 * R, 4 * R, -4 * R, 4 * R))
    gas = casescene.startGas(
        resolveCase(
            {
                "grains": {"rMin": 0.4 * R, "rMax": 2.5 * R},
                "stress": {"vertical": 10e3, "horizontal": 8e3},
                "inlet": {"middle": 3 * R},
                "network": {"poreMode": "triangle"},
                "ramp": {"start": 1, "increment": 1, "max": 2},
            }
        )
    )
    assert list(gas.inletPoints[0]) == [0, 0] and max(np.hypot(*point) for point in gas.inletPoints) <= 3 * R * (
        1 + 1e-15
    )
    assert 0 < gas.inletPores < len(gas.cells()["phase"])
