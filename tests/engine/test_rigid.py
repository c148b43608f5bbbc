# SPDX-License-Identifier: GPL-2.0-or-later
"""capfrac.rigid: networks given as arrays, drained by the engines' code, against a drainage written out here."""

import heapq
import math
from dataclasses import replace

import numpy as np
import pytest

from capfrac import _kernels, rigid
from capfrac.errors import CaseError


def plainDrainage(network, trapping):
    """Pores in the order of invasion up to the first outlet: a heap of throats, and a search for the outlet before each
    pore.
    """
    beside = [[] for _ in network.gas]
    for t, (a, b) in enumerate(zip(network.left, network.right)):
        beside[a].append((t, b))
        beside[b].append((t, a))
    gas = np.array(network.gas, dtype=bool)

    def hasOutlet(pore):
        seen, stack = {pore}, [pore]
        while stack:
            p = stack.pop()
            if network.outlet[p]:
                return True
            for _, q in beside[p]:
                if not gas[q] and q not in seen:
                    seen.add(q)
                    stack.append(q)
        return False

    front = []
    for p in np.flatnonzero(gas):
        for t, q in beside[p]:
            heapq.heappush(front, (network.entryPressure[t], q))
    order = []
    while front:
        _, p = heapq.heappop(front)
        if gas[p] or trapping and not hasOutlet(p):
            continue
        gas[p] = True
        order.append(p)
        if network.outlet[p]:
            return order
        for t, q in beside[p]:
            heapq.heappush(front, (network.entryPressure[t], q))
    return order


@pytest.mark.parametrize("inlet", rigid.INLETS)
@pytest.mark.parametrize("trapping", [False, True])
@pytest.mark.parametrize("make", [rigid.squareLattice, rigid.delaunay])
def test_agreesWithAPlainDrainage(make, inlet, trapping):
    trapped = 0
    for seed in range(8):
        network = make(14, 17, seed, inlet)
        found = rigid.drain(network, trapping=trapping)
        assert found.pores.tolist() == plainDrainage(network, trapping)
        assert found.brokeThrough and network.outlet[found.pores].sum() == 1
        assert found.saturation == len(found.pores) / network.count
        trapped += len(found.trapped)
    assert (trapped > 0) == trapping


def test_latticeOfSixPores():
    # 2 x 3: two throats across the rows, four along the columns, two to the reservoir below, pore 6.
    network = rigid.squareLattice(2, 3, seed=3)
    assert network.count == 6 and network.spacing == 1 and network.box == (2.0, 3.0)
    pairs = sorted(zip(network.left.tolist(), network.right.tolist()))
    assert pairs == [(0, 1), (0, 2), (1, 3), (2, 3), (2, 4), (3, 5), (4, 5), (6, 0), (6, 1)]
    assert network.gas.tolist() == [0] * 6 + [1] and network.outlet.tolist() == [0, 0, 0, 0, 1, 1, 0]
    at = {pair: k for k, pair in enumerate(zip(network.left.tolist(), network.right.tolist()))}
    assert (network.x[at[2, 3]], network.y[at[2, 3]]) == (1.0, 1.5) and (network.x[at[6, 1]], network.y[at[6, 1]]) == (
        1.5,
        0.5,
    )
    entry = np.full(9, 9.0)
    for k, pair in enumerate([(6, 1), (1, 3), (0, 1), (2, 3), (3, 5)]):
        entry[at[pair]] = k + 1.0
    found = rigid.drain(replace(network, entryPressure=entry))
    assert found.pores.tolist() == [1, 3, 0, 2, 5] and found.throats.tolist() == [
        at[p] for p in [(6, 1), (1, 3), (0, 1), (2, 3), (3, 5)]
    ]
    assert rigid.drain(replace(network, entryPressure=entry), capillaryPressure=3.0).pores.tolist() == [1, 3, 0]
    assert not rigid.drain(replace(network, entryPressure=entry), capillaryPressure=3.0).brokeThrough
    assert sorted(rigid.drain(network, untilBreakthrough=False).pores.tolist()) == list(range(6))


def test_latticeFromTheCentre():
    network = rigid.squareLattice(5, 5, inlet="centre")
    assert np.flatnonzero(network.gas).tolist() == [12] and len(network.left) == 40 and network.outlet.sum() == 16


def test_triangulation():
    network = rigid.delaunay(60, 40, seed=5)
    # Poisson numbers of points, about 1200 in the box: five standard deviations; two triangles each.
    assert network.count == pytest.approx(2400, abs=5 * 2 * math.sqrt(1200))
    degree = np.bincount(np.concatenate([network.left, network.right]), minlength=network.count + 1)
    x, y = network.poreX[:-1], network.poreY[:-1]
    inner = (
        (x > 0.1 * network.box[0])
        & (x < 0.9 * network.box[0])
        & (y > 0.1 * network.box[1])
        & (y < 0.9 * network.box[1])
    )
    assert np.all(degree[:-1][inner] == 3) and degree[:-1].max() == 3
    assert len(
        {frozenset(pair) for pair in zip(network.left.tolist(), network.right.tolist()) if network.count not in pair}
    ) == np.count_nonzero(network.right != network.count)
    # Along either end about sqrt(points per length) edges leave; all outlets are near the top, all pores on the
    # reservoir near the bottom.
    low, high = network.left[network.right == network.count], np.flatnonzero(network.outlet)
    assert len(low) > 20 and len(high) > 20
    assert y[low].max() < 0.15 * network.box[1] and y[high].min() > 0.85 * network.box[1]
    # Area of the disks over that of the box, in the mean of the Poisson process: 0.84 by the scale of lengths.
    r2 = (1e-3**2 + 1e-3 * 5 / 3 * 1e-3 + (5 / 3 * 1e-3) ** 2) / 3
    assert 0.5 * 60 * 40 * math.pi * r2 / (network.box[0] * network.box[1]) == pytest.approx(0.84, rel=1e-12)


