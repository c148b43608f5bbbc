// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/Displacement with fluids that have weight: rest, the height of gas columns, amounts.

#include "TwoFluidNetworks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace capfrac {

using namespace samples;

namespace {

	/// rho g of both fluids, upwards: heads fall with height.
	constexpr double heavy = 0.10, light = 0.02;

	FluidHeads headsAt(double height) { return { -heavy * height, -light * height }; }

	/// A gas reservoir of capillary pressure `pressure` at height zero, and pores of water at rest at the heights
	/// `spacing`, 2 `spacing` and so on (below it for a negative one), the last held there. Throats lie half way;
	/// `entry(height)` is their entry pressure.
	template <class Entry> TwoFluidNetwork column(int n, double spacing, double pressure, Entry entry)
	{
		TwoFluidNetwork network;
		network.fluids = stiffFluids(1, 1e-3);
		network.fluids.waterBulkModulus = network.fluids.datum = 1e5; // for the long steps of these tests
		network.pores.push_back(gasPore(network.fluids, 1, pressure));
		network.pores[0].fixedPressure = pressure;
		for (int i = 1; i <= n; ++i) {
			const double place = (i - 0.5) * spacing;
			network.pores.push_back(waterPore(network.fluids, 1, headsAt(i * spacing).water));
			network.pores.back().head = headsAt(i * spacing);
			network.throats.push_back({ i - 1, i, 1, entry(place), false, headsAt(place) });
		}
		network.pores.back().fixedPressure = network.pores.back().head.water;
		return network;
	}

	int filled(TwoFluidNetwork& network, double time)
	{
		PressureSolver solver;
		for (int k = 0; k < 50; ++k)
			expectKept(displace(network, nullptr, time / 50, solver));
		int count = 0;
		for (std::size_t i = 1; i < network.pores.size(); ++i)
			count += network.pores[i].isGas;
		return count;
	}

} // namespace

TEST(DisplacementWeight, FluidsAtRestStayAtRest)
{
	// A closed column of 20 pores of water, with throats that make loops, and one of gas beside it: neither can
	// pass.
	Random random(6);
	TwoFluidNetwork network;
	network.fluids.waterBulkModulus = 100, network.fluids.datum = 5, network.fluids.gasViscosity = 0.1;
	for (int i = 0; i < 40; ++i) {
		const auto head = headsAt(random.uniform(0, 10));
		network.pores.push_back(i < 20 ? waterPore(network.fluids, random.uniform(0.1, 2), 0.5 + head.water)
		                               : gasPore(network.fluids, random.uniform(0.1, 2), 0.7 + head.gas));
		network.pores.back().head = head;
		for (int other : { random.below(i + 1), i - 1 })
			if (other >= 0 && other != i)
				network.throats.push_back({ other, i, 1, 10, false, headsAt(random.uniform(0, 10)) });
	}
	const auto before = network.pores;
	PressureSolver solver;
	for (int k = 0; k < 100; ++k)
		expectKept(displace(network, nullptr, 1, solver));
	// Each step may be off by what pressures of order one know of amounts: 16 roundings of the volumes at a bulk
	// modulus of 100, 4e-13, in the water; that does not add up, because the next step makes up for it. Amounts as
	// the pressures, over a hundred.
	for (std::size_t i = 0; i < before.size(); ++i) {
		EXPECT_NEAR(network.pores[i].pressure, before[i].pressure, 1e-12);
		EXPECT_NEAR(network.pores[i].water + network.pores[i].gas, before[i].water + before[i].gas, 1e-13);
	}
}

TEST(DisplacementWeight, GasRisesAndSinksToWhereItsColumnReachesTheEntryPressure)
{
	// Capillary pressure over the reservoir: P + (heavy - light) z. Up: against entry pressures that grow faster, 1
	// + 0.2 z. Down: against equal ones.
	constexpr int throat = 7; // of 12, 6.5 away from the reservoir
	for (const double way : { 1.0, -1.0 })
		for (const double excess : { -1e-4, 1e-4 }) {
			const double slope = way > 0 ? 0.2 : 0,
			             threshold = 1 + (slope - (heavy - light)) * way * (throat - 0.5);
			// At the threshold the gas is driven by the excess alone, against up to six throats of water:
			// 6/1e-4 for the pore.
			auto network =
			        column(12, way, threshold + excess, [&](double height) { return 1 + slope * height; });
			EXPECT_EQ(filled(network, 1e6), excess > 0 ? throat : throat - 1);
			for (const auto& pore : network.pores) // to 1e-7 of the largest pressure, about two
				EXPECT_NEAR(pore.pressure,
				        pore.isGas ? threshold + excess + pore.head.gas : pore.head.water, 1e-6);
		}
}

