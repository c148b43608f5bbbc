// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/GrainCompression: Eq. 10, and what it takes from the pressure of the pores.

#include "FlowNetworks.hpp"
#include "flow/Coupling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace capfrac {

namespace {

	using namespace samples;

	/// One grain between two pores that only it joins; it wets 0.3 and 0.5 m^2 and gives way by 2e-9 m/Pa.
	GrainCompression oneGrain(double lag = 0) { return { { { 0, 0, 0.3 }, { 1, 0, 0.5 } }, { 2e-9 }, { lag } }; }

	FlowNetwork twoPores(double bulkModulus, double first, double second)
	{
		FlowNetwork network;
		network.bulkModulus = bulkModulus;
		network.pores = { pore(2, first, bulkModulus), pore(3, second, bulkModulus) };
		return network;
	}

} // namespace

TEST(GrainCompression, ArcsOfThePoresAreThoseOfTheirCells)
{
	Random random(4);
	const auto grains = overlappingSample(random, 6, oblong, 1e-3);
	const auto mesh = triangulate(grains, oblong);
	const auto gradients = volumeGradients(mesh, grains, oblong);
	std::vector<int> poreOfCell;
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		poreOfCell.push_back(c == 5 ? -1 : static_cast<int>(c / 3));
	const auto arcs = wettedArcs(gradients, poreOfCell, 0.4);
	std::vector<double> found(grains.size(), 0), expected(grains.size(), 0);
	for (std::size_t k = 0; k < arcs.size(); ++k) {
		found[arcs[k].grain] += arcs[k].area;
		if (k > 0) {
			EXPECT_LT(std::make_pair(arcs[k - 1].grain, arcs[k - 1].pore),
			        std::make_pair(arcs[k].grain, arcs[k].pore));
		}
	}
	for (const auto& g : gradients.grains)
		if (g.cell != 5) expected[g.grain] -= 0.4 * g.radius;
	for (std::size_t i = 0; i < grains.size(); ++i)
		EXPECT_NEAR(found[i], expected[i], 1e-14) << "grain " << i; // some ten terms of order 0.1
}

TEST(GrainCompression, UnderOnePressureEveryGrainFollowsEquation10)
{
	// r_0 = 0.7 m, K_s = 4e7 Pa, p_0 = 2e4 Pa, and a radius that has not yet answered to anything.
	const double compliance = 0.7 / (3 * 4e7), p = 5e5;
	GrainCompression one { { { 0, 0, 0.3 }, { 2, 0, 0.1 } }, { compliance, 1 }, { compliance * 2e4, 1 } };
	const auto growth = radiusGrowth(one, { p, 0, p });
	EXPECT_NEAR(growth[0], 0.7 * (1 - (p - 2e4) / (3 * 4e7)) - 0.7, 2e-16) << "r_0 (1 - (p - p_0)/(3 K_s)) - r_0";
	EXPECT_EQ(growth[1], 0) << "a grain without arcs stays";
	// The mean is that over the arcs.
	EXPECT_DOUBLE_EQ(radiusGrowth(oneGrain(), { 1e3, 0 })[0], -2e-9 * 0.3 / 0.8 * 1e3);
}

TEST(GrainCompression, SealedPoresShareWhatTheGrainBetweenThemGives)
{
	// V' (1 + p'/K) = m with V' = V + a c (a_0 p_0' + a_1 p_1')/(a_0 + a_1): two equations, linear but for p'^2/K,
	// which the scheme leaves out: relative 1e4/1e7.
	FlowNetwork network = twoPores(1e7, 1e4, 0);
	PressureSolver solver;
	const double c = 2e-9, s = c / 0.8;
	const auto step = implicitStep(network, {}, 0.1, solver, oneGrain());
	const double a00 = 2 / 1e7 + s * 0.09, a01 = s * 0.15, a11 = 3 / 1e7 + s * 0.25, right = 2 * 1e4 / 1e7;
	const double det = a00 * a11 - a01 * a01;
	// The solver's 1e-12, and m - V with m rounded to 1e-16 of 2: 1e-13 of the 2e-3 that counts.
	EXPECT_NEAR(step.pressure[0], right * a11 / det, 1e-8);
	EXPECT_NEAR(step.pressure[1], -right * a01 / det, 1e-8) << "the grain draws back from the other pore, too";
	EXPECT_GT(step.volume[0], 2);
	EXPECT_EQ(network.pores[0].mass, pore(2, 1e4, 1e7).mass) << "nothing flows";
	expectClosed(step.ledger);
	// The next step finds the radius where it has to be: nothing changes but for what was linear.
	const double grown = radiusGrowth(oneGrain(), step.pressure)[0];
	const auto before = step.pressure;
	const auto again = implicitStep(network, step.volume, 0.1, solver, oneGrain(-grown));
	EXPECT_NEAR(again.pressure[0], before[0], 2e-3 * before[0]);
	EXPECT_NEAR(again.volume[0], 2 + 0.3 * -grown, 1e-5 * 0.3 * -grown + 1e-15);
}

