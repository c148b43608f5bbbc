# SPDX-License-Identifier: GPL-2.0-or-later
"""SinglePhaseFlowEngine among grains set by hand against closed forms; the conductances are written out here once more.
"""

import math

import numpy as np
import pytest
from yade import O

from capfrac.errors import CaseError
from capfrac.lab import fluid
from capfrac.scene.sediment import Sediment
from capfrac.verification import closedforms, handmade, lattices, units

MU, KF, DP = 1e-3, 1e7, 1e3
NAN = float("nan")


def eq9(gap, r):
    """Eq. 9 with the shape factor 0.026: (C~/mu) A^2/(2r)."""
    c = 1 + gap / (2 * r)
    area = r * r * (4 * c - math.pi)
    if gap < 0:
        area += r * r * 2 * (math.acos(c) - c * math.sin(math.acos(c)))
    return 0.026 / MU * area**2 / (2 * r)


@pytest.fixture(scope="module")
def found():
    """All checks once, on a small sample in three systems of units."""
    O.reset()
    systems = (units.SYSTEMS[0], units.SYSTEMS[2], units.SYSTEMS[4])
    return {
        "twoPores": closedforms.twoPores(),
        "network": closedforms.network(),
        "lattices": lattices.permeabilities(),
        "pulse": lattices.pulse(),
        "units": units.checkUnits(Sediment(grainCount=30, rMin=1e-3, seed=1), systems=systems),
    }


def beside(distance, radii):
    """Distance from a wall of the centroid of the void up to a column of grains, by counting points."""
    area = moment = 0.0
    for r in radii:  # slices across the column: from the wall to the surface of the grain
        y = (np.arange(200_000) + 0.5) / 200_000 * 2 * r
        free = distance - np.sqrt(r**2 - (y - r) ** 2)
        area, moment = area + free.mean() * 2 * r, moment + 0.5 * (free**2).mean() * 2 * r
    return moment / area


# --- two pores, series and parallel --------------------------------------------------------------


def test_twoPoresDecayAtTheRateOfTheirThroats(found):
    pores = found["twoPores"]
    # Grains of 1, 1.5 and 1 mm: two contacts of mean radius 1.25 mm, half a throat of 1 mm at floor and roof. Centroids
    # of the voids: a rectangle less half-disks.
    conductance = (2 * eq9(0, 1.25e-3) + eq9(0, 1e-3)) / (
        12e-3 - beside(3.6e-3, (1e-3, 1.5e-3, 1e-3)) - beside(8.4e-3, (1e-3, 1.5e-3, 1e-3))
    )
    solid = 0.5 * math.pi * (1 + 1.5**2 + 1) * 1e-6
    volumes = [3.6e-3 * 7e-3 - solid, 8.4e-3 * 7e-3 - solid]
    assert pores["volumes"] == pytest.approx(volumes, rel=1e-13) and pores["volumeError"] < 1e-13
    # 2e5 slices, (1/n)^1.5 at the poles
    assert pores["rate"] == pytest.approx(conductance * KF * (1 / volumes[0] + 1 / volumes[1]), rel=1e-7)
    for scheme in ("implicit", "explicit"):
        # A pressure is K_f (m/V - 1): some K_f 2^-53 of round-off against 1 kPa in each of 160 steps, 1e-12 each;
        # random, but bounded by the sum.
        assert pores[scheme]["roundOff"] < 160 * 2 * KF / DP * 2**-53 * 4
        assert pores[scheme]["mass"] < 160 * 2**-52


@pytest.mark.parametrize("scheme, sign", [("implicit", 1), ("explicit", -1)])
def test_bothSchemesAreOfFirstOrderInTime(found, scheme, sign):
    pores = found["twoPores"]
    # (1 +- z)^(-+1/z) = (1 +- z/2 - (5/24) z^2 ...)/e with z = rate dt: what follows is 0.42 z of the first term.
    for steps, error in zip(pores["steps"], pores[scheme]["errors"]):
        assert error == pytest.approx(0.5 / math.e / steps, rel=1 / steps)
    # An order from errors z/2 (1 -+ b z), b < 1, at z and z/2 is off by b z/(2 ln 2).
    assert pores[scheme]["orders"][-1] == pytest.approx(1, abs=1 / 80 / (2 * math.log(2)))
    assert all(sign * (order - 1) < 0 for order in pores[scheme]["orders"])


