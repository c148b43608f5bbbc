# SPDX-License-Identifier: GPL-2.0-or-later
"""Grain size distributions: what is drawn follows them, and what is no distribution is refused by name."""

import math
import re
from statistics import NormalDist

import numpy as np
import pytest

from capfrac import grading, packing, sediment
from capfrac.errors import CaseError

UNIFORM = grading.Uniform(1e-3, 3e-3)
LOGNORMAL = grading.Lognormal(1e-4, 0.4)
#: Silt to sand: a flat part between 0.2 and 0.3 mm, where the sieve curve has no grains, and none below 0.05 mm either.
SIEVE = grading.Sieve((2e-5, 5e-5, 1e-4, 2e-4, 3e-4, 5e-4), (0, 0, 20, 55, 55, 100))
GRADINGS = pytest.mark.parametrize("curve", [UNIFORM, LOGNORMAL, SIEVE], ids=["uniform", "lognormal", "sieve"])


def draw(curve, count, seed=1):
    return curve.draw(count, np.random.default_rng(seed))


def rankOf(curve, radii):
    """Share of the grains that are smaller than each radius, by number, from the definition of the distribution."""
    if curve is UNIFORM:
        return (radii - 1e-3) / 2e-3
    if curve is LOGNORMAL:
        low = NormalDist().cdf(-2)
        return (np.array([NormalDist(math.log(1e-4), 0.4).cdf(math.log(r)) for r in radii]) - low) / (1 - 2 * low)
    # Mass over ln d is constant in a bin, so numbers go with the integral of d^-2 dln d, done here by sums over fine
    # steps.
    lnD = np.linspace(math.log(5e-5), math.log(5e-4), 400_001)
    middle = np.exp(0.5 * (lnD[1:] + lnD[:-1]))
    edges, percent = np.array(SIEVE.diameter), np.array(SIEVE.passing)
    k = np.searchsorted(edges, middle) - 1
    number = np.concatenate([[0], np.cumsum(np.diff(percent)[k] / np.diff(np.log(edges))[k] / middle**2)])
    return np.interp(np.log(2 * radii), lnD, number / number[-1])


def passingOf(diameters):
    """Per cent by mass that SIEVE passes at ``diameters``: straight over ln d."""
    return np.interp(np.log(diameters), np.log(SIEVE.diameter), SIEVE.passing)


# ---- what is drawn


@GRADINGS
@pytest.mark.parametrize("count", [1, 7, 300])
def test_radiiAreWithinTheirBounds(curve, count):
    for seed in range(20):
        radii = draw(curve, count, seed)
        assert radii.shape == (count,)
        # The inverse of a distribution gives its ends to round-off.
        assert radii.min() >= curve.rMin * (1 - 1e-12) and radii.max() <= curve.rMax * (1 + 1e-12)


def test_bounds():
    assert (UNIFORM.rMin, UNIFORM.rMax) == (1e-3, 3e-3)
    assert LOGNORMAL.rMin == pytest.approx(1e-4 * math.exp(-0.8), rel=1e-15)
    assert LOGNORMAL.rMax == pytest.approx(1e-4 * math.exp(0.8), rel=1e-15)
    assert grading.Lognormal(1e-4, 0.4, cut=1).rMax == pytest.approx(1e-4 * math.exp(0.4), rel=1e-15)
    # Radii: half of the diameters between which mass begins and ends.
    assert (SIEVE.rMin, SIEVE.rMax) == (2.5e-5, 2.5e-4)
    assert grading.Sieve((1e-4, 2e-4, 8e-4), (0, 100, 100)).rMax == 1e-4


@GRADINGS
@pytest.mark.parametrize("count", [1, 10, 301])
def test_eachStratumHoldsOneGrain(curve, count):
    # The k-th smallest of n grains has a rank between k/n and (k+1)/n. Ranks are exact to 1e-12, and those of the sieve
    # to (0.6e-5)^2, the step of the sum in ln d squared: over n = 301, 1e-8 of a stratum.
    for seed in range(5):
        rank = rankOf(curve, np.sort(draw(curve, count, seed))) * count
        assert np.all(rank > np.arange(count) - 1e-6) and np.all(rank < np.arange(count) + 1 + 1e-6)


