# SPDX-License-Identifier: GPL-2.0-or-later
"""The fracture test against two independent answers: the linear lattice, and linear elastic fracture mechanics."""

import math

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve
from yade import O

from capfrac import sediment
from capfrac.errors import CaseError, SampleError
from capfrac.theory import lattice_crack
from capfrac.theory.lattice_crack import finiteWidth, tipForces
from capfrac.verification import toughness
from capfrac.verification.handmade import squareLattice

STRENGTH, STRESS = 100e3, 3e3


def grains(**values):
    return sediment.Sediment(**{"rMin": 1e-3, "rMax": 1e-3, "friction": 0.0, **values})


@pytest.mark.parametrize("broken", [1, 3])
def test_firstBondBreaksWhereTheLinearLatticeSays(broken):
    # The ramp rises by 1 % of P - sigma. Bonds stretch by 2 sigma_c/k_n = 2 % of the radius until they break: chords,
    # and with them the forces of the gas, change by no more than that.
    found = toughness.latticeTest(grains(), broken, 12 + broken % 2, 12, STRESS, STRENGTH)
    assert found["inletPores"] == broken + 1
    assert found["brokenBonds"] in (1, 2)  # the bond at one tip, or those at both
    assert found["pressure"] == pytest.approx(found["expected"], rel=0.03)


def test_rampThatEndsTooEarlyIsReported():
    # One pore alone: its bonds bear 1.4 sigma_c and more, the ramp ends at 0.09 sigma_c.
    with pytest.raises(SampleError, match="no bond at the tips of the crack broke up to"):
        sample = grains()
        disks, box = squareLattice(12, 12, 1e-3)
        sediment.buildScene(sample, *np.array(disks).T, box)
        sediment.compress(sample, STRESS, STRESS)
        sediment.bond(tensileStrength=STRENGTH, shearStrength=STRENGTH)
        toughness.pressurise((12e-3, 12e-3), 2e-3, [(12e-3, 12e-3)], [], (5e3, 9e3, 2e3), STRENGTH, 1e-3, "domain")


def test_latticeWithoutStressConcentrationOfItsOwn():
    # Forces of the gas on the grains balance, and those of the stress: what the crack's contacts bore goes round it. So
    # all bonds of the middle row together bear the stress on the width: the mean tension of the ligament is -sigma W/(W
    # - 2a) once the crack is open.
    columns, rows, broken = 16, 16, 4
    lattice = lattice_crack._Lattice(columns, rows, 1.0, 1.0)
    first, lower = (columns - broken) // 2, rows // 2 - 1
    crack = {(i, lower) for i in range(first, first + broken)}
    force = np.zeros(lattice.size)
    for i, row in crack:
        force[lattice.node(i, row) + 1] += 1.0
        force[lattice.node(i, row + 1) + 1] -= 1.0
    moved = spsolve(lattice.assemble(crack).tocsc(), force)
    tension = [
        moved[lattice.node(i, lower + 1) + 1] - moved[lattice.node(i, lower) + 1]
        for i in range(columns)
        if (i, lower) not in crack
    ]
    assert sum(tension) == pytest.approx(-broken)  # the wall's force does not change
    assert 1.0 - tension[first - 1] == pytest.approx(tipForces(columns, rows, broken)[1])


