"""Scenes that several verifications of the gas engine share."""

import pytest
from yade import O
from yade.wrapper import ForceResetter, GasInvasionEngine


@pytest.fixture
def standing(settledScene):
    """A function (**attributes) -> gas engine in 60 settled grains of 1-2 mm that stand still, with an inlet of two pores in the middle of the floor."""

    def make(**attributes):
        walls = settledScene()
        # Without contacts there is no rest in the sense of small forces: let every level end by itself.
        gas = GasInvasionEngine(minLevelSteps=1, maxLevelSteps=1, checkInvariants=True, **attributes)
        gas.inletFrom, gas.inletTo = gas.inletStretch(2, 0.5 * (walls[0] + walls[1]))
        O.engines = [ForceResetter(), gas]
        return O.engines[1]

    return make