def test_entryPressuresAreEquation15():
    gap, radius = np.array([0.0, 1e-4, -5e-4, 3e-3]), np.array([1e-3, 2e-3, 1e-3, 1.5e-3])
    expected = 2 * 0.05 / (np.sqrt(radius**2 + (radius + gap / 2) ** 2) - radius)
    np.testing.assert_allclose(rigid.entryPressures(gap, radius, 0.05), expected, rtol=1e-14)
    with pytest.raises(CaseError, match=r"throat 1: gap of the throat \[m\] = -0.003, allowed"):
        rigid.entryPressures(np.array([0.0, -3e-3]), np.array([1e-3, 1e-3]), 0.05)


@pytest.mark.parametrize("make", [rigid.squareLattice, rigid.delaunay])
def test_sameSeedSameNetwork(make):
    one, same, other = (make(20, 20, seed) for seed in (4, 4, 5))
    assert all(
        np.array_equal(getattr(one, name), getattr(same, name), equal_nan=True)
        for name in ("left", "right", "entryPressure", "poreX", "outlet")
    )
    assert not np.array_equal(one.entryPressure, other.entryPressure)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ((1, 8), "width = 1, allowed: whole numbers >= 2"),
        ((8, 2.5), r"height = 2\.5, allowed"),
        ((8, 8, 0, "top"), "inlet = 'top', allowed: side, centre"),
    ],
)
@pytest.mark.parametrize("make", [rigid.squareLattice, rigid.delaunay])
def test_networksThatCannotBeAreRefused(make, arguments, message):
    with pytest.raises(CaseError, match=message):
        make(*arguments)


def test_grainsThatCannotBeAreRefused():
    with pytest.raises(CaseError, match="rMin = 0.002, rMax = 0.001 m"):
        rigid.delaunay(8, 8, rMin=2e-3, rMax=1e-3)
    with pytest.raises(CaseError, match="solid = 0, allowed: > 0"):
        rigid.delaunay(8, 8, solid=0)


@pytest.mark.parametrize(
    "name, index, value, message",
    [
        ("right", 2, 99, r"right\[2\] = 99, allowed: a pore, 0 … 16"),
        ("left", 0, -1, r"left\[0\] = -1"),
        ("entryPressure", 4, math.nan, r"entryPressure\[4\] = nan, allowed: numbers \[Pa\]"),
    ],
)
def test_entriesAtFaultAreNamed(name, index, value, message):
    network = rigid.squareLattice(4, 4)
    changed = getattr(network, name).copy()
    changed[index] = value
    with pytest.raises(CaseError, match=message):
        rigid.drain(replace(network, **{name: changed}))
    with pytest.raises(CaseError, match=rf"{name}: \d+ values, allowed: \d+|right: 28 values, allowed: 27"):
        rigid.drain(replace(network, **{name: getattr(network, name)[:-1]}))


def test_throatToItselfIsRefused():
    network = rigid.squareLattice(4, 4)
    with pytest.raises(CaseError, match=r"right\[0\] = 0, allowed: another pore than left"):
        rigid.drain(replace(network, right=np.where(np.arange(len(network.right)) == 0, network.left, network.right)))


def test_kernelsRefuseOtherArrays():
    i, d, b = np.zeros(1, np.int32), np.zeros(1), np.zeros(2, np.uint8)
    one = np.ones(1, np.int32)
    good = [i, one, d, d, d, b, b, 1.0]
    assert _kernels.drain(*good) == ([], [], [])
    for k, wrong, message in [
        (
            0,
            i.astype(np.int16),
            "left: 1-dimensional array of 'h', allowed: a one-dimensional contiguous array of int32",
        ),
        (2, np.zeros((1, 1)), "entryPressure: 2-dimensional array of 'd'"),
        (3, np.zeros(4)[::2], "x: something that is no contiguous array"),
        (5, 1.0, "gas: something that is no contiguous array"),
        (4, d.astype(np.float32), "y: 1-dimensional array of 'f'"),
    ]:
        with pytest.raises(TypeError, match=message):
            _kernels.drain(*good[:k], wrong, *good[k + 1 :])
    with pytest.raises(ValueError, match=r"maxSteps \[-\] = 0, allowed: >= 1"):
        _kernels.drain(*good, maxSteps=0)
    with pytest.raises(ValueError, match=r"capillaryPressure \[Pa\] = nan"):
        _kernels.drain(*good[:7], math.nan)
