# SPDX-License-Identifier: GPL-2.0-or-later
"""SinglePhaseFlowEngine against closed forms and conservation laws, on settled grains that stand still or move."""

import math

import numpy as np
import pytest
from yade import O
from yade.wrapper import SinglePhaseFlowEngine

from capfrac import sediment
from capfrac.errors import CaseError
from capfrac.lab import diffusion as laboratory, profiles
from capfrac.lab.box import Box

NAN = float("nan")
TOP_TO_BOTTOM = [NAN, NAN, 0.0, 1000.0]


def alone(**attributes):
    """The engine as the only one: grains stand still."""
    engine = SinglePhaseFlowEngine(**attributes)
    O.engines = [engine]
    return engine


def among(**attributes):
    """The engine between contacts and integrator: grains move."""
    return sediment.insertFluid(SinglePhaseFlowEngine(label="flow", **attributes))


def permeability(engine):
    O.step()
    width, height = sediment.boxSize()
    return engine.viscosity * engine.inflow()["top"] * height / (width * 1000.0)


@pytest.mark.parametrize("law", ["fourSpheres", "constantShape", "inscribedCircle"])
def test_permeabilityGoesWithTheSquareOfTheRadius(handScene, looseDisks, law):
    found = []
    for scale in (1.0, 10.0):
        disks, box = looseDisks(count=25, seed=3, radius=1e-3)
        handScene([(scale * x, scale * y, scale * r) for x, y, r in disks], tuple(scale * b for b in box))
        found.append(
            permeability(
                alone(bulkModulus=math.inf, conductanceLaw=law, poreMode="triangle", wallPressures=TOP_TO_BOTTOM)
            )
        )
    # The same packing ten times as large: every length rounds differently, sums of some hundred terms, a solver to
    # 1e-12.
    assert found[1] / found[0] == pytest.approx(100, rel=1e-10)


def test_permeabilityOfASettledPackIsThatOfTheFourSphereThroats(loadSample):
    loadSample()
    k = permeability(alone(bulkModulus=math.inf, wallPressures=TOP_TO_BOTTOM))
    # Independent random packs of radii 1 to 5/3: 9.05e-3 r_min^2, and k goes with the square of the size; radii 1 to 2
    # here, mean square 7/3 against 1.81 r_min^2. 60 grains of one seed are within a third.
    assert k == pytest.approx(9.05e-3 * (7 / 3) / 1.81 * 1e-6, rel=0.35)
    half = permeability(alone(bulkModulus=math.inf, wallPressures=TOP_TO_BOTTOM, conductanceFactor=0.5))
    assert half == pytest.approx(0.5 * k, rel=1e-10)


def test_inflowIsOutflowInSteadyState(loadSample):
    loadSample()
    engine = alone(bulkModulus=math.inf, wallPressures=TOP_TO_BOTTOM)
    O.step()
    inflow = engine.inflow()
    # the solver's 1e-12
    assert inflow["top"] > 0 and inflow["top"] + inflow["bottom"] == pytest.approx(0, abs=1e-11 * inflow["top"])
    pressures = engine.pores()["pressure"]
    assert min(pressures) == 0 and max(pressures) == 1000  # maximum principle: no pore outside of its boundaries


def test_prescribedFluxGivesThePressureThatDrivesIt(loadSample):
    loadSample()
    engine = alone(bulkModulus=math.inf, wallPressures=TOP_TO_BOTTOM)
    O.step()
    flux = engine.inflow()["top"]
    engine = alone(bulkModulus=math.inf, wallPressures=[NAN, NAN, 0.0, NAN], wallFluxes=[0, 0, 0, flux])
    O.step()
    assert engine.inflow()["bottom"] == pytest.approx(-flux, rel=1e-11)
    pores = engine.pores()
    # Spread by the length of wall instead of one pressure along it: the mean pressure at the top is about the same.
    assert np.mean(sorted(pores["pressure"])[-4:]) == pytest.approx(1000, rel=0.25)