@pytest.mark.parametrize("count", [11, 301])
@pytest.mark.parametrize(
    "curve, median, width",
    [
        (UNIFORM, 2e-3, lambda share: 2e-3 * share),
        # dr = r spread dz, dz = 0.954 du / phi(0) near the median; strata of 11 grains are
        # narrow enough that the density falls by less than 1 % within them.
        (LOGNORMAL, 1e-4, lambda share: 1e-4 * 0.4 * 0.954 * math.sqrt(2 * math.pi) * share * 1.03),
    ],
)
def test_median(curve, median, width, count):
    # With an odd number the median grain is in the stratum whose middle is the median: half a stratum off at most.
    for seed in range(5):
        assert np.median(draw(curve, count, seed)) == pytest.approx(median, abs=width(0.5 / count))


@pytest.mark.parametrize("count", [300, 20_000])
def test_sieveCurveIsMetByMass(count):
    # One grain in each stratum of numbers. Over the strata below a diameter d, grain's mass and stratum's mean differ
    # by less than the mass grows over each, together by less than m(d); the stratum that d cuts adds another m(d). The
    # whole is right within m_max, which counts as much as the share below d. A bound, not an estimate: up to 16 % for
    # 300 grains (drawn: 3 %), 0.25 % for 20 000 (0.05 %).
    edges = np.geomspace(4e-5, 5e-4, 40)
    for seed in range(5):
        radii = draw(SIEVE, count, seed)
        expected = passingOf(edges)
        tolerance = (2 * edges**2 + expected / 100 * 5e-4**2) / (count * np.mean((2 * radii) ** 2))
        assert np.all(np.abs(grading.passing(radii, edges) - expected) <= 100 * tolerance + 1e-9)
        assert grading.passing(radii, 5e-4) == 100
    # By number the small grains would dominate: far from the curve.
    assert np.mean(2 * radii < 1e-4) > 0.6


def test_flatPartHoldsNoGrains():
    radii = draw(SIEVE, 5000)
    assert (
        not np.any((radii > 1.0000001e-4) & (radii < 1.4999999e-4)) and np.any(radii < 1e-4) and np.any(radii > 1.5e-4)
    )


def test_passingByHand():
    # Masses 1, 4, 9 of 14; a grain passes a sieve of its own diameter.
    np.testing.assert_allclose(
        grading.passing([3, 1, 2], [1.9, 2, 3.9, 4, 6, 9]), [0, 100 / 14, 100 / 14, 500 / 14, 100, 100], rtol=1e-14
    )


@GRADINGS
def test_sameSeedSameRadiiAnotherSeedOthers(curve):
    assert np.array_equal(draw(curve, 100, 3), draw(curve, 100, 3))
    assert not np.array_equal(np.sort(draw(curve, 100, 3)), np.sort(draw(curve, 100, 4)))
    # In random order: sorted grains would settle in layers.
    assert 30 < np.sum(np.diff(draw(curve, 100, 3)) > 0) < 70


@GRADINGS
def test_sedimentTakesBoundsAndRadiiFromItsGrading(curve):
    sample = sediment.Sediment(grainCount=50, grading=curve, seed=4)
    assert (sample.rMin, sample.rMax) == (curve.rMin, curve.rMax)
    assert np.array_equal(packing.drawRadii(sample), draw(curve, 50, 4))
    assert sediment.changed(sample, friction=0.1).grading is curve
    assert sediment.changed(sample, rMin=1e-3, rMax=2e-3).grading is None


# ---- what is refused


def refused(message, call, *arguments, **named):
    with pytest.raises(CaseError) as problem:
        call(*arguments, **named)
    assert str(problem.value) == message


@pytest.mark.parametrize("bad", [0, -1e-3, math.nan, math.inf, "1 mm", None])
def test_impossibleValuesAreRefusedByName(bad):
    refused(f"Uniform.rMin = {bad!r}, allowed: a finite number > 0", grading.Uniform, bad, 1e-3)
    refused(f"Uniform.rMax = {bad!r}, allowed: a finite number > 0", grading.Uniform, 1e-3, bad)
    refused(f"Lognormal.median = {bad!r}, allowed: a finite number > 0", grading.Lognormal, bad, 0.2)
    refused(f"Lognormal.spread = {bad!r}, allowed: a finite number > 0", grading.Lognormal, 1e-3, bad)
    refused(f"Lognormal.cut = {bad!r}, allowed: a finite number > 0", grading.Lognormal, 1e-3, 0.2, bad)


