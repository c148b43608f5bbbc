# SPDX-License-Identifier: GPL-2.0-or-later
"""Trapped water that leaves by films: linear in time, q = K (P_c - P_e), pore after pore."""

import math

import pytest
from yade import O

K = 1e-8  # m^3/(Pa s): a pore of some 3e-7 m^3 empties within some hundred steps of a millisecond


@pytest.fixture
def trapped(standing):
    """A function (**attributes) -> gas engine in grains that stand still, drained at 300 Pa with clusters of water
    left; time steps of 1 ms.
    """

    def make(**attributes):
        gas = standing(trapping=True, gasPressure=300, **attributes)
        O.dt = 1e-3
        O.step()
        assert gas.nTrappedWater > 3
        return gas

    return make


def clusters(gas):
    """Clusters of water without an outlet, from the reported lists: (cells, lowest entry pressure to gas, cells of the
    pore behind that throat).
    """
    cells, throats = gas.cells(), gas.throats()
    water = {c for c, phase in enumerate(cells["phase"]) if not phase}
    edges = [(a, b, p) for (a, b), p in zip(throats["cells"], throats["entryPressure"]) if a >= 0 and b >= 0]
    free = {c for c in water if 3 in cells["vertices"][c]}
    found, left = [], set(water)
    while left:
        group = {left.pop()}
        grown = True
        while grown:
            more = {y for a, b, _ in edges for x, y in ((a, b), (b, a)) if x in group and y in water and y not in group}
            group |= more
            grown = bool(more)
        left -= group
        if not group & free:
            p, behind = min(
                ((p, y) for a, b, p in edges for x, y in ((a, b), (b, a)) if y in group and x not in water),
                default=(math.inf, None),
            )
            found.append(
                (
                    group,
                    p,
                    (
                        {c for c in group if cells["domain"][c] == cells["domain"][behind]}
                        if behind is not None
                        else set()
                    ),
                )
            )
    return found


def test_waterLeavesLinearlyInTime(trapped):
    gas = trapped()
    state, waterBefore = clusters(gas), gas.volumes()["water"]
    rate = sum(K * max(0, 300 - p) for _, p, _ in state)
    volume = {c: v for c, v in enumerate(gas.cells()["void"])}
    first = min(sum(volume[c] for c in behind) / (K * (300 - p)) for _, p, behind in state if p < 300)
    gas.filmConductance = K
    steps = int(0.9 * first / O.dt)
    assert 20 < steps < 20000
    for part in range(1, 4):
        O.run(steps // 3, True)
        # Sums of some thousand additions, 1e-16 of the water each.
        assert waterBefore - gas.volumes()["water"] == pytest.approx(rate * part * (steps // 3) * O.dt, rel=1e-9)
        assert gas.volumes()["error"] < 1e-12
    assert gas.nEvents == len(gas.events()["throat"])


def test_poresEmptyAfterTheirVolumeOverTheFlow(trapped):
    """A pore takes V/q, to a step of time (what is left of a step is not carried on)."""
    gas = trapped()
    gas.filmConductance = K
    begin, water = O.time, gas.cells()["water"]
    due = sorted(
        (begin + sum(water[c] for c in behind) / (K * (300 - p)), sorted(behind))
        for _, p, behind in clusters(gas)
        if p < 299
    )
    assert len(due) > 2
    # The first pores of all clusters: each cluster empties by itself.
    for when, behind in due[:3]:
        O.run(max(1, int((when - O.time) / O.dt) - 1), True)
        phase = gas.cells()["phase"]
        assert not any(phase[c] for c in behind)
        O.run(3, True)
        phase = gas.cells()["phase"]
        assert all(phase[c] for c in behind), "it is gas when its water is gone"


def test_pressureOfACluster(trapped):
    gas = trapped(waterPressure=20)
    # locked: as ever
    assert {p for p, phase in zip(gas.cells()["pressure"], gas.cells()["phase"]) if not phase} == {20}
    gas.filmConductance = K
    pressures = gas.cells()["pressure"]
    for group, p, _ in clusters(gas):
        assert all(pressures[c] == max(20, 300 - p) for c in group)


def test_lockedStaysLocked(trapped):
    gas = trapped()
    before = gas.volumes()
    O.run(200, True)
    assert gas.volumes() == before