TEST(GrainCompression, IsStableHoweverSoftTheGrains)
{
	for (double softness : { 1e-2, 1e2, 1e6 }) {
		FlowNetwork network = twoPores(1e9, 10, 0);
		network.throats = { { 0, 1, 1e-9 } };
		PressureSolver solver;
		auto grain = oneGrain();
		grain.compliance[0] *= softness;
		double most = 0, radius = 0;
		for (int i = 0; i < 200; ++i) {
			grain.lag[0] = -radius;
			const auto step = implicitStep(network, {}, 0.1, solver, grain);
			radius += radiusGrowth(grain, step.pressure)[0];
			network.pores[0].volume = 2 - 0.3 * radius, network.pores[1].volume = 3 - 0.5 * radius;
			most = std::max({ most, std::abs(step.pressure[0]), std::abs(step.pressure[1]) });
		}
		EXPECT_LE(most, 10) << "softness " << softness << ": a maximum principle, nothing is put in";
	}
}

TEST(GrainCompression, ExplicitStepsRefuseGrainsThatWouldDiverge)
{
	FlowNetwork network = twoPores(1e7, 10, 0);
	network.throats = { { 0, 1, 1e-9 } };
	auto grain = oneGrain();
	// K_f c a/V of pore 1: 1e7 * 2e-9 * 0.5/3 = 1/300.
	EXPECT_NEAR(laggedResponse(grain, { 2, 3 }, 1e7), 1.0 / 300, 1e-15);
	EXPECT_EQ(laggedResponse({}, { 2, 3 }, 1e7), 0);
	const double dt = 0.5 * explicitTimeStepLimit(network);
	EXPECT_EQ(messageOf([&] { explicitStep(network, {}, dt, grain); }), "no FlowError");
	grain.compliance[0] *= 600;
	EXPECT_EQ(messageOf([&] { explicitStep(network, {}, dt, grain); }),
	        "share of its change of pressure that a pore loses to grains which the fluid compresses [-] = 2, "
	        "allowed: < 1 in the explicit scheme (stiffer grains, or an implicit "
	        "scheme)");
}

TEST(GrainCompression, SetsThePressureOfASealedIncompressibleFluid)
{
	FlowNetwork network = twoPores(infinite, 0, 0);
	PressureSolver solver;
	network.throats = { { 0, 1, 1 } };
	EXPECT_EQ(
	        messageOf([&] { implicitStep(network, {}, 0.1, solver); }).substr(0, 25), "incompressible flow witho");
	network.pores[0].mass += 1e-6; // more than there is room for
	FlowStep step;
	double radius = 0;
	for (int i = 0; i < 3; ++i) { // the volumes in the network follow the radius
		step = implicitStep(network, {}, 1, solver, oneGrain(-radius));
		radius += radiusGrowth(oneGrain(-radius), step.pressure)[0];
	}
	// The solver's 1e-12 times the condition of the matrix, conductance 1 over compliance 1.6e-9: 6e-4 of 625 Pa at
	// worst.
	EXPECT_NEAR(step.pressure[0], 1e-6 / (2e-9 * 0.8), 0.4) << "the grain gives c p over 0.8 m^2";
	EXPECT_NEAR(step.pressure[1], step.pressure[0], 1e-9 * step.pressure[0]);
}

TEST(GrainCompression, CoupledStepCountsItLikeTheImplicitStep)
{
	FlowNetwork one = twoPores(1e7, 1e4, 2e3), two = one;
	PressureSolver solver;
	Skeleton skeleton;
	skeleton.gradient = { { 0, 0, -0.1 }, { 1, 0, 0.1 } };
	skeleton.velocity = { 0 };
	skeleton.force = { 0 };
	skeleton.mass = { infinite };
	skeleton.compression = oneGrain();
	const auto implicit = implicitStep(one, {}, 0.1, solver, oneGrain());
	const auto coupled = coupledStep(two, skeleton, 0.1, solver);
	for (int i = 0; i < 2; ++i) {
		EXPECT_EQ(coupled.pressure[i], implicit.pressure[i]);
		EXPECT_EQ(coupled.volume[i], implicit.volume[i]);
	}
}

} // namespace capfrac
