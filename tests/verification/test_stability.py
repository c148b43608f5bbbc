# SPDX-License-Identifier: GPL-2.0-or-later
"""Long runs with real water, shortened (the full ones: `--validation`), and what the coupling may not do."""

import math

import numpy as np
import pytest
from yade import O
from yade.wrapper import SinglePhaseFlowEngine

from capfrac.scene.sediment import Sediment
from capfrac.verification import stability

SAMPLE = Sediment(grainCount=40, rMin=1e-2, shearStiffness=4e6, seed=1)


@pytest.mark.parametrize("bulkModulus", [1e7, 2.2e9, math.inf])
def test_undrainedStableNeverGainsEnergy(bulkModulus):
    found = stability.shake(SAMPLE, bulkModulus, steps=3000)
    # What a leapfrog keeps is the energy of the velocities before and after, multiplied. With one of them alone it is
    # off by dt F v/2, at most omega dt/2 of it, with omega dt <= 0.3 sqrt(2 z) and z <= 6 contacts; at random, so that
    # a mean is not. Friction and the fluid only take.
    assert found["end"] == "bounded" and max(found["energy"]) < 1.5 and max(found["ledger"]) < 1e-13
    assert np.mean(found["energy"][-50:]) < 1.05
    assert max(found["pressure"]) > 1e3  # the water bears load


@pytest.mark.parametrize("scheme", ["implicit", "explicit"])
def test_staggeredSchemesBlowUpWithWater(scheme):
    found = stability.shake(SAMPLE, 2.2e9, scheme, steps=3000)
    assert found["end"] != "bounded" and found["stepsDone"] < 50


@pytest.mark.parametrize("motion", stability.MOTIONS)
def test_booksOfStirredSamples(motion):
    found = stability.stir(SAMPLE, motion, steps=6000, inertialNumber=1e-2)
    # Round-off: 6000 steps of some hundred roundings each, at random.
    assert found["flipsTotal"] > 20 and max(found["ledger"]) < 1e-12 and abs(found["massDefect"]) < 1e-12
    assert min(found["smallest"]) > 0


def test_flipsGiveTheBitsOfANewTriangulation():
    found = []
    for localFlips in (True, False):
        O.reset()
        found.append(stability.stir(SAMPLE, "shear", steps=2000, inertialNumber=1e-2, localFlips=localFlips))
    flips, anew = found
    assert flips["flipsTotal"] > 10 and flips["rebuilds"] == 0 and anew["flipsTotal"] == 0 and anew["rebuilds"] > 5
    for name in ("strain", "ledger", "smallest", "pressure"):
        assert flips[name] == anew[name]


def test_noWorkOverAClosedUndrainedCycle(handScene, looseDisks):
    def work(steps):
        disks, box = looseDisks(count=25, seed=4)
        grains = handScene(disks, box)
        # Pores that exchange nothing: pressures are functions of the positions alone, so their forces have a potential.
        engine = SinglePhaseFlowEngine(
            timeIntegration="implicit", bulkModulus=1e7, viscosity=1e12, poreMode="triangle", remeshDisplacement=1
        )
        O.engines = [engine]
        O.dt = 1e-6
        random = np.random.default_rng(5)
        start, one, two = np.array([O.bodies[i].state.pos for i in grains]), *(
            random.uniform(-1e-5, 1e-5, (2, len(grains), 3)) * (1, 1, 0)
        )
        sums, last, before = [], None, None
        for n in range(steps + 1):
            angle = 2 * math.pi * n / steps
            now = start + one * math.sin(angle) + two * (1 - math.cos(angle))
            for i, position in zip(grains, now):
                O.bodies[i].state.pos = position
            O.step()
            forces = engine.fluidForces()
            force = np.array([forces[i] for i in grains])
            if n > 0:
                sums.append(0.5 * ((force + last) * (now - before)[:, :2]).sum())
            last, before = force, now
        assert engine.nRemeshes == 0
        return abs(sum(sums)), sum(map(abs, sums))

    coarse, fine = work(20), work(40)
    # The trapezoidal rule on a closed, smooth path converges faster than any power; what is left is the first-order
    # storage, V/K of the end of the step: dp/K = 1e-2.
    assert coarse[0] < 1e-3 * coarse[1] and fine[0] < 0.6 * coarse[0] + 1e-9 * coarse[1]
