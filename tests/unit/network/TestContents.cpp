// SPDX-License-Identifier: GPL-2.0-or-later
/// network/Contents: remeshing keeps every fluid, and touches no cell that did not change.

#include "CellChecks.hpp"
#include "Samples.hpp"
#include "geometry/VoidGeometry.hpp"
#include "network/Contents.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	/// In long double, so that the sum itself adds no error to what is measured.
	long double total(const std::vector<double>& fluid)
	{
		long double sum = 0;
		for (double f : fluid)
			sum += f;
		return sum;
	}

	double relativeChange(const std::vector<double>& before, const std::vector<double>& after)
	{
		return static_cast<double>(fabsl(total(after) - total(before)) / total(before));
	}

	/// Cells full of one phase with a little of the other, some at the inlet.
	Contents randomContents(Random& random, const std::vector<double>& voids)
	{
		Contents contents;
		contents.resize(voids.size());
		for (std::size_t c = 0; c < voids.size(); ++c) {
			const double gasShare = random.chance(0.5) ? random.uniform(0.5, 1) : random.uniform(0, 0.5);
			contents.gas[c] = gasShare * voids[c];
			contents.water[c] = voids[c] - contents.gas[c];
			contents.phase[c] = gasShare > 0.5 ? Phase::gas : Phase::water;
			contents.source[c] = contents.phase[c] == Phase::gas && random.chance(0.3);
			contents.gasMass[c] = (1 + c % 7) * contents.gas[c]; // at pressures of its own
		}
		return contents;
	}

	void expectEqual(const Contents& a, const Contents& b)
	{
		EXPECT_EQ(a.phase, b.phase);
		EXPECT_EQ(a.gas, b.gas);
		EXPECT_EQ(a.water, b.water);
		EXPECT_EQ(a.source, b.source);
		EXPECT_EQ(a.gasMass, b.gasMass);
		EXPECT_EQ(a.held, b.held);
		EXPECT_EQ(a.heldPressure, b.heldPressure);
	}

	/// Stirs the box: a velocity without divergence that does not cross the walls.
	Vec2 stirring(const Box& box, Vec2 at)
	{
		const double x = M_PI * (at.x - box.left) / box.width(), y = M_PI * (at.y - box.bottom) / box.height();
		return { box.width() * std::sin(x) * std::cos(y), -box.height() * std::cos(x) * std::sin(y) };
	}

} // namespace

TEST(WaterFilled, HoldsTheVoids)
{
	const auto contents = waterFilled({ 1, 2, 0.5 });
	EXPECT_EQ(contents.water, (std::vector<double> { 1, 2, 0.5 }));
	EXPECT_EQ(contents.phase, std::vector<Phase>(3, Phase::water));
	EXPECT_EQ(contents.source, std::vector<std::uint8_t>(3, 0));
	EXPECT_EQ(contents.totalGas(), 0);
	EXPECT_EQ(contents.totalWater(), 3.5);
}

TEST(FollowVoids, BooksWhatEnters)
{
	Random random(1);
	const auto grains = samples::looseSample(random, 60, oblong, 2);
	const auto voids = voidAreas(triangulate(grains, oblong), grains, oblong);
	const auto before = randomContents(random, voids);
	auto after = before;
	auto wanted = voids;
	double gasIn = 0, waterIn = 0;
	for (std::size_t c = 0; c < voids.size(); ++c) {
		wanted[c] *= random.uniform(0.9, 1.2);
		(before.phase[c] == Phase::gas ? gasIn : waterIn) += wanted[c] - voids[c];
	}
	const auto entered = followVoids(after, wanted);
	// 61 cells a phase and 122 additions of at most one eps of the box each: 3e-14.
	EXPECT_NEAR(entered[0], gasIn, 3e-14 * oblong.area());
	EXPECT_NEAR(entered[1], waterIn, 3e-14 * oblong.area());
	EXPECT_NEAR(after.totalGas() - before.totalGas(), entered[0], 3e-14 * oblong.area());
	EXPECT_NEAR(after.totalWater() - before.totalWater(), entered[1], 3e-14 * oblong.area());
	for (std::size_t c = 0; c < voids.size(); ++c) {
		EXPECT_NEAR(after.gas[c] + after.water[c], wanted[c], 1e-15 * oblong.area()) << "full again";
		if (before.phase[c] == Phase::gas) {
			EXPECT_EQ(after.water[c], before.water[c]);
		} else {
			EXPECT_EQ(after.gas[c], before.gas[c]);
		}
	}
	EXPECT_EQ(after.phase, before.phase);
	EXPECT_EQ(after.source, before.source);
}

