# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes set by hand that several tests of the engines share."""

import pytest
from yade import O
from yade.wrapper import ForceResetter, GasInvasionEngine, PoreNetworkEngine

from capfrac.scene.gasobjects import gasObjects

R = 1e-3


@pytest.fixture
def pair(handScene):
    """A function (overlap, r1, r2, **Sediment) -> (left grain, right grain), the line of centres along x, walls far
    off.
    """

    def make(overlap, r1=1e-3, r2=1e-3, **attributes):
        far = 10 * (r1 + r2)
        return handScene([(-r1, 0, r1), (r2 - overlap, 0, r2)], (-far, far, -far, far), **attributes)

    return make


@pytest.fixture
def onFloor(handScene):
    """A function (overlap, r, **Sediment) -> the grain that rests on the bottom wall, other walls far off."""

    def make(overlap, r=1e-3, **attributes):
        return handScene([(0, r - overlap, r)], (-9 * r, 9 * r, 0, 9 * r), **attributes)[0]

    return make


@pytest.fixture
def contact():
    """A function that makes a step and returns the scene's only contact, after the contact law has seen it; None if it
    is gone.
    """

    def step():
        O.step()
        real = [i for i in O.interactions if i.isReal]
        return real[0] if real else None

    return step


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
    """A function (gap, **attributes) -> engine of four grains of radius R on a square, `gap` apart and from the
    walls.
    """

    def make(gap, **attributes):
        low, high, side = R + gap, 3 * R + 2 * gap, 4 * R + 3 * gap
        return networkOf(
            [(low, low, R), (high, low, R), (low, high, R), (high, high, R)], (0, side, 0, side), **attributes
        )

    return make


@pytest.fixture
def rigid(settledScene, looseDisks, handScene):
    """A function (packing, order, **attributes) -> gas engine, alone with the reset of forces; nothing moves.

    ``packing``: "settled" (grains touch: pores of several cells) or "loose" (25 disks that do not touch).
    ``order`` renumbers the grains.
    """

    def make(packing, order=None, **attributes):
        if packing == "settled":
            walls = settledScene(order)
        else:
            disks, walls = looseDisks(seed=7)
            handScene([disks[k] for k in (range(len(disks)) if order is None else order)], walls)
        # Without contacts there is no rest in the sense of small forces: let every level end by itself.
        gas = GasInvasionEngine(checkInvariants=True, minLevelSteps=1, maxLevelSteps=1, **gasObjects(attributes))
        if "inletPoints" not in attributes and "inletTo" not in attributes:
            gas.inletFrom, gas.inletTo = gas.inletStretch(2, 0.5 * (walls[0] + walls[1]))
        O.engines = [ForceResetter(), gas]
        return O.engines[1]

    return make
