# SPDX-License-Identifier: GPL-2.0-or-later
"""Gas and water with weights: exact thresholds in a chain of pores, forces at rest, stable and unstable fronts, and the
critical column.
"""

import math

import numpy as np
import pytest
from yade import O

from capfrac import buoyancy
from capfrac.errors import CaseError

GAMMA, R, G = 0.05, 1e-3, 9.81
RHO = 1000.0


def equation15(gap, r):
    return 2 * GAMMA / r / (math.sqrt(1 + (1 + gap / (2 * r)) ** 2) - 1)


@pytest.mark.parametrize("gravity", [0.0, G, 40.0])
def test_breakthroughOfAChain(chain, gravity):
    """max over the throats of P_e - (rho_w - rho_g) g z, to the last bits."""
    gaps = [0.30 * R, 0.42 * R, 0.26 * R, 0.37 * R, 0.21 * R, 0.33 * R]
    gas = chain(gaps, gravity)
    thresholds = [equation15(2 * gap, R) - RHO * gravity * (R + 1.98 * R * k) for k, gap in enumerate(gaps)]
    expected = max(thresholds)
    assert expected == max(thresholds[0], thresholds[2], thresholds[4])
    gas.gasPressure = expected * (1 - 1e-12)
    O.step()
    assert gas.breakthroughIter < 0
    gas.gasPressure = expected * (1 + 1e-12)
    O.step()
    assert gas.breakthroughPressure == expected * (1 + 1e-12)
    # What is logged is the entry pressure at the throat, not at the inlet.
    events = gas.events()
    for k, (throat, pressure) in enumerate(zip(events["throat"], events["entryPressure"])):
        if 0 in throat:
            assert pressure == pytest.approx(equation15(2 * gaps[max(throat) - 4], R), rel=1e-13)


def test_imbibitionOfAChain(chain):
    """Water from the top first takes the pores on the right, which are tighter, then the lowest on the left, and so
    cuts off the gas above it.

    The first step is the upper right corner's: its sphere lies in the corner, at the distance rho of the grain's
    centre, and is refilled below 2 gamma/(sqrt(rho^2 + r^2) - r) there, less rho_w g z at the inlet. All others on the
    right, and the lowest on the left, follow at higher thresholds.
    """
    g = 4.0
    gas = chain([0.3 * R] * 6, g, gasPressure=400, imbibition=True)
    O.step()
    assert gas.gasSaturation == pytest.approx(1, abs=1e-12)
    top = R + 1.98 * R * 5 + 1.01 * R
    expected = 2 * GAMMA / (math.hypot(math.hypot(0.98 * R, 1.01 * R), R) - R) - RHO * g * top
    gas.gasPressure = expected * (1 + 1e-9)
    O.step()
    assert gas.nReturns == 0
    gas.gasPressure = expected * (1 - 1e-9)
    O.step()
    cells = gas.cells()
    side = ["left" if 0 in v else "right" for v in cells["vertices"]]
    height = [min(y for _, y in polygon) for polygon in cells["polygon"]]
    left = sorted((h, c) for c, h in enumerate(height) if side[c] == "left")
    assert len(left) == 7  # two corners and five between the grains
    assert [cells["phase"][c] for _, c in left] == [1, 0, 1, 1, 1, 1, 1] and not any(
        cells["phase"][c] for c, s in enumerate(side) if s == "right"
    )
    assert [cells["cutOff"][c] for _, c in left] == [False, False, True, True, True, True, True]


@pytest.fixture
def halfFull(standing):
    """A function (**attributes) -> gas engine whose gas of 155 Pa has filled part of the pores, one a step."""

    def make(**attributes):
        gas = standing(gasPressure=155, invasionInterval=1, **attributes)
        while gas.gasSaturation < 0.4:
            O.step()
        assert gas.gasSaturation < 0.8
        return gas

    return make


def total(forces):
    return np.sum([f for f in forces.values()], axis=0)


