// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/Flips: where flips do not get there, the mesh is left as it was.

#include "FlipChecks.hpp"

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

} // namespace

/// Displacements from 1e-3 to 0.3, where grains are 0.45 apart on average: the larger ones turn cells over.
TEST(Flips, GetThereOrChangeNothing)
{
	int done = 0, refused = 0, most = 0;
	for (unsigned seed = 1; seed <= 300; ++seed) {
		Random random(seed);
		auto grains = samples::looseSample(random, 60, oblong, 2);
		for (Disk& g : grains)
			g.radius *= 0.3; // none hides another
		auto mesh = triangulate(grains, oblong);
		const auto flips =
		        follow(mesh, shaken(grains, random, oblong, std::pow(10, random.uniform(-3, -0.5))), oblong);
		++(flips.done ? done : refused);
		most = std::max(most, flips.count);
	}
	EXPECT_GT(done, 100);
	EXPECT_GT(refused, 20);
	EXPECT_GT(most, 20);
}

/// Radii drawn anew, with centres that stay: no cell is turned over. Then an edge that fails and cannot be
/// flipped has a hidden grain at its end, so flips fail just where there is no triangulation.
TEST(Flips, FailForNewRadiiOnlyWhereAGrainIsHidden)
{
	int done = 0, hidden = 0;
	for (unsigned seed = 1; seed <= 300; ++seed) {
		Random random(seed);
		auto grains = samples::looseSample(random, 40, oblong, 2);
		auto mesh = triangulate(grains, oblong);
		const auto before = mesh;
		for (Disk& g : grains)
			g.radius = random.uniform(0.01, 0.5);
		try {
			EXPECT_GT(followAllTheWay(mesh, grains, oblong), 0);
			++done;
		} catch (const GeometryError&) {
			expectRefused(before, grains, oblong);
			++hidden;
		}
	}
	EXPECT_GT(done, 50);
	EXPECT_GT(hidden, 50);
}

/// A grain among four others that grow until their disks cover all it could call its own.
TEST(Flips, LeaveAGrainThatGetsHiddenToTriangulate)
{
	std::vector<Disk> grains { { { 3, 0.1 }, 0.1 } };
	for (Vec2 side : { Vec2 { 0.5, 0.02 }, Vec2 { -0.53, 0 }, Vec2 { 0, 0.55 }, Vec2 { 0.01, -0.52 } })
		grains.push_back({ grains[0].centre + side, 0.3 });
	auto mesh = triangulate(grains, oblong);
	for (int i = 1; i <= 4; ++i)
		grains[i].radius = 0.4;
	followAllTheWay(mesh, grains, oblong);
	for (int i = 1; i <= 4; ++i)
		grains[i].radius = 0.6;
	EXPECT_THROW(triangulate(grains, oblong), GeometryError);
	expectRefused(mesh, grains, oblong);
}

/// Two grains that both touch a wall change places along it in one step, which turns their cell at the wall
/// over; and two at the far ends of a sample. Flips alone may make something of it, but not always a mesh.
TEST(Flips, LeaveCellsThatAreTurnedOverToTriangulate)
{
	const auto pair = [](double y0, double y1) {
		return std::vector<Disk> { { { 4.0, y0 }, 0.01 }, { { 4.25, y1 }, 0.01 } };
	};
	expectRefused(triangulate(pair(0.37, 0.28), oblong), pair(0.3, 0.36), oblong);

	Random random(2);
	auto grains = samples::looseSample(random, 40, oblong, 1.5);
	const auto mesh = triangulate(grains, oblong);
	const auto byHeight = [](const Disk& a, const Disk& b) { return a.centre.y < b.centre.y; };
	const auto ends = std::minmax_element(grains.begin(), grains.end(), byHeight);
	std::swap(grains[ends.first - grains.begin()], grains[ends.second - grains.begin()]);
	expectRefused(mesh, grains, oblong);
}

/// Two rows of 20, one above the other, slide past each other without turning a cell over. A grain of one
/// passes half of the other on average: some 200 flips in 82 cells, too many at once but not one by one.
TEST(Flips, LeaveTooManyAtOnceToTriangulate)
{
	Random random(5);
	std::vector<Disk> grains;
	for (double y : { -0.5, 0.5 })
		for (int i = 0; i < 20; ++i)
			grains.push_back({ { 0.05 * i + random.uniform(0, 0.02), y }, 0.01 });
	const Box box { -0.2, 2.2, -1, 1 };
	const auto first = triangulate(grains, box);
	auto mesh = first;
	int count = 0;
	for (int step = 0; step < 20; ++step) {
		for (int i = 20; i < 40; ++i)
			grains[i].centre.x += 0.055;
		count += followAllTheWay(mesh, grains, box);
	}
	EXPECT_GT(count, 150);
	expectRefused(first, grains, box);
}

} // namespace capfrac
