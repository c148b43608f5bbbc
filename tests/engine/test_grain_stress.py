# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress tensors of grains: their mean over the box is the stress on the walls, with and without fluids; smoothing and
principal stresses.
"""

import math

import numpy as np
import pytest
from yade import O, utils
from yade.wrapper import PoreNetworkEngine

from capfrac import fracture, injection, sediment, snapshot
from capfrac.errors import CaseError
from capfrac.plot import fracture as figures
from capfrac.results.fracture import stress


def tolerance(shot):
    """Relative error that forces out of balance leave: N grains with a resultant of u mean contact forces each (u:
    unbalanced force).

    The moments sum x_i R_i of these resultants over A sigma: at most N L u f/(L^2 sigma) with a mean contact force f of
    about 2 r w sigma, that is u N 2 r/L; and the walls are at rest to the servo's 0.01 of a force, times the same 2
    r/L.
    """
    ratio = 2 * float(np.mean(shot.r)) / (shot.box[1] - shot.box[0])
    return max(utils.unbalancedForce(), 1e-6) * len(shot.ids) * ratio


def settled(seed=3, stressV=20e3, stressH=12e3):
    sediment.makeSample(sediment.Sediment(grainCount=60, rMin=1e-6, rMax=2e-6, seed=seed), stressV, stressH)


def test_meanStressIsThatOfTheWalls():
    settled()
    fluid = PoreNetworkEngine(label="water")
    sediment.insertFluid(fluid)
    O.step()
    fluid = sediment.engine("water")
    shot = snapshot.takeSnapshot(fluid)
    found = fracture.takeStress(fluid, shot)
    expected = [found.walls[:2].mean(), found.walls[2:].mean()]
    assert np.diag(found.mean()) == pytest.approx(expected, rel=tolerance(shot))
    assert expected == pytest.approx([12e3, 20e3], rel=0.01)  # what was asked for, to the servo's half per cent
    assert np.abs(found.fluid).max() < 1e-9 * 20e3
    # No moment acts on the box as a whole: the tensor is symmetric but for the grains' own moments that are out of
    # balance.
    assert abs(found.mean()[0, 1] - found.mean()[1, 0]) < 0.01 * 20e3
    assert found.area.sum() == pytest.approx(math.prod(sediment.boxSize()), rel=1e-12)


def test_waterPressureAddsToTheStressOfTheWalls():
    # Under a pressure of 5 kPa in all pores the grains bear 5 kPa less; held by the servo, the walls bear what they
    # did.
    settled(stressV=20e3, stressH=20e3)
    fluid = PoreNetworkEngine(label="water", waterPressure=5e3)
    sediment.insertFluid(fluid)
    sediment.advance(6000)
    fluid = sediment.engine("water")
    shot = snapshot.takeSnapshot(fluid)
    found = fracture.takeStress(fluid, shot)
    walls = [found.walls[:2].mean(), found.walls[2:].mean()]
    assert found.total() == pytest.approx(walls, rel=tolerance(shot))
    assert walls == pytest.approx([20e3, 20e3], rel=0.01)
    # The virial of a uniform pressure is p (1 + sum of what overlaps hide): grains overlap by 0.1 % here, the walls'
    # chords are not loaded.
    assert np.diag(found.fluid) == pytest.approx([5e3, 5e3], rel=0.1)


def test_gasInTheMiddleCountsInTheTotal():
    settled()
    sediment.bond(capillaryStrength=10 * 0.05)
    walls = {name: wall.state.pos[wall.shape.axis] for name, wall in sediment.wallBodies().items()}
    middle = 0.5 * (walls["left"] + walls["right"]), 0.5 * (walls["bottom"] + walls["top"])
    # A circle too large for a grain: wherever they lie, some of it is in the void, and 200 points find it.
    turns = np.linspace(0, 2 * math.pi, 200, endpoint=False)
    points = [(middle[0] + 3e-6 * math.cos(turn), middle[1] + 3e-6 * math.sin(turn)) for turn in turns]
    gas = injection.startInjection(
        start=60e3, increment=0, max=60e3, points=points, outlet="any", interfacialTension=50.0
    )
    sediment.advance(6000)
    gas = sediment.engine("gas")
    shot = snapshot.takeSnapshot(gas)
    assert shot.gasCells.any()
    found = fracture.takeStress(gas, shot)
    walls = np.array([found.walls[:2].mean(), found.walls[2:].mean()])
    # Here the contact forces are those around the gas, ten times the confinement.
    force = float(np.mean(np.abs(shot.normalForce)))
    absolute = utils.unbalancedForce() * force * len(shot.ids) / (shot.box[1] - shot.box[0])
    assert np.abs(found.total() - walls).max() < max(absolute, 1e-3 * walls.max())
    assert np.diag(found.fluid).min() > 100 and np.all(np.diag(found.mean()) < walls)


def test_staleSnapshotIsRefused():
    settled()
    fluid = sediment.insertFluid(PoreNetworkEngine(label="water"))
    shot = snapshot.takeSnapshot(fluid)
    O.step()
    with pytest.raises(CaseError, match=f"the snapshot is of iteration {O.iter - 1}, allowed: {O.iter}"):
        fracture.takeStress(sediment.engine("water"), shot)


def uniform(tensor, n=8):
    x, y = (v.ravel() for v in np.meshgrid(np.arange(n) + 0.5, np.arange(n) + 0.5))
    return stress.GrainStress(
        ids=np.arange(n * n),
        place=np.column_stack([x, y]),
        radius=np.full(n * n, 0.5),
        area=np.ones(n * n),
        tensor=np.tile(tensor, (n * n, 1, 1)),
        box=np.array([0, n, 0, n]),
        fluid=np.zeros((2, 2)),
        walls=np.zeros(4),
    )


def test_uniformStressStaysUniform():
    tensor = np.array([[3.0, 0.5], [0.5, 1.0]])
    smooth = fracture.smoothField(uniform(tensor), [(0, 0), (4, 4), (8, 1)])
    assert smooth == pytest.approx(np.tile(tensor, (3, 1, 1)))
    with pytest.raises(CaseError, match="smoothing = 0, allowed: > 0"):
        fracture.smoothField(uniform(tensor), [(0, 0)], smoothing=0)


def test_smoothingSpreadsOneGrainAsAGaussian():
    # All is zero but one grain of many: the field is its weight, exp(-d^2/2 s^2) over the sum of all.
    one = uniform(np.zeros((2, 2)), 31)
    middle = 15 * 31 + 15
    one.tensor[middle] = np.eye(2)
    at = fracture.smoothField(one, [(15.5, 15.5), (18.5, 15.5)], smoothing=2.0)[:, 0, 0]
    assert at[0] == pytest.approx(1 / (2 * math.pi * 4), rel=1e-3) and at[1] / at[0] == pytest.approx(
        math.exp(-9 / 8), rel=1e-3
    )


def test_principalStresses():
    turn = math.radians(30)
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    first, second, angle = fracture.principal(
        [np.diag([3.0, 1.0]), rotation @ np.diag([5.0, -2.0]) @ rotation.T, np.diag([1.0, 4.0])]
    )
    assert (
        first == pytest.approx([3, 5, 4])
        and second == pytest.approx([1, -2, 1])
        and angle == pytest.approx([0, 30, 90])
    )


def test_savedAndDrawn(tmp_path):
    settled()
    fluid = sediment.insertFluid(PoreNetworkEngine(label="water"))
    O.step()
    fluid = sediment.engine("water")
    shot = snapshot.takeSnapshot(fluid)
    found = fracture.takeStress(fluid, shot)
    found.save(tmp_path / "s.npz")
    back = fracture.loadStress(tmp_path / "s.npz")
    assert np.array_equal(back.tensor, found.tensor) and np.array_equal(back.walls, found.walls)
    figures.drawStress([(shot, back)], tmp_path / "stress.png")
    assert (tmp_path / "stress.png").stat().st_size > 20_000
