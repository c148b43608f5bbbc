# SPDX-License-Identifier: GPL-2.0-or-later
"""The numbers of the sediment laboratory and of single-phase flow at full size (long: see `--validation`)."""

import pytest

from capfrac.lab import command, parameters
from runs import FOLDER

pytestmark = pytest.mark.validation


def results(name, test, raw):
    """The results of a test, from its finished run folder if there is one."""
    return command.runTest(test, parameters.resolve(test, raw), FOLDER / f"lab-{name}")


def test_timeStepGoesWithRadiusAndStiffness():
    found = results("timestep", "timestep", {})
    # Eq. 7, and what two samples of 300 grains a point leave: 1 % is the project's aim.
    assert found["radius"]["exponent"] == pytest.approx(1, abs=0.01)
    assert found["stiffness"]["exponent"] == pytest.approx(-0.5, abs=0.005)


def test_compactionTo25PerCent():
    found = results("compact", "compact", {})
    assert found["Cc"] > 0 and len(found["loops"]) == 4
    # Quasi-static: inertial numbers below 1e-3, the mean resultant force a few per cent of a contact's.
    assert found["quasiStatic"]["inertialNumber"] < 1e-3 and found["quasiStatic"]["unbalanced"] < 0.05


def test_stiffnessForARequestedIndex():
    found = results("fit", "fit", {"fit": {"compressionIndex": 0.5, "voidRatio": 1.5}})
    assert found["Cc"] == pytest.approx(0.5, rel=0.02)


def test_grainSizeDoesNotMatter():
    found = results("sizes", "sizes", {"sizes": {"bondStrength": 100e3}})
    assert max(found["spread"].values()) < 0.05


def test_storageIsThePorosityAndPressureDiffuses():
    found = results("diffusion", "diffusion", {"grains": {"count": 1000, "rMin": 1e-2, "aspect": 1.4}})
    # Porosity, weighted by p (1 - p): it varies by a tenth among twenty layers, 0.45 0.1/sqrt(20) = 1 %; three times
    # that. 0.8 % measured.
    assert found["storageTimesBulkModulus"] == pytest.approx(found["porosityBetween"], rel=0.03)
    # A layer conducts as its fifty throats do, which differ by half: 0.07. A walk of twenty such steps, tied at both
    # ends, is off the straight line by 0.07 sqrt(20)/(2 20) = 0.8 % half-way, three times that at most, and 0.6 to 1.6
    # % were measured. Not where the front is steep.
    assert max(found["layerErrors"][2:]) < 0.024
    # Single pores, 3 % asked for: 2.8 and 2.9 % measured at tau = 1.404 and 0.175, 3.8 % at 0.0829, more before. Half a
    # grain in a height of forty is 1.3 % of a straight line, and of 850 pores the one furthest off has three times
    # that.
    assert max(found["profileErrors"][-2:]) < 3 * 0.5 * found["diameter"] / found["height"]
    # In grains the distance is the same at all times.
    assert max(found["placeErrors"]["largest"]) < 2 and max(found["placeErrors"]["rms"]) < 0.6
    assert found["convergence"]["orders"] == pytest.approx([1, 1], abs=0.02)


COARSE = {"rMin": 1e-2, "shearStiffness": 4e6}
LATTICE = {**COARSE, "rMax": 1e-2}


@pytest.mark.parametrize("name, bondStrength", [("undrained", 1e6), ("undrained-unbonded", 1e2)])
def test_effectiveStressIsTheDryCurve(name, bondStrength):
    found = results(
        name,
        "undrained",
        {"grains": {"count": 100, **COARSE}, "undrained": {"grainBulkModulus": 5e7, "bondStrength": bondStrength}},
    )
    soft = found["compressible"]
    # b to its standard error and what one porosity and one modulus leave out of a sample of 100 grains.
    assert soft["biot"] == pytest.approx(soft["biotExpected"], abs=0.01)
    for one in (found, soft):
        assert one["misfit"] < 0.05 and one["biotError"] < 0.01 and one["ledger"] < 1e-12
        assert one["skempton"] == pytest.approx(one["skemptonExpected"], rel=0.02)
        assert one["biotModulus"] == pytest.approx(one["biotModulusExpected"], rel=0.05)


def test_terzaghi():
    found = results("terzaghi", "terzaghi", {"grains": {"count": 400, "aspect": 14, **LATTICE}})
    # The drained top row of 80 settles at once: half a per cent of the settlement too early, 4 % of the time to a
    # quarter of it.
    assert found["timeRatios"] == pytest.approx([1] * 4, abs=0.05) and found["ledger"] < 1e-12


def test_mandel():
    found = results("mandel", "mandel", {"grains": {"count": 500, "aspect": 0.15, **LATTICE}})
    assert found["undrainedRatio"] == pytest.approx(1, abs=0.06)
    assert found["peak"] - 1 == pytest.approx(found["peakExpected"] - 1, rel=0.2)
    assert found["timeRatios"] == pytest.approx([1] * 4, abs=0.05) and found["ledger"] < 1e-12


def test_waterAtTheDryTimeStepForALongTime():
    found = results("stability", "stability", {"grains": {"count": 150, **COARSE}})
    for name, one in found["shake"].items():
        staggered = name.endswith(("implicit", "explicit"))
        assert (one["end"] == "bounded") != staggered and one["ledger"] < 1e-10
        assert one["stepsDone"] < 100 if staggered else one["energy"] < 1.05
    for one in found["stir"].values():
        assert one["flipsTotal"] > 1000 and one["ledger"] < 1e-10 and abs(one["massDefect"]) < 1e-10


def test_fractalDimensionOfTheGas():
    found = results(
        "percolation",
        "percolation",
        {
            "percolation": {
                "sizes": [64, 128, 256, 512, 1024],
                "samples": 60,
                "delaunaySizes": [64, 128, 256],
                "delaunaySamples": 40,
                "radiusSize": 1024,
                "radiusSamples": 60,
            }
        },
    )
    for kind, one in found["square"].items():
        # The project's aim is 0.03; standard errors are 0.007.
        assert one["dimension"] == pytest.approx(found["literature"][kind], abs=0.03)
    for kind, one in found["delaunay"].items():
        # Fewer of them: 0.03 and two standard errors.
        assert one["dimension"] == pytest.approx(found["literature"][kind], abs=0.03 + 2 * one["dimensionError"])
    for network in ("square", "delaunay"):
        free, trapping = found[network]["free"], found[network]["trapping"]
        assert free["dimension"] - trapping["dimension"] > 0.03 and trapping["saturation"] == sorted(
            trapping["saturation"], reverse=True
        )
