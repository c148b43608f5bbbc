# SPDX-License-Identifier: GPL-2.0-or-later
"""Gas and water that are solved for, with weights: rest, forces, columns, and the slow limit, which is that of drained
water.
"""

import math

import numpy as np
import pytest
from yade import O

GAMMA, R, G = 0.05, 1e-3, 9.81
RHO = 1000.0
SOLVED = dict(waterFlow="solved", gasLaw="ideal", poreMode="triangle")
WEIGHT = dict(fluidDensity=RHO, gasDensity=80, gravity=(0, -G))


def equation15(gap, r):
    return 2 * GAMMA / r / (math.sqrt(1 + (1 + gap / (2 * r)) ** 2) - 1)


def heightOverInlet(y):
    return np.array(y) - list(O.bodies)[2].state.pos[1]


def test_waterAtRestStaysAtRest(standing):
    """And presses on grains and walls as columns of drained water at rest do."""
    gas = standing(gasPressure=20, waterPressure=7, **SOLVED, **WEIGHT)
    O.dt = 1e-4
    O.run(50, True)
    pores = gas.pores()
    height, pressure = heightOverInlet(pores["y"]), np.array(pores["pressure"])
    inWater, inGas = np.abs(pressure - (7 - RHO * G * height)), np.abs(pressure - (20 - 80 * G * height))
    # What a volume rounds to is 2e-16 K_f of pressure, 5e-7 Pa; a volume counts as filled to 16 roundings. Gas: 1e-7 of
    # the pressures.
    assert np.minimum(inWater, inGas).max() < 16 * 5e-7 and np.sum(inGas < inWater) == gas.inletPores
    assert gas.nEvents == 0 and gas.volumes()["error"] < 1e-14
    assert gas.volumes()["water"] == pytest.approx(gas.volumes()["initialWater"], rel=1e-14)
    forces = gas.fluidForces()
    drained = standing(gasPressure=20, waterPressure=7, poreMode="triangle", **WEIGHT).fluidForces()
    for body, force in forces.items():
        # Such errors of the pressures on surfaces of up to the box's width.
        assert force == pytest.approx(drained[body], rel=1e-9, abs=16 * 5e-7 * 0.05)


@pytest.mark.parametrize("gravity", [(0, -9.81), (3.0, -2.0)])
def test_forcesAddUpToTheWeightOfBothFluids(standing, gravity):
    gas = standing(gasPressure=155, **SOLVED, **{**WEIGHT, "gravity": gravity})
    O.dt = 2e-5
    while gas.gasSaturation < 0.3:
        O.step()
    pores, cells = gas.pores(), gas.cells()
    amounts = np.array(cells["water"])
    assert np.any((amounts > 0) & (np.array(cells["gas"]) > 0))  # on its way
    water = amounts.sum()  # its compression at some 1e3 Pa, 5e-7, is left out
    total = np.sum(list(gas.fluidForces().values()), axis=0)
    weight = np.array(gravity) * (RHO * water + 80 * (sum(pores["volume"]) - water))
    # Exact but for lenses where two weights meet, as with drained water: some 4e-5 r^2 each on 150 contacts.
    assert total == pytest.approx(weight, abs=RHO * 10 * 150 * 4e-5 * (2e-3) ** 2)


@pytest.mark.parametrize("gravity", [0.0, G, 40.0])
def test_breakthroughOfAChain(chain, gravity):
    """At the entry pressure less (rho_w - rho_g) g z of the throat that needs most: the column of gas below it
    helps.
    """
    gaps = [0.30 * R, 0.42 * R, 0.26 * R, 0.37 * R, 0.21 * R, 0.33 * R]
    gas = chain(gaps, gravity, gasDensity=80, **{k: v for k, v in SOLVED.items() if k != "poreMode"})
    expected = max(equation15(2 * gap, R) - (RHO - 80) * gravity * (R + 1.98 * R * k) for k, gap in enumerate(gaps))
    O.dt = 1e-4
    for excess in (-1e-4, 1e-4):
        gas.gasPressure = expected * (1 + excess)
        O.run(1000, True)
        assert (gas.breakthroughIter >= 0) == (excess > 0)
    assert max(gas.volumes()["error"], gas.gasLedger()["error"]) < 1e-12


@pytest.mark.parametrize("gravity, pressures", [(G, range(95, 130)), (-0.5 * G, range(150, 240, 2))])
def test_slowGasEntersTheSamePoresAsInDrainedWater(standing, gravity, pressures):
    """Level by level, as gas rises, and as it is pressed down by its buoyancy. Pores that fill at once in the last
    avalanche may cut water off in another order.
    """
    found = {}
    for water, attributes in (
        ("drained", dict(trapping=True, poreMode="triangle")),
        ("solved", dict(viscosity=1e-5, **SOLVED)),
    ):
        gas = standing(gasPressure=pressures[0], **attributes, **{**WEIGHT, "gravity": (0, -gravity)})
        O.dt, found[water] = 1e-4, []
        for pressure in pressures:
            gas.gasPressure = pressure
            O.run(1 if water == "drained" else 60, True)
            cells = gas.cells()
            found[water].append({v for v, phase in zip(cells["vertices"], cells["phase"]) if phase})
            if gas.breakthroughIter >= 0:
                break
        assert gas.volumes()["error"] < 1e-12
    assert len(found["solved"]) == len(found["drained"])
    assert found["solved"][:-1] == found["drained"][:-1]
    assert len(found["solved"][-1]) > 20  # it is no empty statement
