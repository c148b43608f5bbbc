// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/Triangulation: when a mesh still holds, and which grains it refuses.

#include "Samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	/// The error of triangulate(), which must come.
	GeometryError errorOf(const std::vector<Disk>& grains, const Box& box)
	{
		try {
			triangulate(grains, box);
		} catch (const GeometryError& error) {
			return error;
		}
		ADD_FAILURE() << "no GeometryError";
		return GeometryError(-2, "");
	}

	void expectError(const std::vector<Disk>& grains, const Box& box, int grain, const std::string& text)
	{
		const auto error = errorOf(grains, box);
		EXPECT_EQ(error.grain, grain);
		EXPECT_NE(error.finding.find(text), std::string::npos) << error.what();
		const std::string name = grain < 0 ? "" : "grain " + std::to_string(grain) + ": ";
		EXPECT_EQ(error.what(), name + error.finding);
	}

} // namespace

/// In general position there is one power triangulation only, so the check of a moved mesh and a fresh
/// triangulation must agree. Steps small and large, so that both answers come up.
TEST(IsRegular, AgreesWithANewTriangulation)
{
	int stillRegular = 0, notRegular = 0;
	for (unsigned seed = 1; seed <= 100; ++seed) {
		Random random(seed);
		auto grains = samples::looseSample(random, 30, oblong, 2);
		auto box = oblong;
		const auto mesh = triangulate(grains, box);
		const double step = std::pow(10, random.uniform(-4, -1.5));
		box.right -= step * random.uniform(0, 1);
		box.bottom += step * random.uniform(0, 1);
		for (Disk& g : grains)
			g.centre += Vec2 { random.uniform(-step, step), random.uniform(-step, step) };
		const auto fresh = triangulate(grains, box);
		const bool same = std::equal(mesh.cells.begin(), mesh.cells.end(), fresh.cells.begin(),
		        [](const Cell& a, const Cell& b) { return a.vertex == b.vertex; });
		EXPECT_EQ(isRegular(mesh, grains, box), same) << "seed " << seed;
		++(same ? stillRegular : notRegular);
	}
	EXPECT_GT(stillRegular, 10);
	EXPECT_GT(notRegular, 10);
}

TEST(IsRegular, FailsWhenGrainsChangePlaces)
{
	Random random(2);
	auto grains = samples::looseSample(random, 40, oblong, 1.5);
	const auto mesh = triangulate(grains, oblong);
	const auto lowest = std::min_element(
	        grains.begin(), grains.end(), [](const Disk& a, const Disk& b) { return a.centre.y < b.centre.y; });
	const auto highest = std::max_element(
	        grains.begin(), grains.end(), [](const Disk& a, const Disk& b) { return a.centre.y < b.centre.y; });
	std::swap(*lowest, *highest);
	EXPECT_FALSE(isRegular(mesh, grains, oblong));
}

TEST(TriangulationErrors, NameTheGrainAndTheFinding)
{
	const double nan = std::nan(""), infinite = INFINITY;
	const Box box { 0, 1, 0, 1 };
	const Disk good { { 0.3, 0.3 }, 0.1 };
	expectError({}, box, -1, "no grains");
	expectError({ good, { { nan, 0.5 }, 0.1 } }, box, 1, "x [m] = nan, allowed: finite");
	expectError({ good, { { 0.5, infinite }, 0.1 } }, box, 1, "y [m] = inf, allowed: finite");
	expectError({ { { 0.5, 0.5 }, nan }, good }, box, 0, "radius [m] = nan, allowed: finite and > 0");
	expectError({ good, good, { { 0.5, 0.5 }, 0 } }, box, 2, "radius [m] = 0, allowed");
	expectError({ good, { { 0.5, 0.5 }, -0.1 } }, box, 1, "radius [m] = -0.1, allowed");
	expectError({ good, { { 0.5, 0.5 }, infinite } }, box, 1, "radius [m] = inf, allowed");
	expectError(
	        { good, { { 1.25, 0.5 }, 0.1 } }, box, 1, "x [m] = 1.25, allowed: between the left and the right wall");
	expectError({ good, { { 0.5, -0.25 }, 0.1 } }, box, 1,
	        "y [m] = -0.25, allowed: between the bottom and the top wall");
	expectError({ good, { { 0.5, 1 }, 0.1 } }, box, 1, "y [m] = 1, allowed");
	expectError({ good }, { 1, 0, 0, 1 }, -1, "is empty or not finite; allowed: left < right and bottom < top");
	expectError({ good }, { 0, 1, 0, nan }, -1, "is empty or not finite");
}

TEST(TriangulationErrors, GrainsWithoutRoomOfTheirOwn)
{
	const Box box { 0, 1, 0, 1 };
	const Disk good { { 0.3, 0.3 }, 0.1 };
	const auto twin = errorOf({ { { 0.7, 0.7 }, 0.1 }, good, good }, box);
	EXPECT_TRUE(twin.grain == 1 || twin.grain == 2) << twin.what();
	EXPECT_NE(twin.finding.find("has no room of its own: it coincides with another grain"), std::string::npos);
	// A small grain in the middle of four large ones that overlap: its power is the lowest nowhere.
	std::vector<Disk> crowd { { { 0.5, 0.5 }, 0.01 } };
	for (Vec2 side : { Vec2 { 0.1, 0 }, Vec2 { -0.1, 0 }, Vec2 { 0, 0.1 }, Vec2 { 0, -0.1 } })
		crowd.push_back({ crowd[0].centre + side, 0.2 });
	expectError(crowd, box, 0, "lies within its neighbours");
}

} // namespace capfrac
