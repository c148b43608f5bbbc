# SPDX-License-Identifier: GPL-2.0-or-later
"""What cannot be a sample is refused before any work, and what becomes none as soon as that shows."""

import numpy as np
import pytest
from yade import O

from capfrac import case, packing, sediment
from capfrac.errors import CaseError, SampleError, SceneError
from capfrac.scene import samplechecks
from capfrac.scene.samplechecks import Flow, forceNetwork

R = 1e-3
GOOD = {
    "grains": {"rMin": R, "count": 60},
    "stress": {"vertical": 10e3, "horizontal": 8e3},
    "inlet": {"pores": 2},
    "ramp": {"start": 100, "increment": 1, "max": 200},
}


def lattice(columns, rows, overlap=1e-3):
    """Disks of radius R on a square lattice, pressed by that share of R into each other and the walls: (disks, box)."""
    pitch = (2 - overlap) * R
    disks = [((column + 0.5) * pitch, (row + 0.5) * pitch, R) for row in range(rows) for column in range(columns)]
    return disks, (0, columns * pitch, 0, rows * pitch)


# ---- stresses


@pytest.mark.parametrize("vertical, horizontal", [(10e3, 2.5e3), (10e3, 500), (1e3, 4e3), (1, 1e9)])
def test_stressesThatNoSettledSampleBears(vertical, horizontal):
    ratio = max(vertical / horizontal, horizontal / vertical)
    message = f"stress.vertical = {vertical:g} Pa, stress.horizontal = {horizontal:g} Pa, a ratio of {ratio:.3g}; "
    with pytest.raises(CaseError) as caught:
        case.resolveCase({**GOOD, "stress": {"vertical": vertical, "horizontal": horizontal}})
    assert caught.value.problems[-1].startswith(message + "allowed: less than 4")
    with pytest.raises(CaseError, match="stressV = .*, stressH = .*; allowed: less than 4"):
        sediment.makeSample(sediment.Sediment(grainCount=30), vertical, horizontal)
    assert len(O.bodies) == 0


def test_stressesThatPressTheGrainsInTooFar():
    # sigma 2 r_max / k_n > 0.1 r_min: 0.05 k_n r_min / r_max = 250 kPa is the limit.
    problems = ["stress.vertical = 300000 Pa is out of reach", "stress.horizontal = 260000 Pa is out of reach"]
    with pytest.raises(CaseError) as caught:
        case.resolveCase({**GOOD, "stress": {"vertical": 300e3, "horizontal": 260e3}})
    assert [text.partition(":")[0] for text in caught.value.problems] == problems
    with pytest.raises(CaseError, match="stressH = 260000 Pa is out of reach: .* allowed: up to 250000 Pa"):
        sediment.makeSample(sediment.Sediment(grainCount=30, rMin=R, rMax=2 * R), 240e3, 260e3)
    assert len(O.bodies) == 0


@pytest.mark.parametrize("vertical, horizontal", [(10e3, 10e3), (18e3, 10e3), (10e3, 20e3), (39.9e3, 10e3)])
def test_stressesBelowThat(vertical, horizontal):
    case.resolveCase({**GOOD, "stress": {"vertical": vertical, "horizontal": horizontal}})


@pytest.mark.parametrize("stressV, stressH", [(10e3, 2.6e3), (2.6e3, 10e3)])
def test_aSampleThatFlowsIsStopped(stressV, stressH):
    # With friction 0.2 none of ten samples bore a ratio of 3, and none of thirty of any friction one of 4.
    steps = []
    with pytest.raises(
        SampleError, match=r"the sample flows under sigma_V = .* \(stress.vertical\), sigma_H = .* a side"
    ) as caught:
        sediment.makeSample(
            sediment.Sediment(grainCount=40, rMin=R, rMax=2 * R, friction=0.2),
            stressV,
            stressH,
            progress=lambda label, unbalanced: steps.append(O.iter),
        )
    assert "a ratio of 3.85" in str(caught.value)
    # The box is not far off yet: looked at every thousand steps, in which a wall moves by half a radius at most.
    width, height = sediment.boxSize()
    assert 0.3 < height / width < 3 and O.iter == steps[-1]


