// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/Flips: a mesh that was flipped is the mesh that would have been made anew.

#include "FlipChecks.hpp"
#include "geometry/VoidGeometry.hpp"
#include "network/Contents.hpp"

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	std::vector<Disk> sheared(std::vector<Disk> grains, double strain)
	{
		for (Disk& g : grains)
			g.centre.x += strain * g.centre.y; // the middle of `oblong` is at y = 0
		return grains;
	}

	std::vector<Disk> lattice(int columns, int rows)
	{
		std::vector<Disk> grains;
		for (int i = 0; i < columns; ++i)
			for (int j = 0; j < rows; ++j)
				grains.push_back(
				        { { oblong.left + 0.25 + 0.5 * i, oblong.bottom + 0.25 + 0.5 * j }, 0.25 });
		return grains;
	}

	long double total(const std::vector<double>& fluid)
	{
		long double sum = 0;
		for (double f : fluid)
			sum += f;
		return sum;
	}

} // namespace

TEST(Flips, NoneWhereNothingMoved)
{
	Random random(1);
	for (const auto& grains :
	        { samples::looseSample(random, 1, oblong, 1), samples::looseSample(random, 60, oblong, 10),
	                samples::packedSample(random, 80, oblong, 1.67), lattice(6, 8) }) {
		auto mesh = triangulate(grains, oblong);
		EXPECT_EQ(followAllTheWay(mesh, grains, oblong), 0);
	}
}

/// A diamond of four grains, whose diagonal follows the shorter of its two widths.
TEST(Flips, OneReplacesADiagonalByTheOther)
{
	auto diamond = [](double halfWidth, double halfHeight) {
		std::vector<Disk> grains;
		for (Vec2 side : { Vec2 { -halfWidth, 0 }, Vec2 { 0, -halfHeight }, Vec2 { halfWidth, 0 },
		             Vec2 { 0, halfHeight } })
			grains.push_back({ Vec2 { 3, 0.1 } + side, 0.05 });
		return grains;
	};
	auto mesh = triangulate(diamond(0.26, 0.25), oblong);
	const auto hasEdge = [&](int a, int b) {
		return std::any_of(
		        mesh.edges.begin(), mesh.edges.end(), [&](const Edge& e) { return e.a == a && e.b == b; });
	};
	EXPECT_TRUE(hasEdge(1, 3) && !hasEdge(0, 2));
	EXPECT_EQ(followAllTheWay(mesh, diamond(0.25, 0.26), oblong), 1);
	EXPECT_TRUE(hasEdge(0, 2) && !hasEdge(1, 3));
}

/// Contents as an engine carries them. A fluid is multiplied by a share and the shares of a part add up to
/// one to a few eps: 20 eps = 4e-15 cover parts of up to some ten cells; 100 such errors of random sign add
/// up to 4e-14.
TEST(Flips, FollowAShakenPackingAndKeepItsContents)
{
	int count = 0;
	for (double ratio : { 1.0, 1.67, 4.0 })
		for (Vec2 shift : { Vec2 { 0, 0 }, Vec2 { 3e6, -8e5 } }) {
			Random random(3);
			const auto packing = samples::shifted(samples::packedSample(random, 80, oblong, ratio), shift);
			const auto box = samples::shifted(oblong, shift);
			auto mesh = triangulate(packing, box);
			auto contents = waterFilled(voidAreas(mesh, packing, box));
			for (std::size_t c = 0; c < contents.gas.size(); c += 2)
				std::swap(contents.gas[c], contents.water[c]);
			const auto gas = total(contents.gas), water = total(contents.water);
			for (int step = 0; step < 100; ++step) {
				const auto grains = shaken(packing, random, box, 0.02);
				auto after = mesh;
				count += followAllTheWay(after, grains, box);
				const auto carried = carryOver(mesh, contents, after, voidAreas(after, grains, box));
				EXPECT_NEAR(total(carried.gas), total(contents.gas), 4e-15 * gas) << "step " << step;
				EXPECT_NEAR(total(carried.water), total(contents.water), 4e-15 * water)
				        << "step " << step;
				mesh = after;
				contents = carried;
			}
			EXPECT_NEAR(total(contents.gas), gas, 4e-14 * gas);
			EXPECT_NEAR(total(contents.water), water, 4e-14 * water);
		}
	EXPECT_GT(count, 1000) << "too few flips to test anything";
}

TEST(Flips, FollowMovingWalls)
{
	int count = 0;
	for (unsigned seed = 1; seed <= 5; ++seed) {
		Random random(seed);
		const auto grains = samples::looseSample(random, 60, oblong, 3);
		auto mesh = triangulate(grains, oblong);
		for (int step = 1; step <= 100; ++step) {
			const double away = std::sin(M_PI * step / 100);
			const Box box { oblong.left - 2.9 * away, oblong.right + 1.5 * away, oblong.bottom - 0.2 * away,
				oblong.top + 4.3 * away };
			count += followAllTheWay(mesh, grains, box);
		}
		EXPECT_TRUE(identical(mesh, triangulate(grains, oblong))) << "back where they were";
	}
	EXPECT_GT(count, 50);
}

TEST(Flips, FollowGrowingRadii)
{
	int count = 0;
	for (unsigned seed = 1; seed <= 5; ++seed) {
		Random random(seed);
		const auto first = samples::packedSample(random, 60, oblong, 1.67);
		auto grains = first;
		auto mesh = triangulate(grains, oblong);
		for (int step = 1; step <= 100; ++step) {
			for (std::size_t i = 0; i < grains.size(); ++i)
				grains[i].radius = (1 + 0.2 * std::sin(0.1 * step + i)) * first[i].radius;
			count += followAllTheWay(mesh, grains, oblong);
		}
	}
	EXPECT_GT(count, 50);
}

/// A packing in a wider box is sheared to and fro between strains of -3 and 3; the radii leave room for the
/// grains to pass each other.
TEST(Flips, FollowASimpleShear)
{
	Random random(6);
	auto grains = samples::packedSample(random, 200, oblong, 1.67);
	for (Disk& g : grains)
		g.radius *= 0.3;
	const Box wide { oblong.left - 6.1, oblong.right + 6.1, oblong.bottom, oblong.top };
	auto mesh = triangulate(grains, wide);
	int count = 0;
	for (int step = 1; step <= 800; ++step)
		count += followAllTheWay(mesh, sheared(grains, 3 * std::sin(M_PI * step / 200)), wide);
	EXPECT_GT(count, 3000);
}

/// Four vertices on a circle allow two meshes. Either will do, if it is sound, and always the same.
TEST(Flips, LeaveOneOfTheMeshesOfALattice)
{
	Random random(8);
	const auto byVertex = [](const Cell& c, const Cell& d) { return c.vertex < d.vertex; };
	auto mesh = triangulate(lattice(6, 8), oblong), twin = mesh;
	int count = 0;
	for (int step = 0; step < 100; ++step) {
		const auto grains = step % 2 ? lattice(6, 8) : shaken(lattice(6, 8), random, oblong, 0.02);
		const auto flips = flipToRegular(mesh, grains, oblong);
		EXPECT_TRUE(flips.done);
		EXPECT_EQ(flips.count, flipToRegular(twin, grains, oblong).count);
		EXPECT_TRUE(identical(mesh, twin));
		EXPECT_TRUE(isRegular(mesh, grains, oblong));
		EXPECT_TRUE(std::is_sorted(mesh.cells.begin(), mesh.cells.end(), byVertex));
		connectCells(twin);
		EXPECT_TRUE(identical(mesh, twin));
		count += flips.count;
	}
	EXPECT_GT(count, 500);
}

} // namespace capfrac