def test_throatsInSeriesAndInParallelAreExact(found):
    # Some ten sums and a solver to 1e-12, which is exact for four unknowns.
    assert max(found["network"]["errors"].values()) < 1e-12
    # By hand: three grains of 2 mm in each of four columns, the outer ones 4 mm from the walls, 32 mm apart.
    flow = found["network"]["series"][0]["flow"]
    assert flow == pytest.approx(3 * eq9(0, 2e-3) * DP / (32e-3 - 2 * beside(4e-3, (2e-3, 2e-3, 2e-3))), rel=1e-7)
    radii = [1e-3 * s for s in found["network"]["parallel"][2]["radii"]]
    flow = found["network"]["parallel"][2]["flow"]
    assert flow == pytest.approx(
        (2 * eq9(0, 1.5e-3) + eq9(0, 1e-3)) * DP / (16e-3 - beside(6.4e-3, radii) - beside(9.6e-3, radii)), rel=1e-7
    )


def test_randomPackAgainstADenseSolution(loadSample):
    loadSample()
    engine = fluid.alone(
        conductanceLaw="constantShape", bulkModulus=math.inf, viscosity=MU, wallPressures=[NAN, NAN, 0.0, DP]
    )
    O.step()
    cells, throats = engine.cells(), engine.throats()
    domain, void, pressure = (np.array(cells[name]) for name in ("domain", "void", "pressure"))
    pores, count = engine.pores(), domain.max() + 1
    assert len(pores["x"]) == count  # no pore is so small that it is joined to another: pores are domains
    np.testing.assert_allclose(pores["volume"], np.bincount(domain, void), rtol=1e-12)
    centre = np.transpose([pores["x"], pores["y"]])
    expected = np.array([pressure[domain == p][0] for p in range(count)])
    matrix = np.zeros((count, count))
    for (a, b), gap, (left, right) in zip(throats["ids"], throats["gap"], throats["cells"]):
        if min(left, right) < 0 or domain[left] == domain[right]:
            continue
        radii = [O.bodies[i].shape.radius for i in (a, b) if hasattr(O.bodies[i].shape, "radius")]
        wall = len(radii) == 1
        p, q = domain[left], domain[right]
        g = (0.5 if wall else 1) * eq9((2 if wall else 1) * gap, np.mean(radii)) / math.hypot(*(centre[p] - centre[q]))
        matrix[[p, q], [p, q]] += g
        matrix[[p, q], [q, p]] -= g
    fixed = (expected == 0) | (expected == DP)
    solved = np.linalg.solve(matrix[np.ix_(~fixed, ~fixed)], -matrix[np.ix_(~fixed, fixed)] @ expected[fixed])
    # The engine's solver: 1e-12 of the right-hand side, times the condition of some fifty pores.
    np.testing.assert_allclose(expected[~fixed], solved, rtol=0, atol=1e-9 * DP)
    solution = expected.copy()
    solution[~fixed] = solved
    assert engine.inflow()["top"] == pytest.approx(float((matrix @ solution)[expected == DP].sum()), rel=1e-9)


# --- lattices ------------------------------------------------------------------------------------


def test_lattices(found):
    result = found["lattices"]
    for gap, expected in zip(result["gaps"], result["expected"]):
        # k = mu G/w with G = C/a on squares; mu G/(sqrt(3) w) with G = C sqrt(3)/a on triangles. Spacing a, w = 1.
        a = 2e-3 * (1 + gap)
        assert expected == pytest.approx(MU * eq9(2e-3 * gap, 1e-3) / a / 1e-6, rel=1e-13)
    assert result["errors"]["square"] < 1e-12
    # Along the rows: what the ends disturb is e^-13 of a few per cent, squared in the flow; the solver's 1e-12 over a
    # gradient.
    assert result["errors"]["triangular"] < 1e-11
    # Across: the layers along the walls reach e^-(2 pi/sqrt(3)) per spacing into the sample, e^-11 at half of the six
    # columns of the narrower one.
    assert result["errors"]["across"] < math.exp(-11)


@pytest.mark.parametrize("lattice, walls", [("square", [NAN, NAN, DP, 0.0]), ("triangular", [DP, 0.0, NAN, NAN])])
def test_spacingCancels(lattice, walls):
    # As k = mu G/w has no length of its own, samples of grains of 1 mm and 1 m have k/r^2 alike; of the whole sample,
    # ends included.
    found = []
    for radius in (1e-3, 1.0):
        disks, box = (
            handmade.squareLattice(3, 5, radius) if lattice == "square" else handmade.triangularLattice(6, 4, radius)
        )
        engine = fluid.fill(disks, box, bulkModulus=math.inf, viscosity=MU, wallPressures=walls)
        fluid.advance(1.0)
        found.append(max(engine.inflow().values()) / radius**2)
    assert found[1] == pytest.approx(found[0], rel=1e-12)


