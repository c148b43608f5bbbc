# SPDX-License-Identifier: GPL-2.0-or-later
"""SinglePhaseFlowEngine in a scene: grains that it compresses, boundaries that change, what it saves, and what it
refuses in the loop.
"""

import math

import numpy as np
import pytest
from yade import O
from yade.wrapper import SinglePhaseFlowEngine

from capfrac import sediment

NAN = float("nan")


def alone(**attributes):
    engine = SinglePhaseFlowEngine(maxSizeRatio=100, **attributes)
    O.engines = [engine]
    return engine


def radii():
    return np.array([body.shape.radius for body in sediment.grainBodies()])


@pytest.mark.parametrize("scheme", ["undrainedStable", "implicit", "explicit"])
def test_grainsFollowThePressureRoundThem(loadSample, scheme):
    loadSample()
    before, K = radii(), 1e9
    engine = alone(timeIntegration=scheme, bulkModulus=1e7, grainBulkModulus=K, viscosity=1.0, wallPressures=[1e5] * 4)
    O.dt = 0.9 * engine.explicitTimeStepLimit() if scheme == "explicit" else 1e-2
    sediment.advance(4000 if scheme == "explicit" else 20)
    pressures = engine.pores()["pressure"]
    # Eq. 10 where the pressure has spread: everywhere in the implicit steps, within what is left of the diffusion in
    # explicit ones.
    share = 1 - min(pressures) / 1e5
    assert share < (0.2 if scheme == "explicit" else 1e-9)
    np.testing.assert_allclose(1 - radii() / before, 1e5 / (3 * K), rtol=share + 1e-9)
    assert engine.volumes()["error"] < 1e-12  # round-off of 4000 steps
    engine.wallPressures = [0.0] * 4
    sediment.advance(8000 if scheme == "explicit" else 20)
    np.testing.assert_allclose(radii(), before, rtol=(share + 1e-3) * 1e5 / (3 * K) if scheme == "explicit" else 1e-13)


def test_radiiOfCompressedGrainsSurviveSaving(loadSample, tmp_path):
    def go():
        sediment.advance(30)
        return radii().tolist(), [tuple(body.state.pos) for body in sediment.grainBodies()]

    loadSample()
    sediment.insertFluid(
        SinglePhaseFlowEngine(label="flow", bulkModulus=1e7, grainBulkModulus=1e8, wallPressures=[NAN, NAN, 0.0, 2e3])
    )
    go()
    pressures = sediment.engine("flow").pores()["pressure"]
    O.save(str(tmp_path / "scene.yade.gz"), quiet=True)
    O.load(str(tmp_path / "scene.yade.gz"), quiet=True)
    assert sediment.engine("flow").pores()["pressure"] == pressures
    first = go()
    O.load(str(tmp_path / "scene.yade.gz"), quiet=True)
    assert go() == first


def test_grainsTooSoftForTheirPressureAreRefused(loadSample):
    loadSample()
    before = radii()
    alone(timeIntegration="implicit", bulkModulus=1e9, grainBulkModulus=1e3, wallPressures=[1e4] * 4)
    with pytest.raises(
        RuntimeError,
        match=(
            r"at time t = .* body #\d+: the pressure round it, .* would compress it to less than half .*"
            r" grainBulkModulus = 1000"
        ),
    ):
        O.step()
    assert (radii() == before).all()


def test_boundariesMayChangeAtAnyTime(loadSample):
    loadSample()
    engine = alone(timeIntegration="implicit", bulkModulus=1e7, wallPressures=[NAN, NAN, 0.0, 1e3])
    O.dt = 1e-3  # a thousand times the diffusion: steady at once
    for _ in range(4):
        O.step()
    down = engine.inflow()
    engine.wallPressures = [NAN, NAN, 1e3, 0.0]
    for _ in range(4):
        O.step()
    assert engine.inflow()["top"] == pytest.approx(-down["top"], rel=1e-9)  # storage has died out: (4e-4)^4
    engine.wallPressures, engine.wallFluxes = [NAN, NAN, 1e3, NAN], [0, 0, 0, down["top"]]
    for _ in range(4):
        O.step()
    assert engine.inflow()["bottom"] == pytest.approx(-down["top"], rel=1e-9)
    engine.wallPressures, engine.wallFluxes = [NAN] * 4, [0] * 4
    before = engine.waterIn
    for _ in range(3):
        O.step()
    pressures = engine.pores()["pressure"]
    assert engine.waterIn == before and max(pressures) - min(pressures) < 1e-6 * max(pressures)  # sealed: it evens out
    assert engine.volumes()["error"] < 1e-12  # some ten times the water there is has flowed through