TEST(CarryOver, SameTriangulationChangesNothing)
{
	Random random(2);
	const auto grains = samples::packedSample(random, 80, oblong, 1.67);
	const auto mesh = triangulate(grains, oblong);
	const auto voids = voidAreas(mesh, grains, oblong);
	const auto contents = randomContents(random, voids);
	expectEqual(carryOver(mesh, contents, mesh, voids), contents);
	std::vector<std::uint8_t> flags;
	for (std::size_t e = 0; e < mesh.edges.size(); ++e)
		flags.push_back(static_cast<std::uint8_t>(random.below(2)));
	EXPECT_EQ(carryOverEdges(mesh, flags, mesh, 7), flags);
}

/// 40 remeshings after random displacements. A fluid is multiplied by a share and the shares of a part add
/// up to one to a few eps; 20 eps = 4e-15 covers parts of up to some ten cells, and 40 errors of random
/// sign stay below the 1e-14 asked for over all.
TEST(CarryOver, KeepsGasAndWater)
{
	int nNew = 0;
	for (unsigned seed = 1; seed <= 20; ++seed) {
		Random random(seed);
		auto grains = samples::looseSample(random, 60, oblong, 3);
		auto mesh = triangulate(grains, oblong);
		auto contents = randomContents(random, voidAreas(mesh, grains, oblong));
		Random cutOff(100 + seed); // apart, so that the grains move as they would without
		for (std::size_t c = 0; c < contents.phase.size(); ++c)
			if (contents.phase[c] == Phase::gas && cutOff.chance(0.7))
				contents.held[c] = 1, contents.heldPressure[c] = cutOff.uniform(50, 100);
		const auto first = contents;
		for (int step = 0; step < 40; ++step) {
			for (Disk& g : grains) {
				const Vec2 to =
				        g.centre + Vec2 { random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02) };
				if (to.x > oblong.left && to.x < oblong.right && to.y > oblong.bottom
				        && to.y < oblong.top)
					g.centre = to;
			}
			const auto after = triangulate(grains, oblong);
			const auto carried = carryOver(mesh, contents, after, voidAreas(after, grains, oblong));
			EXPECT_LE(relativeChange(contents.gas, carried.gas), 4e-15);
			EXPECT_LE(relativeChange(contents.water, carried.water), 4e-15);
			EXPECT_LE(relativeChange(contents.gasMass, carried.gasMass), 4e-15);
			nNew += expectUntouched(mesh, contents, after, carried);
			for (std::size_t c = 0; c < after.cells.size(); ++c)
				EXPECT_TRUE(!carried.source[c] || carried.phase[c] == Phase::gas)
				        << "a source of gas in water";
			for (std::size_t c = 0; c < after.cells.size(); ++c)
				if (carried.held[c]) { // a mean of what was there: a few roundings
					EXPECT_EQ(carried.phase[c], Phase::gas);
					EXPECT_TRUE(carried.heldPressure[c] > 50 - 1e-12
					        && carried.heldPressure[c] < 100 + 1e-12);
				} else {
					EXPECT_EQ(carried.heldPressure[c], 0);
				}
			mesh = after;
			contents = carried;
		}
		EXPECT_LE(relativeChange(first.gas, contents.gas), 1e-14) << "seed " << seed;
		EXPECT_LE(relativeChange(first.water, contents.water), 1e-14) << "seed " << seed;
		EXPECT_LE(relativeChange(first.gasMass, contents.gasMass), 1e-14) << "seed " << seed;
	}
	EXPECT_GT(nNew, 1000) << "too few flips to test anything";
}