def test_uniformBoundsInOrder():
    refused("Uniform.rMax = 0.001 m, allowed: >= rMin = 0.002 m", grading.Uniform, 2e-3, 1e-3)
    assert set(draw(grading.Uniform(1e-3, 1e-3), 5)) == {1e-3}


MONOTONE = "allowed: larger diameters, percentages that do not fall (a sieve curve is monotone)"
RANGE = "allowed: diameter > 0, 0 to 100 %"
ENDS = "allowed: from 0 % (add the diameter of the finest grain) to 100 % (add that of the coarsest)"
BAD_CURVES = [
    (
        (1e-4, 2e-4, 3e-4),
        (0, 60, 50),
        f"sieve curve, entry 3: diameter 0.0003 m after 0.0002 m, passing 50 % after 60 %; {MONOTONE}",
    ),
    (
        (1e-4, 3e-4, 2e-4),
        (0, 60, 100),
        f"sieve curve, entry 3: diameter 0.0002 m after 0.0003 m, passing 100 % after 60 %; {MONOTONE}",
    ),
    (
        (1e-4, 1e-4),
        (0, 100),
        f"sieve curve, entry 2: diameter 0.0001 m after 0.0001 m, passing 100 % after 0 %; {MONOTONE}",
    ),
    ((-1e-4, 2e-4), (0, 100), f"sieve curve, entry 1: diameter -0.0001 m, passing 0 %; {RANGE}"),
    ((0, 2e-4), (0, 100), f"sieve curve, entry 1: diameter 0 m, passing 0 %; {RANGE}"),
    ((1e-4, math.inf), (0, 100), f"sieve curve, entry 2: diameter inf m, passing 100 %; {RANGE}"),
    ((1e-4, math.nan), (0, 100), f"sieve curve, entry 2: diameter nan m, passing 100 %; {RANGE}"),
    ((1e-4, 2e-4), (0, 101), f"sieve curve, entry 2: diameter 0.0002 m, passing 101 %; {RANGE}"),
    ((1e-4, 2e-4), (-1, 100), f"sieve curve, entry 1: diameter 0.0001 m, passing -1 %; {RANGE}"),
    ((1e-4, 2e-4, 3e-4), (0, math.nan, 100), f"sieve curve, entry 2: diameter 0.0002 m, passing nan %; {RANGE}"),
    ((1e-4, 2e-4), (5, 100), f"sieve curve: runs from 5 % to 100 % passing, {ENDS}"),
    ((1e-4, 2e-4), (0, 95), f"sieve curve: runs from 0 % to 95 % passing, {ENDS}"),
    ((1e-4,), (100,), "sieve curve: 1 diameters and 1 percentages, allowed: as many of both, at least two"),
    ((1e-4, 2e-4), (0, 50, 100), "sieve curve: 2 diameters and 3 percentages, allowed: as many of both, at least two"),
    ((), (), "sieve curve: 0 diameters and 0 percentages, allowed: as many of both, at least two"),
]


@pytest.mark.parametrize("diameter, passing, message", BAD_CURVES)
def test_badSieveCurvesAreRefusedByEntry(diameter, passing, message):
    refused(message, grading.Sieve, diameter, passing)


# ---- files


def write(path, text):
    path.write_text(text, encoding="utf-8")
    return path


def test_sieveFile(tmp_path):
    path = write(
        tmp_path / "curve.csv",
        "# silt, sieved by hand\n diameter , laboratory, passing \n5e-5,a,0\n\n1e-4,b,20\n# coarse\n5e-4,c,100\n",
    )
    assert grading.readSieve(path) == grading.Sieve((5e-5, 1e-4, 5e-4), (0, 20, 100))


BAD_FILES = [
    (diameter, passing, message)
    for diameter, passing, message in BAD_CURVES
    if len(diameter) == len(passing) > 1 and RANGE not in message
]


