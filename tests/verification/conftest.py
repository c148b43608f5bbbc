# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that several verifications of the gas engine share."""

import pytest
from yade import O
from yade.wrapper import ForceResetter

from capfrac.scene.gasengine import engineOfGas
from capfrac.scene.gasobjects import gasObjects


@pytest.fixture
def standing(settledScene):
    """A function (**attributes) -> gas engine in 60 settled grains of 1-2 mm that stand still, with an inlet of two
    pores in the middle of the floor.
    """

    def make(waterFlow="drained", **attributes):
        walls = settledScene()
        # Without contacts there is no rest in the sense of small forces: let every level end by itself.
        gas = engineOfGas(waterFlow)(minLevelSteps=1, maxLevelSteps=1, checkInvariants=True, **gasObjects(attributes))
        gas.inletFrom, gas.inletTo = gas.inletStretch(2, 0.5 * (walls[0] + walls[1]))
        O.engines = [ForceResetter(), gas]
        return O.engines[1]

    return make


@pytest.fixture
def chain(handScene):
    """A function (gaps, gravity, **attributes) -> engine: grains of 1 mm one on the other, ``gaps`` [m] off the left
    wall and pressed into the right one, inlet in the lower left corner.
    """
    r = 1e-3

    def make(gaps, gravity=9.81, waterFlow="drained", **attributes):
        grains = [(gap + r, r + 1.98 * r * k, r) for k, gap in enumerate(gaps)]
        width = min(gaps) + 1.98 * r
        handScene(grains, (0, width, 0, grains[-1][1] + 1.01 * r))
        gas = engineOfGas(waterFlow)(
            inletFrom=0,
            inletTo=r,
            fluidDensity=1000,
            gravity=(0, -gravity),
            poreMode="triangle",
            checkInvariants=True,
            **gasObjects(attributes),
        )
        O.engines = [ForceResetter(), gas]
        return O.engines[1]

    return make