@pytest.mark.parametrize("gravity", [(0, -9.81), (3.0, -2.0)])
def test_forcesAddUpToTheWeightOfBothFluids(halfFull, gravity):
    gas = halfFull(fluidDensity=1000, gasDensity=80, gravity=gravity)
    volumes, forces = gas.volumes(), gas.fluidForces()
    weight = np.array(gravity) * (1000 * volumes["water"] + 80 * volumes["gas"])
    # Exact but for lenses (kernel's tests): overlaps here are 1e-3 r deep, some 4e-5 r^2 each on 150 contacts.
    assert total(forces) == pytest.approx(weight, abs=1000 * 10 * 150 * 4e-5 * (2e-3) ** 2)


def test_grainsInOneFluidFeelItsBuoyancy(halfFull):
    """Water and gas of one density: Archimedes on every grain, less what its contacts keep dry, on top of the forces
    without weight.
    """
    light = halfFull().fluidForces()
    heavy = halfFull(fluidDensity=1000, gasDensity=1000, gravity=(0, -9.81)).fluidForces()
    for body in list(O.bodies)[4:]:
        r = body.shape.radius
        lift = heavy[body.id][1] - light[body.id][1]
        # Column of 40 mm: rho g h = 400 Pa on chords of up to 2 sqrt(2 r delta) of a few contacts.
        assert lift == pytest.approx(1000 * 9.81 * math.pi * r * r, abs=4 * 400 * 0.1 * r)


def test_pressuresAreThoseOfColumnsAtRest(halfFull):
    gas = halfFull(fluidDensity=1000, gasDensity=80, gravity=(0, -9.81), waterPressure=7)
    cells = gas.cells()
    # Cells are some radii high: the pressure is that at their centroid.
    for phase, pressure, polygon in zip(cells["phase"], cells["pressure"], cells["polygon"]):
        low, high = min(y for _, y in polygon), max(y for _, y in polygon)
        base = list(O.bodies)[2].state.pos[1]
        density, at = (80, 155) if phase else (1000, 7)
        assert at - density * 9.81 * (high - base) - 1e-9 <= pressure <= at - density * 9.81 * (low - base) + 1e-9


def test_fluidsWithoutWeightAreAsBefore(halfFull):
    plain = halfFull()
    events, forces = plain.events(), plain.fluidForces()
    again = halfFull(fluidDensity=1000, gasDensity=80)  # without gravity they have no weight
    assert again.events() == events and again.fluidForces() == forces
    with pytest.raises(ValueError, match="gravity .* while no fluid has a density"):
        halfFull(gravity=(0, -9.81))


def test_stableAndUnstableFronts():
    """Invading from above is stable, from below it fingers: more, and less, gas at breakthrough than without gravity
    (means of three packings).
    """
    import importlib.util
    from pathlib import Path

    spec = importlib.util.spec_from_file_location(
        "buoyant", Path(__file__).resolve().parents[2] / "examples" / "24_buoyancy.py"
    )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    found = module.main(count=100, seeds=4)
    assert found["from above"] > found["without gravity"] > found["from below"]


def test_criticalColumn():
    assert buoyancy.criticalColumn(1000 * 9.81, 1100, 100, g=9.81) == pytest.approx(1, rel=1e-15)
    assert buoyancy.criticalColumn(0, 1000, 1) == 0
    assert buoyancy.bondNumber(1e-3, 0.05, 1000, 0, g=10) == pytest.approx(0.2)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ((-1, 1000, 1), r"capillaryPressure \[Pa\] = -1, allowed"),
        ((1, 1, 1), r"waterDensity \[kg/m\^3\] = 1, allowed: finite and > gasDensity = 1"),
        ((1, 1000, -2), "gasDensity"),
        ((1, 1000, 1, 0), r"g \[m/s\^2\] = 0"),
        ((math.nan, 1000, 1), "capillaryPressure .* nan"),
    ],
)
def test_impossibleColumns(arguments, message):
    with pytest.raises(CaseError, match=message):
        buoyancy.criticalColumn(*arguments)
