// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/Displacement between grains that give way and grains that the fluids compress (Eq. 10).

#include "TwoFluidNetworks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace capfrac {

using namespace samples;

namespace {

	/// A grain between the first two pores, wetted over 0.3 and 0.5 m^2, that gives way by `compliance`.
	Skeleton softGrain(double compliance, double lag = 0)
	{
		Skeleton skeleton;
		skeleton.compression = { { { 0, 0, 0.3 }, { 1, 0, 0.5 } }, { compliance }, { lag } };
		return skeleton;
	}

} // namespace

TEST(DisplacementGrains, GrainsThatGiveWayTakeUpTheGas)
{
	// One pore of gas, fed at a rate, on a piston (area 1, mass 1) held by a spring of stiffness 10, and damped; at
	// rest the force of the gas is that of the spring: p = 10 (V - 1), (p + p_0) V = p_0 m, m = 1 + what was fed.
	TwoFluids fluids;
	fluids.datum = 2;
	TwoFluidNetwork network;
	network.fluids = fluids;
	network.pores = { gasPore(fluids, 1, 0) };
	PressureSolver solver;
	double x = 0, v = 0;
	const double dt = 0.05;
	for (int k = 0; k < 4000; ++k) {
		network.pores[0].volume = 1 + x, network.pores[0].source = k < 1000 ? 0.01 : 0;
		Skeleton skeleton;
		skeleton.gradient = { { 0, 0, 1 } };
		skeleton.velocity = { v }, skeleton.mass = { 1 }, skeleton.force = { -10 * x - v };
		const auto step = displace(network, &skeleton, dt, solver);
		expectKept(step);
		v += dt * (skeleton.force[0] + step.load[0]), x += dt * v;
	}
	const double m = 1 + 0.01 * dt * 1000; // V solves (10 (V - 1) + 2) V = 2 m
	const double exact = (8 + std::sqrt(64 + 80 * m)) / 20;
	EXPECT_NEAR(1 + x, exact, 1e-7);
}

TEST(DisplacementGrains, GasCompressesAGrain)
{
	// Two pores of gas, fed until they have one pressure p again: (p + p_0)(V - a (lag - c p)) = p_0 m, a being all
	// the grain's arcs; a quadratic for p.
	constexpr double compliance = 0.05;
	TwoFluids fluids;
	fluids.datum = 2, fluids.gasViscosity = 1e-3;
	TwoFluidNetwork network;
	network.fluids = fluids;
	network.pores = { gasPore(fluids, 1, 0), gasPore(fluids, 0.5, 0) };
	network.throats = { { 0, 1, 1 } };
	PressureSolver solver;
	double grown = 0, volumes[] = { 1, 0.5 };
	for (int k = 0; k < 60; ++k) {
		network.pores[0].source = k < 50 ? 0.02 : 0;
		const auto skeleton = softGrain(compliance, -grown);
		const auto step = displace(network, &skeleton, 1, solver);
		expectKept(step);
		grown += step.growth[0];
		for (int i : { 0, 1 })
			network.pores[i].volume = volumes[i] - skeleton.compression.arcs[i].area * grown;
	}
	const double stiffness = 0.8 * compliance, m = 1.5 + 1; // (p + 2)(1.5 + stiffness p) = 2 m
	const double b = 1.5 + 2 * stiffness,
	             exact = (-b + std::sqrt(b * b + 4 * stiffness * 2 * (m - 1.5))) / (2 * stiffness);
	for (const auto& pore : network.pores)
		EXPECT_NEAR(pore.pressure, exact, 1e-6); // to 1e-7 of it, and the same again in what the last step left
	EXPECT_NEAR(grown, -compliance * exact, compliance * 1e-6);
}

TEST(DisplacementGrains, AGrainGrowsByWhatItLacksHoweverTheStepIsDivided)
{
	// Gas that enters from a reservoir fills the first pore in parts of the step; in the end the radius is that of
	// the last pressures, and what the pores hold fills the volumes that this leaves, to 1e-7 of the pressures over
	// the storage, and to the first order in what a volume changes within a part.
	constexpr double compliance = 1e-3, lag = 2e-3;
	TwoFluidNetwork network;
	network.fluids.waterBulkModulus = 100, network.fluids.datum = 5, network.fluids.waterViscosity = 0.1,
	network.fluids.gasViscosity = 0.01;
	network.pores = { waterPore(network.fluids, 1), waterPore(network.fluids, 1), gasPore(network.fluids, 1, 2) };
	network.throats = { { 0, 1, 1, 5 }, { 2, 0, 1, 1 } };
	network.pores[1].fixedPressure = 0, network.pores[2].fixedPressure = 2;
	const auto skeleton = softGrain(compliance, lag);
	PressureSolver solver;
	const auto step = displace(network, &skeleton, 1, solver, { 0.1 });
	expectKept(step);
	ASSERT_GT(step.parts, 5);
	ASSERT_TRUE(network.pores[0].isGas);
	const double mean = (0.3 * network.pores[0].pressure + 0.5 * network.pores[1].pressure) / 0.8;
	EXPECT_NEAR(step.growth[0], lag - compliance * mean, 1e-15);
	for (int i : { 0, 1 }) {
		const auto& pore = network.pores[i];
		const double holds = waterVolume(network.fluids, pore.water, pore.pressure)
		        + gasVolume(network.fluids, pore.gas, pore.pressure + pore.held);
		EXPECT_NEAR(holds, 1 - skeleton.compression.arcs[i].area * step.growth[0], 1e-7);
	}
}

TEST(DisplacementGrains, WithoutGasItIsTheFlowOfOneFluid)
{
	// coupledStep() takes V p/K_f for what the water stores, here it is m p/K_f^2 more: with pressures of about one
	// and K_f = 1e6, 1e-6 of the pressures.
	constexpr double bulkModulus = 1e6;
	FlowNetwork one;
	TwoFluidNetwork two;
	two.fluids.waterBulkModulus = one.bulkModulus = bulkModulus, two.fluids.waterViscosity = 1;
	for (const double pressure : { 1.0, -0.5, 0.2 }) {
		one.pores.push_back(pore(2, pressure, bulkModulus));
		two.pores.push_back(waterPore(two.fluids, 2, pressure));
	}
	for (int i : { 0, 1 })
		one.throats.push_back({ i, i + 1, 1e-6 }), two.throats.push_back({ i, i + 1, 1e-6 });
	const auto skeleton = softGrain(3e-6, 1e-6);
	PressureSolver solver, other;
	const auto expected = coupledStep(one, skeleton, 1, solver);
	const auto step = displace(two, &skeleton, 1, other);
	EXPECT_NEAR(step.growth[0], expected.growth[0], 1e-6 * 3e-6);
	for (int i : { 0, 1, 2 })
		EXPECT_NEAR(two.pores[i].pressure, expected.pressure[i], 1e-6);
}

} // namespace capfrac
