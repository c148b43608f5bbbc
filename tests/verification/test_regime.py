# SPDX-License-Identifier: GPL-2.0-or-later
"""Theory of the change of mode, fits of it, and Hydrate Ridge by depth, against numbers worked out by hand."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from capfrac import depth, regime
from capfrac.errors import CaseError

GAMMA, STRESS = 0.05, 8e3


@pytest.mark.parametrize(
    "r, rigid, five, twelve, fifty",
    [
        (1.5e-3, 0.155, 8.15, 8.10, 8.05),
        (150e-6, 1.55, 9.49, 8.95, 8.47),
        (30e-6, 7.75, 15.5, 12.7, 10.4),
        (15e-6, 15.5, 22.9, 17.5, 12.7),
        (5e-6, 46.5, 52.7, 36.4, 22.1),
        (1.5e-6, 155, 157, 103, 55),
    ],
)
def test_pressuresOfBothModes(r, rigid, five, twelve, fifty):
    """In kPa, chi = 10, worked out to three digits (8.15 and its neighbours: rounded to 0.01; 55: to 1): half a unit of
    the last one.
    """
    assert regime.rigidThreshold(r, GAMMA) / 1e3 == pytest.approx(rigid, rel=5e-3)
    for a, value in ((5, five), (12.4, twelve), (50, fifty)):
        assert regime.fracturePressure(STRESS, 10, r, GAMMA, a * r) / 1e3 == pytest.approx(value, rel=6e-3)


@pytest.mark.parametrize(
    "chi, a, atEight, atThousand",
    [
        (0, 5, 29, 0.23),
        (0, 50, 29, 0.23),
        (1.57, 5, 25, 0.20),
        (1.57, 50, 28, 0.22),
        (10, 5, 1.1, 0.009),
        (10, 12.4, 11, 0.09),
        (10, 50, 20, 0.16),
    ],
)
def test_criticalRadius(chi, a, atEight, atThousand):
    """In um at 8 kPa and 1 MPa, worked out to one or two digits: half a unit of the last digit."""
    for stress, value in ((8e3, atEight), (1e6, atThousand)):
        unit = {29: 1, 25: 1, 28: 1, 20: 1, 11: 1, 1.1: 0.1, 0.009: 0.001}.get(value, 0.01)
        assert regime.criticalRadius(stress, chi, GAMMA, a) * 1e6 == pytest.approx(value, abs=0.5 * unit + 1e-12)


def test_criticalRadiusIsWhereBothPressuresMeet():
    for chi, a in ((0, 7), (1.57, 3), (10, 9)):
        r = regime.criticalRadius(STRESS, chi, GAMMA, a)
        assert regime.fracturePressure(STRESS, chi, r, GAMMA, a * r) == pytest.approx(
            regime.rigidThreshold(r, GAMMA), rel=1e-12
        )
    assert regime.criticalRadius(STRESS, 10, GAMMA, 4) == 0  # sqrt(1/4) > 4.65/10: never


def test_changeBetweenSharpModesIsTheMiddleOfTheGap():
    change = regime.modeChange([1e-6, 1e-5, 4e-5, 1e-3], ["fracture", "fracture", "mixed", "capillary"])
    assert (change.low, change.high, change.rigid, change.runs) == (
        pytest.approx(1e-5),
        pytest.approx(4e-5),
        pytest.approx(1e-3),
        4,
    )
    assert change.radius == pytest.approx(2e-5, rel=1e-12)


def test_changeWhereModesOverlap():
    """Symmetric in ln r about 1e-5, so is the fit; the grid of middles has steps of ln(1e4)/800."""
    change = regime.modeChange(
        [1e-7, 1e-6, 1e-6, 1e-4, 1e-4, 1e-3], ["fracture", "fracture", "mixed", "fracture", "mixed", "capillary"]
    )
    assert change.radius == pytest.approx(1e-5, rel=math.log(1e4) / 800)
    assert (change.low, change.high, change.rigid) == (pytest.approx(1e-7), pytest.approx(1e-3), pytest.approx(1e-3))


@pytest.mark.parametrize("modes", [["fracture"] * 3, ["capillary"] * 3, ["none"] * 3, ["mixed"] * 3])
def test_withoutAChangeThereIsNoRadius(modes):
    assert math.isnan(regime.modeChange([1e-6, 1e-5, 1e-4], modes).radius)


def test_crossing():
    # Falls by four decades over two: 0.5 is at a share lg(10/0.5)/4 of them. Means of two values are geometric.
    assert regime.crossing([1e-6, 1e-4], [10, 1e-3], 0.5) == pytest.approx(
        1e-6 * 10 ** (2 * math.log10(20) / 4), rel=1e-12
    )
    assert regime.crossing([1e-6, 1e-6, 1e-4], [100, 1, 1e-3], 0.5) == pytest.approx(
        1e-6 * 10 ** (2 * math.log10(20) / 4), rel=1e-12
    )
    # The last of two crossings, and none.
    assert 1e-3 < regime.crossing([1e-6, 1e-5, 1e-3, 1e-2], [1, 0.1, 1, 0.1], 0.5) < 1e-2
    assert math.isnan(regime.crossing([1e-6, 1e-5], [3, 1], 0.5)) and math.isnan(regime.crossing([1e-6], [3], 0.5))


def test_powerLaw():
    law = regime.powerLaw([1, 10, 100], [3, 0.3, 0.03])
    assert (law.factor, law.exponent) == (
        pytest.approx(3, rel=1e-12),
        pytest.approx(-1, rel=1e-12),
    ) and law.error < 1e-12
    # Residuals 1, -2, 1 times d about the line: standard error sqrt(6 d^2 / 1 / 2) for abscissas -1, 0, 1.
    d = 0.01
    law = regime.powerLaw(np.exp([-1, 0, 1]), np.exp([d, -2 * d, d]))
    assert law.exponent == pytest.approx(0, abs=1e-12) and law.error == pytest.approx(d * math.sqrt(3), rel=1e-9)
    with pytest.raises(CaseError, match="1 points, needed: at least two"):
        regime.powerLaw([1], [1])


def test_stressOfThePorosityModel():
    """The integral of (1 - phi)(2700 - 1024) g, and published values of it (five digits)."""
    for z, published in ((10, 61144), (60, 3.7605e5), (126.61, 8.1863e5), (160, 1.0501e6)):
        weight = quad(lambda x: (1 - 0.10 - 0.53 * math.exp(-x / 1400)) * (2700 - 1024) * 9.81, 0, z)[0]
        assert depth.verticalStress(z) == pytest.approx(weight, rel=1e-9)
        assert depth.verticalStress(z) == pytest.approx(published, rel=5e-5)


def test_methane():
    """An ideal gas where it is thin; by the equation of state itself elsewhere."""
    # second virial coefficient: -50 cm^3/mol, so 2e-5 at 1 kPa
    assert depth.methaneDensity(1e3, 280.0) == pytest.approx(1e3 * 0.016043 / (8.314 * 280), rel=1e-4)
    p, t = 8.5e6, 280.0
    volume = 0.016043 / float(depth.methaneDensity(p, t))
    kappa = 0.37464 + 1.54226 * 0.011 - 0.26992 * 0.011**2
    a = 0.45724 * (8.314 * 190.56) ** 2 / 4.599e6 * (1 + kappa * (1 - math.sqrt(t / 190.56))) ** 2
    b = 0.07780 * 8.314 * 190.56 / 4.599e6
    assert 8.314 * t / (volume - b) - a / (volume * (volume + b) + b * (volume - b)) == pytest.approx(p, rel=1e-9)


def test_columnCarriesThePressure():
    z, p = 126.61, 568e3
    height = depth.gasColumn(p, z)
    rho = depth.methaneDensity(1024 * 9.81 * (790 + z) + p, 277.15 + 0.059 * z)
    assert (1024 - rho) * 9.81 * height == pytest.approx(p, rel=1e-12)


def test_bandsOfHydrateRidge():
    bands = depth.bands([10.0, 126.61, 160.0])
    for name in ("threshold", "fracture", "pressure", "column", "ratio", "stressH"):
        low, best, high = bands[name]
        assert (low <= best * (1 + 1e-12)).all() and (best <= high * (1 + 1e-12)).all()
    # 0.05 N/m, 0.176 um: 568 kPa; over 0.667 * 818.6 kPa.
    assert bands["ratio"][1][1] == pytest.approx(2 * 0.05 / 0.176e-6 / (0.667 * 818.63e3), rel=1e-4)
    assert bands["fractureShare"][0] == 1 and bands["fractureShare"][1] > bands["fractureShare"][2]
