# SPDX-License-Identifier: GPL-2.0-or-later
"""What is read from the curves of the laboratory, on curves that are known in closed form."""

import math

import numpy as np
import pytest

from capfrac.errors import CaseError
from capfrac.lab import biaxial, compaction, hydrate_ridge, properties, settling
from capfrac.lab.box import COLUMNS


def rowsOf(strain, stress, branch=None, e0=1.0):
    """Rows of a compaction with that curve."""
    n = len(strain)
    rows = {name: [0.0] * n for name in COLUMNS}
    rows.update(
        {
            "strain [-]": list(strain),
            "stressV [Pa]": list(stress),
            "voidRatio [-]": list((1 + e0) * (1 - np.asarray(strain)) - 1),
            "branch": branch or ["virgin"] * n,
        }
    )
    return rows


@pytest.mark.parametrize("index, e0", [(0.568, 1.5), (0.1, 0.2)])
def test_compressionIndexOfAStraightLine(index, e0):
    stress = np.geomspace(10e3, 2e6, 200)
    strain = index / (1 + e0) * np.log10(stress / 10e3)
    found = compaction.evaluate(rowsOf(strain, stress, e0=e0), fitFrom=100e3, fitTo=1e6)
    # Interpolated in log stress, where the curve is straight: round-off of a few hundred additions.
    assert found.Cc == pytest.approx(index, rel=1e-10)
    assert found.voidRatio == pytest.approx(e0, rel=1e-15)
    assert compaction.evaluate(rowsOf(strain, stress), voidRatio=e0, fitFrom=100e3, fitTo=1e6).Cc == pytest.approx(
        index, rel=1e-10
    )
    assert found.table["voidRatioUsed [-]"][-1] == pytest.approx(e0 - index * math.log10(200), rel=1e-10)


def test_compressionIndexOfSprings():
    # strain = stress/M: -de/dlog10(sigma) = (1 + e0) ln 10 strain; over a decade to s the least-squares slope is that
    # of the exponential, known by integration: 12 Int (t - 1/2) 10^(t-1) dt over [0, 1] times the strain at s.
    stress = np.linspace(1e3, 1e6, 5000)
    found = compaction.evaluate(rowsOf(stress / 1e7, stress, e0=0.0), fitFrom=100e3, fitTo=1e6)
    c = math.log(10)
    exact = 12 * 0.1 / 10 * ((10 * (1 / c - 1 / c**2) + 1 / c**2) - 0.5 * 9 / c)
    # A sum of 101 points in place of an integral gives the two ends twice their weight: first order, less than 1/100.
    assert found.Cc == pytest.approx(exact, rel=5e-3)


def test_indexOutsideOfTheCurveIsNone():
    stress = np.geomspace(10e3, 200e3, 50)
    assert math.isnan(compaction.evaluate(rowsOf(stress / 1e7, stress), fitFrom=100e3, fitTo=1e6).Cc)
    with pytest.raises(CaseError, match="fitFrom = 1000000.0 Pa, allowed: < fitTo = 100000.0 Pa"):
        compaction.evaluate(rowsOf(stress / 1e7, stress), fitFrom=1e6, fitTo=1e5)


def test_loopOfTwoStraightBranches():
    # Up to (0.1, 1e5), down straight to (0.06, 1e4), up straight again but twice as steep at first: a triangle.
    strain = [0.0, 0.1, 0.08, 0.06, 0.07, 0.1]
    stress = [1e3, 1e5, 5.5e4, 1e4, 5e4, 1e5]
    branch = ["virgin", "virgin", "unload 1", "unload 1", "reload 1", "reload 1"]
    (loop,) = compaction.evaluate(rowsOf(strain, stress, branch, e0=1.0), fitFrom=2e3, fitTo=5e4).loops
    assert loop["strain"] == 0.1 and loop["stress"] == 1e5
    assert loop["Cr"] == pytest.approx(2 * 0.04 / 1, rel=1e-12)  # one decade of stress
    assert loop["recovered"] == pytest.approx(0.4, rel=1e-12)
    assert loop["irreversibleStrain"] == 0.06
    reloading, unloading = 0.01 * 3e4 + 0.03 * 7.5e4, 0.04 * 5.5e4  # trapezia
    assert loop["hysteresis"] == pytest.approx((reloading - unloading) / reloading, rel=1e-9)