@pytest.mark.parametrize("diameter, passing, message", BAD_FILES)
def test_badCurvesInFilesAreRefusedByLine(tmp_path, diameter, passing, message):
    rows = "".join(f"{d!r},{p!r}\n" for d, p in zip(diameter, passing))
    path = write(tmp_path / "curve.csv", f"# by hand\n\ndiameter,passing\n{rows}")
    place, _, text = message.partition(": ")
    entry = place.partition(", entry ")[2]  # the first is in line 4
    refused(f"{path}{f', line {int(entry) + 3}' if entry else ''}: {text}", grading.readSieve, path)


@pytest.mark.parametrize(
    "text, message",
    [
        (
            "diameter,passing\n1e-4,0\n2e-4,many\n",
            "line 3: passing = 'many', allowed: a finite number >= 0 and <= 100 [%]",
        ),
        (
            "diameter,passing\n1e-4,0\n2e-4,101\n",
            "line 3: passing = '101', allowed: a finite number >= 0 and <= 100 [%]",
        ),
        (
            "diameter,passing\n1e-4,-1\n2e-4,100\n",
            "line 2: passing = '-1', allowed: a finite number >= 0 and <= 100 [%]",
        ),
        ("passing;d [mm]\n0;0\n100;0,2\n", "line 2: d [mm] = '0', allowed: a finite number > 0"),
        ("passing;d [mm]\n0;0,1\n100;inf\n", "line 3: d [mm] = 'inf', allowed: a finite number > 0"),
        (
            "diameter,passing\n1e-4,0\n2e-4\n",
            "line 3: 1 field (2e-4), allowed: 2, one for each column of line 1 (diameter | passing)",
        ),
        ("diameter,passing\n1e-4,0\n,100\n", "line 3: diameter = '', allowed: a finite number > 0"),
        (
            "diameter,passing,diameter\n1e-4,0,1e-4\n",
            "line 1: the columns 'diameter' and 'diameter' both give diameter; allowed: one",
        ),
    ],
)
def test_badFieldsAreRefusedByLineAndColumn(tmp_path, text, message):
    path = write(tmp_path / "curve.csv", text)
    refused(f"{path}, {message}", grading.readSieve, path)


@pytest.mark.parametrize(
    "text",
    [
        "diameter [mm];passing [%]\n0,05;0\n0,1;20\n0,5;100\n",
        "# d [um]\tpassing [-]\n50\t0\n100\t0.2\n500\t1\n",
        "Passing (%) Radius (mm)\n0 0.025\n20 0.05\n100 0.25\n",
    ],
)
def test_sieveFilesInOtherUnits(tmp_path, text):
    assert grading.readSieve(write(tmp_path / "curve.csv", text)) == grading.Sieve((5e-5, 1e-4, 5e-4), (0, 20, 100))


def test_filesThatAreNoSieveCurves(tmp_path):
    missing = tmp_path / "missing.csv"
    refused(f"the sieve curve {missing} cannot be read: No such file or directory", grading.readSieve, missing)
    refused(f"the sieve curve {tmp_path} cannot be read: Is a directory", grading.readSieve, tmp_path)
    binary = tmp_path / "binary.csv"
    binary.write_bytes(b"diameter,passing\n\xff\xfe,1\n")
    refused(f"the sieve curve {binary} is not a text in UTF-8", grading.readSieve, binary)


@pytest.mark.parametrize("text", ["", "# nothing\n", "size,share\n1e-4,0\n", "diameter\n1e-4\n", "1e-4,0\n2e-4,100\n"])
def test_wrongColumns(tmp_path, text):
    path = write(tmp_path / "curve.csv", text)
    wrong = "(columns .*; needed: diameter .*, passing|numbers, but no line)"
    with pytest.raises(CaseError, match=rf"^{re.escape(str(path))}, line 1: {wrong}"):
        grading.readSieve(path)


def test_fileWithoutEntries(tmp_path):
    path = write(tmp_path / "curve.csv", "diameter,passing\n")
    refused(f"{path}: the sieve curve has no rows of numbers, needed: at least one", grading.readSieve, path)