def test_hydrostaticPressureAndBuoyancy(loadSample):
    loadSample()
    engine = alone(bulkModulus=math.inf, wallPressures=[NAN, NAN, NAN, 0.0], fluidDensity=1000.0, gravity=(0, -9.81))
    O.step()
    pores = engine.pores()
    y, p, volume = (np.array(pores[name]) for name in ("y", "pressure", "volume"))
    at = np.flatnonzero(p == 0)
    # At rest the difference between two pores is rho g dy. The pores along the top have one pressure though their
    # centres differ by part of a grain, and water circulates there: within rho g of a grain's diameter, 4 mm.
    np.testing.assert_allclose(p, 9810 * (np.average(y[at], weights=volume[at]) - y), atol=9810 * 4e-3)
    lower = y < 0.5 * (y.min() + y.max())
    slope = np.polyfit(y[lower], p[lower], 1)[0]
    # far from the top little flows: it circulates over a grain or two there
    assert slope == pytest.approx(-9810, rel=5e-3)
    # Archimedes, with the fluid quite at rest: what the grains displace, less what it does not press on where they rest
    # on the floor: contacts that overlap by 2e-3 r have chords of 0.1 r, some 5 % of the floor.
    engine = alone(bulkModulus=math.inf, pointPressures=[(0.01, 0.01, 0.0)], fluidDensity=1000.0, gravity=(0, -9.81))
    O.step()
    up = sum(force[1] for body, force in engine.fluidForces().items() if body >= 4)
    area = math.pi * sum(body.shape.radius**2 for body in sediment.grainBodies())
    assert up == pytest.approx(9810 * area, rel=0.08)
    assert sum(force[1] for force in engine.fluidForces().values()) == pytest.approx(
        -9810 * sum(engine.pores()["volume"]), rel=1e-9
    )


def test_archimedes(handScene, looseDisks):
    disks, box = looseDisks(count=25, seed=6)
    grains = handScene(disks, box)
    # One pore at a pressure: nothing flows, and the fluid is at rest in all others.
    engine = alone(
        bulkModulus=math.inf,
        pointPressures=[(0.5 * box[1], 0.5 * box[3], 2e3)],
        fluidDensity=1000.0,
        gravity=(3.0, -9.81),
        poreMode="triangle",
    )
    O.step()
    forces = engine.fluidForces()
    for i, (_, _, r) in zip(grains, disks):
        # The solver's 1e-12 of pressures of 2 kPa and of differences of 10 Pa across a grain.
        assert forces[i] == pytest.approx((-3e3 * math.pi * r**2, 9810 * math.pi * r**2), abs=1e-9 * 2e3 * r)
    weight = sum(engine.pores()["volume"]) * 1000.0
    assert np.sum(list(forces.values()), axis=0) == pytest.approx((3.0 * weight, -9.81 * weight), rel=1e-9)
    pores = engine.pores()
    level = np.array(pores["pressure"]) - 3e3 * np.array(pores["x"]) + 9810 * np.array(pores["y"])
    assert np.ptp(level) < 1e-9 * 2e3


def test_explicitAndImplicitAgree(loadSample):
    loadSample()
    fluid = {"bulkModulus": 1e7, "wallPressures": TOP_TO_BOTTOM}
    limit = alone(**fluid).explicitTimeStepLimit()
    found = {}
    for scheme in ("explicit", "implicit"):
        engine = alone(timeIntegration=scheme, **fluid)
        O.dt = 0.5 * limit
        sediment.advance(400)
        found[scheme] = np.array(engine.pores()["pressure"])
        assert engine.volumes()["error"] < 1e-13
    # Both are of first order with opposite errors, each about dt/2 times the second derivative in time; after 400 steps
    # the pressures change by some 1/400 of themselves a step.
    np.testing.assert_allclose(found["explicit"], found["implicit"], atol=1000 / 400)


def test_explicitStepBeyondItsLimitIsRefused(loadSample):
    loadSample()
    engine = alone(timeIntegration="explicit", bulkModulus=1e7, wallPressures=TOP_TO_BOTTOM)
    O.dt = 1.01 * engine.explicitTimeStepLimit()
    before = engine.pores()["pressure"]
    with pytest.raises(
        RuntimeError, match="SinglePhaseFlowEngine at time t = .* s, iteration .*explicit time step .*allowed: <= "
    ):
        O.step()
    assert engine.pores()["pressure"] == before


def test_analyticCurves():
    # The table of Eqs. 20 to 22 evaluated independently, to its printed digits.
    for tau, half, inflow, outflow in (
        (0.0275, 0.0330, 3.402, 0.0008),
        (0.0829, 0.2192, 1.960, 0.1921),
        (0.175, 0.3868, 1.358, 0.6464),
    ):
        assert profiles.pressureProfile(0.5, tau)[0] == pytest.approx(half, abs=5e-5)
        assert profiles.flowRates(tau) == pytest.approx((inflow, outflow), abs=5e-4)
    assert profiles.flowRates(profiles.HALF_TIME)[1] == pytest.approx(0.5, abs=1e-4)


@pytest.fixture(scope="module")
def diffusion():
    """The diffusion test on 150 grains, the explicit scheme on 60."""
    O.reset()
    return laboratory.diffusion(
        sediment.Sediment(grainCount=150, rMin=1e-2, seed=1, aspect=1 / 0.7), steps=150, halvings=2, explicitGrains=60
    )