@pytest.mark.parametrize("angle, cohesion", [(30.0, 0.0), (25.0, 20e3), (0.0, 50e3)])
def test_mohrCoulombGivesBackItsLine(angle, cohesion):
    confining = np.array([20e3, 50e3, 100e3])
    tangent = math.tan(math.radians(45 + angle / 2))
    found = biaxial.mohrCoulomb(confining, confining * tangent**2 + 2 * cohesion * tangent)
    assert found["frictionAngle"] == pytest.approx(angle, abs=1e-9)
    assert found["cohesion"] == pytest.approx(cohesion, abs=1e-6)
    assert found["residual"] < 1e-12
    with pytest.raises(CaseError, match="at least two different confining stresses"):
        biaxial.mohrCoulomb([1e3, 1e3], [3e3, 3e3])


def test_moduliOfALinearSolid():
    axial = np.linspace(0, 0.01, 101)
    rows = rowsOf(axial, 50e3 + 3e6 * axial)
    rows["lateralStrain [-]"] = list(-0.3 * axial)
    found = biaxial.evaluate(rows, 50e3)
    assert found["youngModulus"] == pytest.approx(3e6, rel=1e-9)
    assert found["poissonRatio"] == pytest.approx(0.3, rel=1e-9)
    assert found["peak"] == pytest.approx(80e3, rel=1e-12) and found["strainAtPeak"] == pytest.approx(0.01)


def test_powerLawAndItsError():
    x = np.array([1.0, 10.0, 100.0, 1000.0])
    exponent, error = settling.powerLaw(x, 5 * x**-0.5)
    assert exponent == pytest.approx(-0.5, abs=1e-12) and error < 1e-12
    # Noise of known residuals: y off by (+e, -e, -e, +e) in ln y, orthogonal to the line; the standard error is
    # sqrt(4 e^2/2 / (5 ln(10)^2)).
    e = 0.01
    exponent, error = settling.powerLaw(x, x * np.exp([e, -e, -e, e]))
    assert exponent == pytest.approx(1, abs=1e-12)
    assert error == pytest.approx(math.sqrt(2 * e**2 / (5 * math.log(10) ** 2)), rel=1e-9)


def test_spread():
    assert properties.spread([1.0, 1.1, 0.9]) == pytest.approx(0.2)


class TestHydrateRidge:
    def result(self, index, loops):
        stress = np.geomspace(10e3, 2e6, 400)
        found = compaction.evaluate(
            rowsOf(index / 2.5 * np.log10(stress / 10e3), stress), voidRatio=1.5, fitFrom=100e3, fitTo=1e6
        ).asDict()
        found["loops"] = loops
        return {
            "stiffness": dict.fromkeys(("average", "stiffest", "softest"), 1e7),
            "Cc": dict.fromkeys(("average", "stiffest", "softest"), index),
            "compactions": {"average": found},
            "laboratory": None,
            "local": hydrate_ridge.inReportedRange(found),
        }

    def test_localIndexOfAStraightLine(self):
        found = self.result(0.5, [])["compactions"]["average"]
        stress, index = hydrate_ridge.localIndex(found)
        np.testing.assert_allclose(index, 0.5, rtol=1e-9)
        assert stress[0] == pytest.approx(10e3 * 10**0.15) and stress[-1] == pytest.approx(2e6 / 10**0.15)

    def test_rangeAndWords(self):
        loop = {
            "strain": 0.2,
            "stress": 1e6,
            "Cr": 0.05,
            "recovered": 0.1,
            "irreversibleStrain": 0.18,
            "hysteresis": 0.1,
        }
        inside, outside = self.result(0.5, [loop]), self.result(0.2, [{**loop, "Cr": 0.3}])
        assert inside["local"] and outside["local"] == []
        words = " ".join(hydrate_ridge.verdict(inside))
        assert "within the reported range" in words and "No laboratory curve is drawn" in words
        words = " ".join(hydrate_ridge.verdict(outside))
        assert "lies nowhere inside" in words and "does not agree" in words
