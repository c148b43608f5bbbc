# SPDX-License-Identifier: GPL-2.0-or-later
"""Domains, the pores of the paper: cells that hang together across open contacts, as contacts open and close."""

import math

import pytest
from yade import O

R = 1e-3


def test_domainsFollowContacts(square):
    # All grains and walls touch: the pore in the middle (two cells), four corners, one pore at the middle of each wall.
    engine = square(-1e-4 * R)
    assert (engine.nCells, engine.nDomains) == (10, 9)
    # The right pair moves away from the left one: middle, bottom and top pores become one.
    right = [6 - 1, 8 - 1]
    for i in right:
        O.bodies[i].state.pos += (0.005 * R, 0, 0)
    O.bodies[1].state.pos += (0.005 * R, 0, 0)
    O.step()
    assert engine.nDomains == 7
    # Back to a gap of 0.7 of the tolerance: still open, because it closes below half of it only.
    gaps = engine.throats()["gap"]
    here = max(gaps[k] for k, ids in enumerate(engine.throats()["ids"]) if tuple(ids) == (4, 5))
    for wanted, domains in ((0.7e-3 * R, 7), (0.4e-3 * R, 9), (0.7e-3 * R, 9), (1.1e-3 * R, 7)):
        for i in right + [1]:
            O.bodies[i].state.pos += (wanted - here, 0, 0)
        here = wanted
        O.step()
        assert engine.nDomains == domains


def test_openDomainIsOnePoreAndOneVolume(square):
    engine = square(0.1 * R)
    assert engine.nDomains == 1
    cells = engine.cells()
    assert set(cells["domain"]) == {0}
    assert math.fsum(cells["water"]) == pytest.approx(engine.volumes()["void"], rel=1e-14)
    assert not any(cells["gas"]) and not any(cells["phase"])


def test_trianglesAreTheirOwnPores(square):
    engine = square(0.1 * R, poreMode="triangle")
    assert engine.nDomains == engine.nCells == 10
    assert sorted(engine.cells()["domain"]) == list(range(10))


def test_poreModeCanBeChanged(square):
    engine = square(0.1 * R)
    engine.poreMode = "triangle"
    assert len(set(engine.cells()["domain"])) == 10
