# SPDX-License-Identifier: GPL-2.0-or-later
"""Invasion percolation in rigid networks against the fractal dimensions of the literature:
capfrac.verification.percolation.

Small networks here; 1e5 pores and more are in tests/validation.
"""

import numpy as np
import pytest

from capfrac import rigid
from capfrac.errors import CaseError
from capfrac.lab.run import LabRun
from capfrac.verification import percolation, percolation_figures


@pytest.fixture(scope="module")
def found():
    return percolation.percolation(
        sizes=(16, 32, 64), delaunaySizes=(16, 32, 64), samples=80, delaunaySamples=25, radiusSize=512, radiusSamples=30
    )


@pytest.mark.parametrize("network", ["square", "delaunay"])
@pytest.mark.parametrize("kind", ["free", "trapping"])
def test_massGrowsLikeThePowerOfTheLiterature(found, network, kind):
    one = found[network][kind]
    # Masses of single clusters scatter by a quarter, so 320, 160 and 80 of them (100, 50 and 25) give slopes to 0.25
    # (1/320 + 1/80)^(1/2)/ln 4 = 0.023 (0.04): the fit's own error, four of which are allowed, and 0.03 for what small
    # sizes leave of corrections to the power.
    assert one["dimensionError"] < {"square": 0.03, "delaunay": 0.055}[network]
    assert one["dimension"] == pytest.approx(percolation.DIMENSIONS[kind], abs=4 * one["dimensionError"] + 0.03)


@pytest.mark.parametrize("network", ["square", "delaunay"])
def test_trappingMakesTheGasThinner(found, network):
    free, trapping = found[network]["free"], found[network]["trapping"]
    ratio = np.array(trapping["mass"]) / free["mass"]
    # The same networks, so the ratio scatters far less than the masses; it falls like L^(1.82 - 1.896): 10 % over a
    # factor of four.
    assert np.all(np.diff(ratio) < 0) and ratio[-1] / ratio[0] == pytest.approx(4 ** (1.82 - 91 / 48), abs=0.05)
    assert np.all(np.diff(trapping["saturation"]) < 0) and np.all(np.array(trapping["saturation"]) < free["saturation"])


@pytest.mark.parametrize("kind", ["free", "trapping"])
def test_massWithinARadius(found, kind):
    one = found["radius"][kind]
    # Radii from 4 to 16 pores of 30 clusters: four standard errors, and 0.1 for a slope that falls with the radius,
    # from 1.96 to 1.82 without trapping.
    assert one["dimension"] == pytest.approx(percolation.DIMENSIONS[kind], abs=4 * one["dimensionError"] + 0.1)
    assert (
        one["radius"][0] == pytest.approx(4)
        and one["radius"][-1] == pytest.approx(16)
        and np.all(np.diff(one["mass"]) > 0)
    )


def test_fitOfAPower():
    x = [10, 20, 40, 80]
    y = [3 * v**1.7 for v in x]
    assert percolation.fitPower(x, y, [0.1 * v for v in y])[0] == pytest.approx(1.7, abs=1e-12)
    # Two points: the slope's error is that of their difference over ln 2.
    assert percolation.fitPower([1, 2], [1, 2], [0.03, 0.08])[1] == pytest.approx(np.hypot(0.03, 0.04) / np.log(2))
    # A point with a large error does not count.
    assert percolation.fitPower(x, y[:3] + [9 * y[3]], [1e-3 * v for v in y[:3]] + [1e6 * y[3]])[0] == pytest.approx(
        1.7, abs=1e-6
    )


def test_massIsThatOfTheMiddleHalf():
    network = rigid.squareLattice(3, 8, seed=1)
    drainage = rigid.drain(network, untilBreakthrough=False)
    assert len(drainage.pores) == 24 and percolation.clusterMass(network, drainage) == 12


def test_runGoesOnWhereItStopped(tmp_path, monkeypatch):
    small = {"sizes": (8, 12, 16), "delaunaySizes": (), "samples": 4, "radiusSize": 512, "radiusSamples": 3}
    whole = percolation.percolation(**small)
    drain, calls = percolation._drainOne, []

    def interrupted(network):
        calls.append(network)
        if len(calls) > 9:
            raise KeyboardInterrupt
        return drain(network)

    monkeypatch.setattr(percolation, "_drainOne", interrupted)
    with pytest.raises(KeyboardInterrupt):
        percolation.percolation(**small, run=LabRun("percolation", {}, tmp_path / "run"))
    calls.clear()
    monkeypatch.setattr(percolation, "_drainOne", lambda network: calls.append(network) or drain(network))
    assert percolation.percolation(**small, run=LabRun("percolation", {}, tmp_path / "run")) == whole
    assert len(calls) == 5 + 4  # the eight smallest were done


@pytest.mark.parametrize(
    "own, message",
    [
        ({"sizes": (16, 32)}, r"sizes of the square networks = \[16, 32\], allowed: three or more"),
        ({"delaunaySizes": (32, 16, 64)}, "sizes of the delaunay networks"),
        ({"sizes": (4, 16, 32)}, "whole numbers >= 8"),
        ({"samples": 1}, "samples = 1, allowed: >= 2"),
        ({"radiusSize": 500}, "radiusSize = 500, allowed: >= 512"),
    ],
)
def test_parametersOutOfRangeAreRefused(own, message):
    with pytest.raises(CaseError, match=message):
        percolation.percolation(
            **{"sizes": (), "delaunaySizes": (), "samples": 2, "radiusSamples": 2, "radiusSize": 512, **own}
        )


def test_pictureOfOneNetworkAlone(found, tmp_path):
    alone = {name: found[name] for name in ("square", "radius", "literature")}
    for name in ("one.svg", "other.svg"):
        percolation_figures.drawPercolation(alone, tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "other.svg").read_bytes()