def test_latticeOpensLikeAnEllipse():
    # LEFM: a pressure p opens a crack of length 2a by the area 2 pi a^2 p/E, E = k_n/w with Poisson's ratio 0 (k_s =
    # k_n makes the square lattice isotropic). Here by the sum of 2 r times the openings over the broken contacts, under
    # the stress that they bore. The discrete crack is longer than its contacts by something of the order of half a
    # spacing at each end, between n and n + 1 spacings; boxes are ten cracks wide.
    for broken in (3, 5):
        columns = 10 * broken + (broken % 2)
        columns += (columns - broken) % 2
        lattice = lattice_crack._Lattice(columns, 2 * (columns // 2), 1.0, 1.0)
        first, lower = (columns - broken) // 2, columns // 2 - 1
        crack = {(i, lower) for i in range(first, first + broken)}
        force = np.zeros(lattice.size)
        for i, row in crack:
            force[lattice.node(i, row) + 1] -= 1.0
            force[lattice.node(i, row + 1) + 1] += 1.0
        moved = spsolve(lattice.assemble(crack).tocsc(), force)
        # Lengths in spacings 2 r, forces over 2 r w, k_n = 1: an opening u is u/(2 r) here, p/E is 1.
        area = sum(
            moved[lattice.node(i, lower + 1) + 1] - moved[lattice.node(i, lower) + 1]
            for i in range(first, first + broken)
        )
        equivalent = math.sqrt(area / (2 * math.pi))  # half-length of the crack with that area
        # 2 %: the width of the box, sec(pi/10)^(1/2) = 1.03 on K
        assert broken / 2 < equivalent < (broken + 1) / 2 * 1.02


def test_latticeConcentratesAsTheRootOfTheLength():
    # perStress is the tension at the tip over that far off: its square grows in proportion to a f^2 once the uniform
    # part is small beside it. Slope 1/alpha, alpha >= 1 (Potyondy & Cundall; 1 where the singular stress is taken over
    # the first grain). The uniform part still counts some 5 % between cracks of 4 and of 10 grains: 1/sqrt(n) of the
    # slope times the 0.15 that the fit leaves over.
    sizes, squares = [], []
    for broken in (3, 5, 9):
        columns = 31
        size = (broken + 1) * finiteWidth(broken + 1, 2 * columns) ** 2
        sizes.append(size), squares.append(tipForces(columns, 30, broken)[1] ** 2)
    slopes = np.diff(squares) / np.diff(sizes)
    assert slopes[0] == pytest.approx(slopes[1], rel=0.05)
    assert 0.7 < slopes[1] <= 1.0  # alpha from 1 to 1.4: of the order of 1, as for all packings that were looked at


def test_finiteWidth():
    # sec(pi/4) = sqrt 2
    assert finiteWidth(1e-9, 1.0) == pytest.approx(1) and finiteWidth(1.0, 4.0) == pytest.approx(2**0.125)


def test_fitRecoversWhatItWasMadeFrom():
    alpha, c, r, width = 1.2, 0.7, 1e-3, 0.05
    tests = []
    for a in (3e-3, 5e-3, 8e-3, 1.2e-2):
        p = 1 / (math.sqrt(a * finiteWidth(a, width) ** 2 / (alpha * r)) - c)
        tests.append({"halfLength": a, "radius": r, "width": width, "pressure": STRESS + p * STRENGTH})
    found = toughness.fit(tests, STRESS, STRENGTH)
    assert (
        found["alpha"] == pytest.approx(alpha)
        and found["c"] == pytest.approx(c)
        and found["scatter"] == pytest.approx(0, abs=1e-9)
    )
    assert found["toughness"] == pytest.approx(STRENGTH * math.sqrt(math.pi * alpha * r))
    assert found["exponent"] < -0.5  # short cracks are stronger than LEFM has it
    lefm = [
        {
            **t,
            "pressure": STRESS
            + STRENGTH * math.sqrt(2 * r / (t["halfLength"] * finiteWidth(t["halfLength"], width) ** 2)),
        }
        for t in tests
    ]
    found = toughness.fit(lefm, STRESS, STRENGTH)
    assert (
        found["exponent"] == pytest.approx(-0.5)
        and found["alphaLEFM"] == pytest.approx(2)
        and found["c"] == pytest.approx(0, abs=1e-9)
    )


def test_crackedContactsAreThoseThatTheSegmentCuts():
    sample = grains()
    disks, box = squareLattice(6, 6, 1e-3)
    sediment.buildScene(sample, *np.array(disks).T, box)
    sediment.compress(sample, STRESS, STRESS)
    walls = sediment.wallBodies()
    centre = (
        0.5 * (walls["left"].state.pos[0] + walls["right"].state.pos[0]),
        0.5 * (walls["bottom"].state.pos[1] + walls["top"].state.pos[1]),
    )
    pairs = toughness.crackedContacts(centre, 2.1e-3)  # reaches the columns 1 mm beside the middle, not those 3 mm off
    assert len(pairs) == 2
    for a, b in pairs:
        one, other = O.bodies[a].state.pos, O.bodies[b].state.pos
        assert abs(one[0] - other[0]) < 1e-4 and (one[1] - centre[1]) * (other[1] - centre[1]) < 0
    # The crack runs through contacts; the pores that it opens lie beside them.
    assert not sediment.anyInTheVoid([(O.bodies[a].state.pos[0], centre[1]) for a, _ in pairs])
    beside = toughness.besideContacts(pairs)
    assert len(beside) == 4 and all(sediment.anyInTheVoid([point]) for point in beside)


@pytest.mark.parametrize(
    "values, message",
    [
        ({"halfLengths": (3.0,)}, "at least two of each"),
        ({"brokenContacts": (3, 3)}, "at least two of each"),
        ({"stress": 50e3}, "stress = 50000.0 Pa, allowed: 0 < stress <= 0.2 bondStrength = 20000 Pa"),
    ],
)
def test_badInputIsRefused(values, message):
    with pytest.raises(CaseError, match=message):
        toughness.toughness(grains(), **values)
    with pytest.raises(CaseError, match="columns = 8, rows = 8, broken = 3; allowed"):
        tipForces(8, 8, 3)