def test_latticesBearMore():
    # A triangular lattice of frictional disks is no settled pack: its rows hold each other like teeth.
    sample = sediment.Sediment(grainCount=60, rMin=R, rMax=R, friction=0.5)
    sediment.makeSample(sample, 10e3, 2.5e3, packing=packing.hexagonal(60, R))
    stressH, stressV = sediment.wallStresses()
    # compress() stops within 0.5 % of the larger stress; relax() keeps the walls at work.
    assert stressV / stressH == pytest.approx(4, rel=0.03)


def test_growthIsOfTheLeastLength():
    flow = Flow((1.0, 1.0), 0.01)
    for size in [(1.0, 0.9), (0.8, 0.9), (1.119, 0.7), (0.8, 0.979)]:
        flow.check(size, 2.0, 1.0, 0.5)
    with pytest.raises(
        SampleError, match="a ratio of 2: the box went from 1 x 1 m to 0.8 x 0.982 m, a side grew by 40%; allowed: 40%"
    ):
        flow.check((0.8, 0.982), 2.0, 1.0, 0.5)
    with pytest.raises(SampleError, match="a side grew by 41%"):
        flow.check((1.128, 0.7), 1.0, 2.0, 0.5)


def test_fewGrainsMayMoveByAGrain():
    flow = Flow((1.0, 1.0), 0.5)
    flow.check((1.49, 1.0), 1.0, 1.0, 0.5)
    with pytest.raises(SampleError, match="a side grew by 51%; allowed: 50%"):
        flow.check((1.51, 1.0), 1.0, 1.0, 0.5)


# ---- what bears the load


@pytest.mark.parametrize("columns, rows", [(1, 1), (3, 3), (4, 2), (1, 5)])
def test_squareLatticesBearEverywhere(handScene, columns, rows):
    disks, box = lattice(columns, rows)
    handScene(disks, box)
    O.step()
    # Four contacts a grain, each of two constraints shared by two grains, or of one with a wall.
    assert forceNetwork() == {"grains": len(disks), "loaded": len(disks), "constraints": 4, "spans": True}
    samplechecks.checkCarried()


def test_rattlersBearNothing(handScene):
    disks, box = lattice(3, 3)
    del disks[4]  # the one in the middle, and a small one that lies there
    handScene([*disks, (box[1] / 2, box[3] / 2, 0.3 * R)], box)
    O.step()
    found = forceNetwork()
    assert (found["grains"], found["loaded"], found["spans"]) == (9, 8, True)
    # Corners have two neighbours and two walls, the four at the sides two neighbours and a wall.
    assert found["constraints"] == (4 * 4 + 4 * 3) / 8


def test_whatHangsOnOneContactBearsNothing(handScene):
    # A chain from the left wall into the void: the last grain has one contact, then the one before it, and so on.
    disks, _ = lattice(3, 1)
    handScene(disks, (0, 12 * R, -5 * R, 5 * R))
    O.step()
    assert forceNetwork() == {"grains": 3, "loaded": 0, "constraints": 0, "spans": False}
    with pytest.raises(SampleError, match="the sample is no pack: 0 of 3 grains bear load"):
        samplechecks.checkCarried()


def test_loadThatDoesNotGoThrough(handScene):
    # A wall of bricks along the left, between bottom and top: nothing leads to the right.
    disks, box = lattice(2, 4)
    handScene(disks, (box[0], 3 * box[1], box[2], box[3]))
    O.step()
    assert forceNetwork()["spans"] is False
    with pytest.raises(SampleError, match="the load does not go through the sample from wall to wall: 8 of 8 grains"):
        samplechecks.checkCarried()


# ---- few grains, and shapes


