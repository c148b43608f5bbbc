// SPDX-License-Identifier: GPL-2.0-or-later
/// network/Contents: one flip, by hand.

#include "CellChecks.hpp"
#include "Samples.hpp"
#include "geometry/VoidGeometry.hpp"

#include <algorithm>

namespace capfrac {

namespace {

	using samples::oblong;

	/// A diamond of four grains about `middle`: its diagonal follows the shorter of the two widths.
	void addDiamond(std::vector<Disk>& grains, Vec2 middle, double halfWidth, double halfHeight)
	{
		for (Vec2 side : { Vec2 { -halfWidth, 0 }, Vec2 { 0, -halfHeight }, Vec2 { halfWidth, 0 },
		             Vec2 { 0, halfHeight } })
			grains.push_back({ middle + side, 0.05 });
	}

	/// Two diamonds, far apart; the first one is flat or tall, and so is the second.
	std::vector<Disk> twoDiamonds(bool tall)
	{
		std::vector<Disk> grains;
		const double width = tall ? 0.25 : 0.26, height = tall ? 0.26 : 0.25;
		addDiamond(grains, { 2.2, -1 }, width, height);
		addDiamond(grains, { 3.7, 1.1 }, width, height);
		return grains;
	}

} // namespace

TEST(CarryOver, OneFlipSharesByVoidAndDecidesByMajority)
{
	const auto flat = twoDiamonds(false), tall = twoDiamonds(true);
	const auto before = triangulate(flat, oblong), after = triangulate(tall, oblong);
	const auto voids = voidAreas(after, tall, oblong);
	// Grains 0 to 3 make one diamond, 4 to 7 the other; a diamond is cut along its shorter diagonal.
	const int oldA = byVertices(before).at({ 0, 1, 3 }), oldB = byVertices(before).at({ 1, 2, 3 });
	const int newA = byVertices(after).at({ 0, 1, 2 }), newB = byVertices(after).at({ 0, 2, 3 });
	const int farA = byVertices(after).at({ 4, 5, 6 }), farB = byVertices(after).at({ 4, 6, 7 });

	struct Case {
		double gasA, waterA, gasB, waterB;
		bool sourceA;
		Phase phase;
		bool source;
	};
	for (const Case& k : { Case { 0.04, 0, 0, 0.03, true, Phase::gas, true },
	             Case { 0.03, 0, 0, 0.04, true, Phase::water, false },
	             Case { 0.03, 0, 0, 0.03, true, Phase::gas, true },
	             Case { 0.04, 0.01, 0, 0.02, false, Phase::gas, false },
	             Case { 0, 0.03, 0, 0.03, false, Phase::water, false } }) {
		auto contents = waterFilled(voidAreas(before, flat, oblong));
		contents.gas[oldA] = k.gasA;
		contents.water[oldA] = k.waterA;
		contents.gas[oldB] = k.gasB;
		contents.water[oldB] = k.waterB;
		contents.phase[oldA] = k.gasA > k.waterA ? Phase::gas : Phase::water;
		contents.source[oldA] = k.sourceA;
		const auto carried = carryOver(before, contents, after, voids);
		EXPECT_EQ(expectUntouched(before, contents, after, carried), 4);
		const double gas = k.gasA + k.gasB, water = k.waterA + k.waterB,
		             share = voids[newA] / (voids[newA] + voids[newB]);
		// Two roundings on either side.
		EXPECT_NEAR(carried.gas[newA], share * gas, 1e-15 * gas);
		EXPECT_NEAR(carried.gas[newB], (1 - share) * gas, 1e-15 * gas);
		EXPECT_NEAR(carried.water[newA], share * water, 1e-15 * water);
		EXPECT_NEAR(carried.water[newB], (1 - share) * water, 1e-15 * water);
		for (int c : { newA, newB }) {
			EXPECT_EQ(carried.phase[c], k.phase);
			EXPECT_EQ(carried.source[c] != 0, k.source);
		}
		for (int c : { farA, farB }) {
			EXPECT_EQ(carried.gas[c], 0) << "the other flip is another part";
			EXPECT_EQ(carried.phase[c], Phase::water);
		}
	}
}

TEST(CarryOver, TheVoidsDecideWhereTheyAreGiven)
{
	// Compressed gas: its amount is ten times its volume, and must not make the whole diamond gas.
	const auto flat = twoDiamonds(false), tall = twoDiamonds(true);
	const auto before = triangulate(flat, oblong), after = triangulate(tall, oblong);
	const int oldA = byVertices(before).at({ 0, 1, 3 }), oldB = byVertices(before).at({ 1, 2, 3 });
	const int newA = byVertices(after).at({ 0, 1, 2 });
	auto contents = waterFilled(voidAreas(before, flat, oblong));
	contents.gas[oldA] = 0.4;
	contents.water[oldA] = 0;
	contents.phase[oldA] = Phase::gas;
	const auto voids = voidAreas(after, tall, oblong);
	for (bool mostlyGas : { false, true }) {
		auto oldVoid = voidAreas(before, flat, oblong);
		oldVoid[oldA] = 0.04, oldVoid[oldB] = mostlyGas ? 0.03 : 0.05;
		EXPECT_EQ(carryOver(before, contents, after, voids, oldVoid).phase[newA],
		        mostlyGas ? Phase::gas : Phase::water);
	}
	EXPECT_EQ(carryOver(before, contents, after, voids).phase[newA], Phase::gas);
}

TEST(CarryOver, ASourceInWaterDoesNotSpread)
{
	const auto flat = twoDiamonds(false), tall = twoDiamonds(true);
	const auto before = triangulate(flat, oblong), after = triangulate(tall, oblong);
	auto contents = waterFilled(voidAreas(before, flat, oblong));
	const int wet = byVertices(before).at({ 0, 1, 3 }), dry = byVertices(before).at({ 1, 2, 3 });
	contents.source[wet] = 1;
	contents.phase[dry] = Phase::gas;
	contents.gas[dry] = 1;
	const auto carried = carryOver(before, contents, after, voidAreas(after, tall, oblong));
	EXPECT_EQ(carried.phase[byVertices(after).at({ 0, 1, 2 })], Phase::gas);
	EXPECT_EQ(std::count(carried.source.begin(), carried.source.end(), 1), 0);
}

TEST(CarryOverEdges, KeepsOldFlagsAndMarksFreshEdges)
{
	const auto before = triangulate(twoDiamonds(false), oblong), after = triangulate(twoDiamonds(true), oblong);
	std::vector<std::uint8_t> flags;
	for (const Edge& e : before.edges)
		flags.push_back(static_cast<std::uint8_t>((e.a + 3 * e.b) % 2));
	const auto carried = carryOverEdges(before, flags, after, 7);
	for (std::size_t e = 0; e < after.edges.size(); ++e) {
		const int a = after.edges[e].a, b = after.edges[e].b;
		const bool fresh = (a == 0 && b == 2) || (a == 4 && b == 6);
		EXPECT_EQ(carried[e], fresh ? 7 : (a + 3 * b) % 2) << a << " " << b;
	}
}

} // namespace capfrac