TEST(DisplacementWeight, AColumnOfGasBreaksItsSealAtTheCriticalHeight)
{
	// The seal, of entry pressure 1, holds the gas in the five pores below it, of entry pressure 0.3, up to the
	// height (1 - P)/(heavy - light).
	constexpr double pressure = 0.5, critical = (1 - pressure) / (heavy - light);
	for (const double excess : { -1e-4, 1e-4 }) {
		const double spacing = critical * (1 + excess) / 5.5;
		auto network =
		        column(8, spacing, pressure, [&](double height) { return height > 5.4 * spacing ? 1.0 : 0.3; });
		network.throats[6].entryPressure = 2; // only the pore behind the seal
		EXPECT_EQ(filled(network, 1e6), excess > 0 ? 6 : 5);
	}
}

TEST(DisplacementWeight, GasThatCannotStandInTheBodyOfAPoreStaysOut)
{
	// The body lies so far below the throat, 20, that the capillary pressure falls by 1.6 on the way: what exceeds
	// the entry pressure of one in the throat is no capillary pressure at all in the body, until the gas has 1.6 at
	// the throat.
	for (const double pressure : { 1.1, 1.59, 1.61 }) {
		auto network = column(2, -1, pressure, [](double) { return 1.0; });
		network.throats[0].head = {};
		network.pores[1].head = headsAt(-20);
		network.pores[1].pressure = network.pores[1].head.water;
		network.pores[1].water = 1 + network.pores[1].pressure / network.fluids.waterBulkModulus;
		network.throats[1].entryPressure = 9;
		EXPECT_EQ(filled(network, 1e6), pressure > 1.6 ? 1 : 0);
	}
}

TEST(DisplacementWeight, LockedWaterAtRestDoesNotDrain)
{
	// Films hang at rest as the water does: what is cut off under the pressure at rest stays, what has more loses
	// all above it.
	for (const double more : { 0.0, 0.1 }) {
		TwoFluidNetwork network;
		network.fluids.waterBulkModulus = 100, network.filmConductance = 1;
		network.pores = { waterPore(network.fluids, 1, -0.3 + more) };
		network.pores[0].head = headsAt(3);
		PressureSolver solver;
		for (int k = 0; k < 100; ++k)
			expectKept(displace(network, nullptr, 1, solver));
		EXPECT_NEAR(network.pores[0].pressure, -0.3, 1e-7);
	}
}

TEST(DisplacementWeight, AmountsAreKept)
{
	Random random(7);
	auto network = disorderedTwoFluids(random);
	for (auto& pore : network.pores)
		pore.head = headsAt(random.uniform(0, 8));
	for (auto& throat : network.throats) {
		const auto &a = network.pores[throat.a].head, &b = network.pores[throat.b].head;
		throat.head = { 0.5 * (a.water + b.water), 0.5 * (a.gas + b.gas) };
	}
	PressureSolver solver;
	int entered = 0;
	for (int k = 0; k < 200; ++k) {
		const double before = held(network);
		const auto step = displace(network, nullptr, 0.5, solver);
		expectKept(step);
		EXPECT_NEAR(held(network) - before, step.water.stored + step.gas.stored,
		        1e-10); // sums of 300 amounts of about one
		entered += static_cast<int>(step.entries.size());
	}
	EXPECT_GT(entered, 30);
}

TEST(DisplacementWeight, HeadsThatAreNoNumbersAreRefused)
{
	auto network = column(2, 1, 0.5, [](double) { return 1.0; });
	PressureSolver solver;
	network.pores[1].head.gas = NAN;
	EXPECT_NE(messageOf([&] {
		displace(network, nullptr, 1, solver);
	}).find("pore 1: head [Pa] = nan, allowed: a finite number"),
	        std::string::npos);
	network.pores[1].head.gas = 0;
	network.throats[1].head.water = INFINITY;
	EXPECT_NE(messageOf([&] { displace(network, nullptr, 1, solver); }).find("throat 1: head [Pa] = inf"),
	        std::string::npos);
}

} // namespace capfrac