/// Displacements so large that hardly a cell is left and many share no edge at all with the old mesh. The
/// shares of one part of up to 162 cells add up to one within 162 half eps, 2e-14.
TEST(CarryOver, KeepsGasAndWaterWhenEverythingChanges)
{
	for (unsigned seed = 1; seed <= 20; ++seed) {
		Random random(seed);
		const auto grains = samples::looseSample(random, 80, oblong, 2),
		           others = samples::looseSample(random, 80, oblong, 2);
		const auto before = triangulate(grains, oblong), after = triangulate(others, oblong);
		const auto contents = randomContents(random, voidAreas(before, grains, oblong));
		const auto carried = carryOver(before, contents, after, voidAreas(after, others, oblong));
		EXPECT_LE(relativeChange(contents.gas, carried.gas), 2e-14) << "seed " << seed;
		EXPECT_LE(relativeChange(contents.water, carried.water), 2e-14) << "seed " << seed;
		EXPECT_LE(relativeChange(contents.gasMass, carried.gasMass), 2e-14) << "seed " << seed;
	}
}

/// The life of a sample under large strain, as an engine leads it: cells follow their voids while the mesh
/// holds, contents are carried over when it does not. The books must balance all the time.
TEST(Contents, LongShearKeepsTheBooks)
{
	Random random(4);
	std::vector<Disk> grains = samples::looseSample(random, 80, oblong, 2);
	for (Disk& g : grains)
		g.radius *= 0.5; // room to pass each other, no grain hides another
	auto mesh = triangulate(grains, oblong);
	auto contents = randomContents(random, voidAreas(mesh, grains, oblong));
	double gas = contents.totalGas(), water = contents.totalWater();
	int nFlipped = 0;
	for (int step = 0; step < 1500; ++step) {
		for (Disk& g : grains)
			g.centre += 2e-3 * stirring(oblong, g.centre);
		if (!isRegular(mesh, grains, oblong)) {
			const auto after = triangulate(grains, oblong);
			const auto carried = carryOver(mesh, contents, after, voidAreas(after, grains, oblong));
			EXPECT_LE(relativeChange(contents.gas, carried.gas), 4e-15) << "step " << step;
			EXPECT_LE(relativeChange(contents.water, carried.water), 4e-15) << "step " << step;
			nFlipped += expectUntouched(mesh, contents, after, carried) / 2;
			mesh = after;
			contents = carried;
		}
		const auto entered = followVoids(contents, voidAreas(mesh, grains, oblong));
		gas += entered[0];
		water += entered[1];
		// Every step adds up 162 cells with an error of some 10 eps of the box, of random sign.
		EXPECT_NEAR(contents.totalGas(), gas, 1e-12 * oblong.area()) << "step " << step;
		EXPECT_NEAR(contents.totalWater(), water, 1e-12 * oblong.area()) << "step " << step;
	}
	EXPECT_GT(nFlipped, 500);
	double solid = 0;
	for (const Disk& g : grains)
		solid += M_PI * g.radius * g.radius;
	EXPECT_GE(gas + water, oblong.area() - solid - 1e-12 * oblong.area())
	        << "full to the last, and more where disks overlap";
}

/// Gas that is cut off keeps its amount when its void changes; water makes the difference.
TEST(FollowVoids, LeavesHeldGasAlone)
{
	Contents contents;
	contents.resize(3);
	contents.phase = { Phase::gas, Phase::gas, Phase::water };
	contents.gas = { 2, 2, 0 };
	contents.water = { 0, 0, 2 };
	contents.held = { 1, 0, 0 };
	const auto entered = followVoids(contents, { 1.5, 1.5, 1.5 });
	EXPECT_EQ(contents.gas, (std::vector<double> { 2, 1.5, 0 }));
	EXPECT_EQ(contents.water, (std::vector<double> { -0.5, 0, 1.5 }));
	EXPECT_EQ(entered[0], -0.5);
	EXPECT_EQ(entered[1], -1);
}

} // namespace capfrac