def test_storageIsThePorosityBetweenThePrescribedPores(diffusion):
    # The flow that is missing on the way, measured step by step, is the sum over the pores whatever the steps. Left out
    # is what is missing after tau = 1.5, where 150 steps are 0.1 long and a decay of 2 exp(-pi^2 1.5) has become 2e-6
    # of a sixth.
    assert diffusion["storage"] == pytest.approx(diffusion["storageOfNetwork"], rel=1e-4)
    # In rigid grains c_v K_f is the porosity, but weighted by p (1 - p), which is 0 at the ends and largest in the
    # middle. Porosity varies by a tenth from layer to layer, and of nine layers with these weights (6 xi (1 - xi)
    # scatters by 0.45) 0.45 0.1/3 is left: three times that.
    assert diffusion["storageTimesBulkModulus"] == pytest.approx(diffusion["porosityBetween"], rel=3 * 0.45 * 0.1 / 3)
    # Along walls there is more void than inside.
    assert diffusion["porosityBetween"] < diffusion["porosity"] and diffusion["ledger"] < 1e-12


def test_pressuresAreThoseOfEq20UpToAGrain(diffusion):
    # A pore has the pressure that Eq. 20 has half a grain off, two at most, at any time, however steep the front is
    # there: pressures vary along a row as much as from one row to the next, and rows are a grain apart.
    assert max(diffusion["placeErrors"]["largest"]) < 2 and max(diffusion["placeErrors"]["rms"]) < 1
    # Of half a grain, in a height of 14, the mean over the twenty pores of a layer leaves 0.5/14/sqrt(20) = 0.008. And
    # a layer conducts as its twenty throats do, which differ by half: 0.5/sqrt(20) = 0.11. A walk of seven such steps,
    # tied at both ends, is off the straight line by 0.11 sqrt(7)/(2 7) = 0.02 half-way. Three times both together,
    # times the slope of Eq. 20, 1 at last and 1/sqrt(pi tau) before.
    for profile, error in zip(diffusion["profiles"], diffusion["layerErrors"]):
        assert error < 3 * math.hypot(0.008, 0.02) * max(1, 1 / math.sqrt(math.pi * profile["tau"]))
    # By its own steady pressure in place of its place a pore is on the curve, where the front is wider than some pores.
    late = [error for profile, error in zip(diffusion["profiles"], diffusion["scatterErrors"]) if profile["tau"] > 0.1]
    assert max(late) < 0.02
    assert diffusion["scatterErrors"][-1] < 1e-3  # the steady state itself, to what is left of the decay


def test_flowsAreThoseOfEqs21And22(diffusion):
    rates = diffusion["rateErrors"]
    for tau, inflow, outflow in zip(rates["tau"], rates["inflow"], rates["outflow"]):
        # The first pores, a fourteenth of H, fill at once and stand for a front at tau = (1/14)^2/4 = 0.001. Later
        # inflow goes like the root of permeability and storage about the top, which are those of some layers there: a
        # fifth in a sample as small as this.
        assert tau < 0.001 or abs(inflow) < 0.2
        assert abs(outflow) < 0.03
    assert inflow == pytest.approx(0, abs=1e-3) and outflow == pytest.approx(0, abs=1e-3)  # at last


def test_implicitSchemeConvergesWithFirstOrder(diffusion):
    convergence = diffusion["convergence"]
    assert convergence["steps"] == [156, 312, 624]
    # Errors h (1 + c h): with 156 steps from 1e-5 to 1.5 a step is 8 % of the time, and so is c h at most.
    assert convergence["orders"] == pytest.approx([1, 1], abs=0.08)
    assert convergence["errors"][0] < 0.08 / 2 * 0.3  # h/2 times t dp/dt, at most 0.3 of Delta p


def test_explicitSchemeOnTheSample(diffusion):
    found = diffusion["schemes"]
    assert found["grains"] == 60 and found["explicitSteps"] > 1000 and found["ledger"] < 1e-11
    late = [n for n, tau in enumerate(found["times"]) if tau > 100 * found["explicitTimeStepOverTc"]]
    assert len(late) >= 3
    for n in late:
        # After a hundred of its steps or more, it errs by half a step over the time, 1/200, times t dp/dt/Delta p, at
        # most 0.3.
        assert found["explicitErrorsAt"][n] < 0.3 / 200
    # What the schemes differ by halves with the steps of the implicit one, down to what the explicit one errs by
    # itself.
    own = max(found["explicitErrorsAt"])
    for difference, error in zip(found["differences"], found["implicitErrors"]):
        assert abs(difference - error) <= own * 1.001
    assert found["orders"] == pytest.approx([1, 1, 1], abs=0.1)