@pytest.mark.parametrize("count", [1, 2])
def test_tooFewGrains(count, handScene):
    with pytest.raises(CaseError, match=f"grains.count = {count}, allowed: a whole number >= 3"):
        case.resolveCase({**GOOD, "grains": {"rMin": R, "count": count}})
    with pytest.raises(CaseError, match=f"the sample has {count} grains, allowed: at least 3"):
        sediment.makeSample(sediment.Sediment(grainCount=count), 1e3, 1e3)
    x = np.arange(count) * 3 * R
    with pytest.raises(CaseError, match=f"the sample has {count} grains, allowed: at least 3"):
        sediment.makeSample(sediment.Sediment(grainCount=30), 1e3, 1e3, packing=(x, x, np.full(count, R)))
    assert len(O.bodies) == 0
    handScene([(place, 0, R) for place in x], (-R, 6 * R, -R, 9 * R))
    with pytest.raises(SceneError, match=f"the scene holds {count} grains, allowed: at least 3"):
        sediment.settle(sediment.Sediment(grainCount=count))
    assert O.iter == 0


@pytest.mark.parametrize("count", [3, 4, 5, 7])
def test_fewGrainsAreASampleOrNotAtOnce(count):
    sample = sediment.Sediment(grainCount=count, rMin=R, rMax=2 * R)
    try:
        sediment.makeSample(sample, 10e3, 8e3)
    except SampleError as problem:
        assert "the sample flows" in str(problem)
    else:
        stressH, stressV = sediment.wallStresses()
        assert stressV == pytest.approx(10e3, rel=0.02) and forceNetwork()["spans"]
    assert O.iter < 60_000


def test_grainsSideBySideAreAtRest():
    # Three grains on the floor: as many contacts as grains, none between them.
    sample = sediment.Sediment(grainCount=3, rMin=R, rMax=R)
    sediment.buildScene(sample, [1.5 * R, 4.5 * R, 7.5 * R], [1.1 * R] * 3, [R] * 3, (0, 9 * R, 0, 9 * R))
    sediment.settle(sample, maxSteps=100_000)
    assert O.interactions.countReal() == 3 and sediment.boxSize()[1] == pytest.approx(2 * R, rel=1e-2)


def test_whatDoesNotSettleSaysWhy():
    sample = sediment.Sediment(grainCount=3, rMin=R, rMax=R)
    sediment.buildScene(sample, [1.5 * R, 4.5 * R, 7.5 * R], [50 * R] * 3, [R] * 3, (0, 9 * R, 0, 99 * R))
    with pytest.raises(SampleError, match="did not come to rest: 3 of 3 touch nothing after 3000 steps, allowed: none"):
        sediment.settle(sample, maxSteps=3000)


@pytest.mark.parametrize(
    "count, aspect, allowed",
    [
        # 60 grains of 1 to 2 mm fill 60 pi (1 + 2 + 4)/3 / 0.84 = 523.6 mm^2: two layers of 6 mm, two columns of 8 mm.
        (60, 0.01, "0.069 to 8.2"),
        (60, 100, "0.069 to 8.2"),
        (60, 0.0687, "0.069 to 8.2"),
        (60, 8.2, "0.069 to 8.2"),
        (3, 0.5, "1 to 1"),
        (3, 2, "1 to 1"),
        (60, 1e-300, "0.069 to 8.2"),
    ],
)
def test_shapesThatSoManyGrainsCannotHave(count, aspect, allowed):
    with pytest.raises(CaseError, match=f"grains.aspect = .*, allowed: {allowed} for so many grains"):
        case.resolveCase({**GOOD, "grains": {"rMin": R, "count": count, "aspect": aspect}})
    with pytest.raises(CaseError, match="aspect = .*, allowed: .* for so many grains"):
        sediment.placeSample(
            sediment.Sediment(grainCount=count, rMin=R, rMax=2 * R, aspect=0.9 * aspect if aspect < 1 else 1.1 * aspect)
        )
    assert len(O.bodies) == 0


@pytest.mark.parametrize("count, aspect", [(3, 1), (60, 0.07), (60, 8.1), (300, 1), (1000, 14)])
def test_shapesThatTheyCanHave(count, aspect):
    case.resolveCase({**GOOD, "grains": {"rMin": R, "count": count, "aspect": aspect}})