def test_fourSpheresAtContactHaveTheFrictionFactorOfTheirDuct():
    # Four touching circles: f Re = 6.606 (Fanning), so C~ = 8 A/(P^2 f Re) with P = 2 pi r. The engine's fit is good to
    # 0.4 %.
    disks, box = handmade.squareLattice(3, 4, 1e-3)
    engine = fluid.fill(
        disks, box, conductanceLaw="fourSpheres", bulkModulus=math.inf, viscosity=MU, wallPressures=[NAN, NAN, DP, 0.0]
    )
    fluid.advance(1.0)
    k = MU * engine.inflow()["bottom"] * (box[3] - 2 * beside(1e-3, [1e-3])) / (box[1] * DP)
    shape = 8 * (4 - math.pi) / ((2 * math.pi) ** 2 * 6.606)
    assert k / 1e-6 == pytest.approx(shape * (4 - math.pi) ** 2 / 4, rel=4e-3)


def test_pressureSpreadsAsTheErrorFunctionOfSecondOrderInTheSpacing(found):
    pulse = found["pulse"]
    for run, spacing in zip(pulse["runs"], pulse["spacings"]):
        assert run["porosity"] == pytest.approx(1 - math.pi / 4, rel=1e-12)
        # The error is a^2 times a function derived in lattices.pulseError. What is left of it is of order a^3: less
        # than a of it.
        assert run["misfit"] < spacing
        assert run["error"] == pytest.approx(run["predicted"], rel=spacing)
    # An order from errors a^2 (1 + c a), |c| < 1, at a and a/2 is off by less than c a/(2 ln 2).
    for order, spacing in zip(pulse["orders"], pulse["spacings"]):
        assert order == pytest.approx(2, abs=spacing / (2 * math.log(2)))


# --- units ---------------------------------------------------------------------------------------


def test_otherUnitsGiveTheSameCurves(found):
    binary, metric, imperial = (units.SYSTEMS[n].name for n in (0, 2, 4))
    for problem in units.PROBLEMS:
        # Powers of two change exponents alone: every bit of every mantissa is the same, however much grains slide.
        assert found["units"][problem]["differences"][binary] == 0, problem
    for name in (metric, imperial):
        # Round-off of pressures, 2^-53 K_f/p with p = 1e-4 K_f, times some ten for sums and solver (1e-12).
        assert found["units"]["diffusion"]["differences"][name] < 2**-53 * 1e4 * 10 + 1e-10
        # An overlap is a hundredth of a radius and pressures a hundredth of K_f: 1e-14 a step, a thousand steps.
        assert found["units"]["lattice"]["differences"][name] < 1e-9
        # Damped, round-off grows to what the smallest push does. That is no error of the units, and no closed form
        # bounds it; 1e-4 is found.
        for problem in ("damped", "sample"):
            assert found["units"][problem]["differences"][name] < 1e-2


def test_unitsMoveWhatTheyShould(found):
    for problem in ("lattice", "damped", "sample"):
        rows = np.array(found["units"][problem]["curves"]["m, s, kg"])
        pressure, stress = rows.T
        # Sealed and compressed by 1e-3 of the height: water by up to that over a porosity of 0.1 to 0.2. Without
        # damping there are waves.
        assert 1e-3 < pressure[-1] - pressure[0] < 2e-2 and stress[-1] > stress[0]
        assert problem == "lattice" or np.all(np.diff(pressure) > 0)


# --- what is refused, the table -------------------------------------------------------------------


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: closedforms.twoPores(radius=0.0), "radius = 0.0, allowed: a finite number > 0"),
        (lambda: closedforms.network(viscosity=-1.0), "viscosity = -1.0, allowed: a finite number > 0"),
        (lambda: closedforms.checkClosedForms(bulkModulus=math.inf), "bulkModulus = inf, allowed: a finite number > 0"),
        (
            lambda: lattices.permeabilities(gaps=(0.0, -0.3)),
            "gaps = [0.0, -0.3], allowed: > -0.29 and <= 1 of the diameter",
        ),
        (lambda: lattices.pulse(spacings=(0.7,)), "spacings = [0.7], allowed: > 0 and <= 0.5 of the length"),
        (lambda: handmade.squareLattice(2, 2, 1e-3, -2e-3), "gap = -0.002 m, allowed: > -2 radius = -0.002"),
        (lambda: handmade.triangularLattice(1, 2, 1e-3), "columns = 1, allowed: a whole number >= 2"),
        (
            lambda: units.checkUnits(systems=(units.Units("none", time=0.0),)),
            "none: time = 0.0, allowed: a finite number > 0",
        ),
    ],
)
def test_impossibleValuesAreRefused(call, message):
    with pytest.raises(CaseError) as problem:
        call()
    assert message in str(problem.value)


def test_tableHasEveryNumber(found):
    table = closedforms.table(found)
    rows = list(zip(*table.values()))
    assert list(table) == ["check", "measure", "value [-]"]
    assert ("lattices", "square", found["lattices"]["errors"]["square"]) in rows and (
        "pulse",
        "orders 3",
        found["pulse"]["orders"][2],
    ) in rows
    assert {row[0] for row in rows} == {"twoPores", "network", "lattices", "pulse", "units"}