@pytest.mark.parametrize(
    "values, message",
    [
        (dict(steps=10), "steps = 10, allowed: >= 50"),
        (dict(halvings=1), "halvings = 1, allowed: 0, or 2 to 5"),
        (dict(explicitGrains=3), "explicitGrains = 3, allowed: 0, or >= 10"),
        (dict(pressure=0.0), "pressure = 0.0, allowed: a finite number > 0"),
        (dict(bulkModulus=math.inf), "bulkModulus = inf, allowed: a finite number > 0"),
        (dict(timeIntegration="euler"), "timeIntegration = 'euler', allowed: 'implicit', 'explicit'"),
    ],
)
def test_diffusionRefusesImpossibleValues(values, message):
    with pytest.raises(CaseError) as problem:
        laboratory.diffusion(sediment.Sediment(grainCount=20), **values)
    assert message in str(problem.value)


@pytest.mark.parametrize("bulkModulus", [1e7, 2.2e9])
@pytest.mark.parametrize("scheme", ["undrainedStable", "implicit"])
def test_sealedSampleKeepsItsWaterWhileItIsSheared(loadSample, scheme, bulkModulus):
    loadSample()
    engine = among(bulkModulus=bulkModulus, timeIntegration=scheme)
    box = Box(sediment.Sediment(grainCount=60, rMin=1e-3, rMax=2e-3))
    box.setReference()
    box.mode("uniaxial")
    box.record("virgin")
    box.strainTo(0.005, spacing=0.001)
    sediment.advance(200)  # the drive stands still: waves run out
    engine = sediment.engine("flow")
    volumes = engine.volumes()
    assert engine.waterIn == 0 and volumes["water"] == pytest.approx(engine.initialWater, rel=1e-13)
    pressure = np.average(engine.pores()["pressure"], weights=engine.pores()["volume"])
    # Pressure is K (m/V - 1) with the void as it is: the mean over the sample, to what waves make of the mean of
    # products.
    assert pressure == pytest.approx(bulkModulus * (volumes["water"] / volumes["void"] - 1), rel=0.02)
    assert pressure > 1e4


def test_waterIsKeptThroughRemeshing(loadSample):
    loadSample()
    among(bulkModulus=1e6, wallPressures=[NAN, NAN, 0.0, NAN])
    box = Box(sediment.Sediment(grainCount=60, rMin=1e-3, rMax=2e-3))
    box.setReference()
    box.mode("biaxial", stressH=8e3)
    box.record("virgin")
    box.strainTo(0.05, spacing=0.005)
    engine = sediment.engine("flow")
    assert engine.nRemeshes > 0
    # Round-off of some 10^4 steps, each moving a share of the water.
    assert engine.volumes()["error"] < 1e-12 and abs(engine.massDefect) < 1e-12 * engine.initialWater


@pytest.mark.parametrize(
    "attributes, message",
    [
        (dict(bulkModulus=0.0), "bulkModulus [Pa] = 0, allowed: > 0, or infinity"),
        (dict(viscosity=0.0), "viscosity"),
        (dict(conductanceLaw="darcy"), "darcy"),
        (
            dict(timeIntegration="euler"),
            "timeIntegration = 'euler', allowed: 'undrainedStable', 'implicit', 'explicit'",
        ),
        (dict(wallPressures=[0.0, 0.0]), "wallPressures = 2, allowed: four values"),
        (dict(wallPressures=[0.0, NAN, NAN, NAN], wallFluxes=[1.0, 0, 0, 0]), "the left wall is named twice"),
        (dict(fluidDensity=-1.0), "fluidDensity"),
    ],
)
def test_impossibleAttributesAreRefused(attributes, message):
    with pytest.raises(ValueError) as problem:
        SinglePhaseFlowEngine(**attributes)
    assert message in str(problem.value)


def test_incompressibleFluidNeedsAPressure(loadSample):
    loadSample()
    alone(bulkModulus=math.inf, timeIntegration="implicit")
    with pytest.raises(RuntimeError, match="SinglePhaseFlowEngine at time t"):
        O.step()


def test_onePoreWithTwoPressures(loadSample):
    loadSample()
    alone(bulkModulus=1e7, wallPressures=[1.0, NAN, 2.0, NAN])
    with pytest.raises(
        RuntimeError,
        match=(
            "has the pressure 1 Pa from another boundary and 2 Pa from the bottom wall; allowed: one pressure for a"
            " pore"
        ),
    ):
        O.step()