def test_aPressureThatSwingsEntersAsFarAsItsWave(handScene):
    # A row of pores between equal grains on a square lattice, long against the wave: p = exp(-x/d) cos(wt - x/d), d =
    # sqrt(2 D/w).
    r, n, rows = 1e-3, 60, 3
    handScene(
        [(r + 2 * r * i, r + 2 * r * j, r) for i in range(n) for j in range(rows)], (0, 2 * r * n, 0, 2 * r * rows)
    )
    engine = alone(timeIntegration="implicit", bulkModulus=1e7, poreMode="triangle", wallPressures=[0.0, NAN, NAN, NAN])
    O.dt = 1e-9
    O.step()
    # Diffusivity from the network itself: k K_f/(mu phi), k from a steady flow.
    steady = alone(
        timeIntegration="implicit", bulkModulus=math.inf, poreMode="triangle", wallPressures=[1.0, 0.0, NAN, NAN]
    )
    O.step()
    pores = steady.pores()
    x, p, volume = (np.array(pores[name]) for name in ("x", "pressure", "volume"))
    middle = (x > 20 * r) & (x < 100 * r)
    gradient = -np.polyfit(x[middle], p[middle], 1)[0]
    D = steady.inflow()["left"] / gradient * 1e7 / (volume.sum() / (2 * r * n))
    depth = 12 * r
    omega = 2 * D / depth**2
    engine = alone(timeIntegration="implicit", bulkModulus=1e7, poreMode="triangle", wallPressures=[0.0, NAN, NAN, NAN])
    steps = 200
    O.dt = 2 * math.pi / omega / steps
    for k in range(4 * steps):
        engine.wallPressures = [1e3 * math.cos(omega * O.dt * (k + 1)), NAN, NAN, NAN]
        O.step()
    pores = engine.pores()
    x, p, volume = (np.array(pores[name]) for name in ("x", "pressure", "volume"))
    origin = np.average(x[p == 1e3 * math.cos(omega * O.dt * 4 * steps)])
    expected = 1e3 * np.exp(-(x - origin) / depth) * np.cos(2 * math.pi * 4 - (x - origin) / depth)
    # Time: backward Euler damps by w dt/2 = 1.6 % a radian; space: pores within a cell of the lattice lie r apart in x,
    # r/depth = 8 % of the steepest slope.
    assert np.abs(p - expected).max() < 0.08 * 1e3


def test_aClusterThatFloatsIsNamedByItsPlace(loadSample):
    loadSample()
    # Contacts that bear a force and have no aperture left are tight: pores between such grains are cut off.
    alone(
        timeIntegration="implicit",
        bulkModulus=math.inf,
        conductanceLaw="parallelPlates",
        residualAperture=0.0,
        wallPressures=[NAN, NAN, 0.0, NAN],
    )
    with pytest.raises(
        RuntimeError,
        match=(
            r"SinglePhaseFlowEngine at time t = .*: pore \d+: its cluster \(pores: \d+\) is cut off .* \(pore \d+ lies"
            r" at \(.*\) m\)"
        ),
    ):
        O.step()


def test_aContactThatGivesNoNumberIsNamed(loadSample):
    loadSample()
    sediment.insertFluid(SinglePhaseFlowEngine(label="flow", bulkModulus=2.2e9))
    sediment.advance(2)
    contact = next(i for i in O.interactions if i.isReal and i.id1 >= 4 and i.id2 >= 4)
    contact.phys.kn = NAN
    water = sediment.engine("flow").volumes()["water"]
    before = [tuple(body.state.pos) for body in O.bodies]
    with pytest.raises(
        RuntimeError,
        match=r"at time t = .* s, iteration \d+: body #\d+: force \(.*nan.*\) N, velocity .*; allowed: finite",
    ):
        O.step()
    assert [tuple(body.state.pos) for body in O.bodies] == before
    contact.phys.kn = 1e7
    assert sediment.engine("flow").volumes()["water"] == water


@pytest.mark.parametrize("value", [0.0, -1.0, NAN])
def test_impossibleGrainModulus(value):
    engine = SinglePhaseFlowEngine()
    with pytest.raises(ValueError, match="grainBulkModulus .* allowed: > 0, or infinity"):
        engine.grainBulkModulus = value
    assert engine.grainBulkModulus == math.inf
