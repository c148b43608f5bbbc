// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/VoidGeometry: the fluid forces are the gradient of sum p V and add up to nothing.

#include "Samples.hpp"
#include "geometry/VoidGeometry.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	constexpr double highest = 2e5; ///< [Pa]

	std::vector<double> randomPressures(Random& random, std::size_t n)
	{
		std::vector<double> pressure(n);
		for (double& p : pressure)
			p = random.uniform(0, highest);
		return pressure;
	}

	/// sum p (V(+) - V(-)) over the step 2h. Cells that do not change drop out exactly.
	double slope(const std::vector<double>& pressure, const std::vector<double>& plus,
	        const std::vector<double>& minus, double h)
	{
		double work = 0;
		for (std::size_t c = 0; c < pressure.size(); ++c)
			work += pressure[c] * (plus[c] - minus[c]);
		return work / (2 * h);
	}

	double slopeOfGrain(const Triangulation& mesh, const std::vector<double>& pressure, std::vector<Disk> grains,
	        const Box& box, int i, Vec2 step)
	{
		grains[i].centre += step;
		const auto plus = voidAreas(mesh, grains, box);
		grains[i].centre -= 2 * step;
		return slope(pressure, plus, voidAreas(mesh, grains, box), norm(step));
	}

	/// Along the outward normal of the wall.
	double slopeOfWall(const Triangulation& mesh, const std::vector<double>& pressure,
	        const std::vector<Disk>& grains, Box box, int wall, double h)
	{
		double& at = *std::array<double*, nWalls> { &box.left, &box.right, &box.bottom, &box.top }[wall];
		const double sign = wall % 2 == 0 ? -1 : 1, home = at;
		at = home + sign * h;
		const auto plus = voidAreas(mesh, grains, box);
		at = home - sign * h;
		return slope(pressure, plus, voidAreas(mesh, grains, box), h);
	}

	/// Sums of the forces and of their sizes.
	std::pair<Vec2, double> resultant(const FluidForces& force)
	{
		Vec2 sum;
		double size = 0;
		for (Vec2 f : force.grains)
			sum += f, size += norm(f);
		for (Vec2 f : force.walls)
			sum += f, size += norm(f);
		return { sum, size };
	}

	/// Step and tolerance: lengths in units of the spacing s = 1/2, about two radii; forces of order p s.
	/// No pair is closer to bare contact than u = 1e-3 s, so the third derivative of V is at most that of
	/// the overlap, (1/4) sqrt(8 R/u^3) with R <= 0.28 s: 1.2e4/s. The step h = 1e-6 s then makes an error
	/// of h^2/6 times it, 2e-9 p s for every overlap of a grain, and round-off, about 10 cells of 10 eps
	/// s^2 over 2h, makes 1e-8 p s. The tolerance of 1e-6 p s leaves a margin of 50.
	void expectGradient(const std::vector<Disk>& grains, const Box& box, Random& random)
	{
		const double spacing = 0.5, h = 1e-6 * spacing, tolerance = 1e-6 * highest * spacing;
		const auto mesh = triangulate(grains, box);
		const auto pressure = randomPressures(random, mesh.cells.size());
		const auto force = fluidForces(mesh, pressure, grains, box);
		for (int i = 0; i < mesh.nGrains; ++i) {
			EXPECT_NEAR(
			        force.grains[i].x, slopeOfGrain(mesh, pressure, grains, box, i, { h, 0 }), tolerance)
			        << "grain " << i;
			EXPECT_NEAR(
			        force.grains[i].y, slopeOfGrain(mesh, pressure, grains, box, i, { 0, h }), tolerance)
			        << "grain " << i;
		}
		// A wall moves all of its cells, up to 10 of them with as many overlaps: 10 times the error.
		for (int w = 0; w < nWalls; ++w) {
			const Vec2 normal = Box::outward(w);
			EXPECT_NEAR(dot(force.walls[w], normal), slopeOfWall(mesh, pressure, grains, box, w, h),
			        5 * tolerance)
			        << "wall " << w;
			EXPECT_EQ(dot(force.walls[w], turned(normal)), 0) << "a wall feels the normal component only";
		}
	}

	// Each force is the sum of a few terms of its own size, rounded by 10 eps; 1e-12 leaves room for grains
	// on which large terms cancel.
	void expectBalance(const std::vector<Disk>& grains, const Box& box, Random& random)
	{
		const auto mesh = triangulate(grains, box);
		const auto force = fluidForces(mesh, randomPressures(random, mesh.cells.size()), grains, box);
		const auto [sum, all] = resultant(force);
		EXPECT_GT(all, 0);
		EXPECT_NEAR(sum.x, 0, 1e-12 * all);
		EXPECT_NEAR(sum.y, 0, 1e-12 * all);
	}

	/// Every wall carries the pressure over its whole length, and nothing along it.
	void expectWallLoads(const FluidForces& force, const Box& box, double pressure)
	{
		for (int w = 0; w < nWalls; ++w) {
			const double load = pressure * (w < 2 ? box.height() : box.width());
			EXPECT_NEAR(dot(force.walls[w], Box::outward(w)), load, 1e-12 * load) << "wall " << w;
			EXPECT_EQ(dot(force.walls[w], turned(Box::outward(w))), 0);
		}
	}

} // namespace

TEST(FluidForces, AreTheGradientWithOverlapsAndWalls)
{
	for (unsigned seed = 1; seed <= 5; ++seed) {
		Random random(seed);
		const auto grains = samples::overlappingSample(random, 6, oblong, 1e-3);
		int overlaps = 0, atWalls = 0;
		for (std::size_t i = 0; i < grains.size(); ++i) {
			for (std::size_t j = 0; j < i; ++j)
				overlaps +=
				        norm(grains[i].centre - grains[j].centre) < grains[i].radius + grains[j].radius;
			for (int w = 0; w < nWalls; ++w)
				atWalls += oblong.distance(w, grains[i].centre) < grains[i].radius;
		}
		EXPECT_GT(overlaps, 10) << "the sample tests nothing";
		EXPECT_GT(atWalls, 4) << "the sample tests nothing";
		expectGradient(grains, oblong, random);
	}
}

TEST(FluidForces, AreTheGradientWithoutOverlaps)
{
	// Gaps have no third derivative at all beyond that of the angles, 1/s^3 of s^2.
	for (double ratio : { 1.0, 3.0 }) {
		Random random(8);
		expectGradient(samples::looseSample(random, 50, oblong, ratio), oblong, random);
	}
	Random random(9);
	expectGradient({ { { 2.2, 0.4 }, 0.5 } }, oblong, random);
}

TEST(FluidForces, AddUpToNothing)
{
	for (unsigned seed = 1; seed <= 5; ++seed) {
		Random random(seed);
		expectBalance(samples::looseSample(random, 100, oblong, 10), oblong, random);
		expectBalance(samples::packedSample(random, 100, oblong, 1.67), oblong, random);
		expectBalance(samples::overlappingSample(random, 6, oblong, 0), oblong, random);
		const Vec2 far { 1e4, -5e3 };
		expectBalance(samples::shifted(samples::packedSample(random, 50, oblong, 2), far),
		        samples::shifted(oblong, far), random);
	}
}

TEST(FluidForces, UniformPressureLoadsTheWallsOnly)
{
	for (unsigned seed = 1; seed <= 5; ++seed) {
		Random random(seed);
		const auto grains = samples::looseSample(random, 100, oblong, 4);
		const auto mesh = triangulate(grains, oblong);
		const double pressure = 1.3e5;
		const auto force = fluidForces(mesh, std::vector<double>(mesh.cells.size(), pressure), grains, oblong);
		expectWallLoads(force, oblong, pressure);
		for (Vec2 f : force.grains)
			EXPECT_EQ(norm(f), 0) << "no difference of pressure and no overlap: no term at all";
	}
}

/// A lens counts as void once more than the picture shows, so uniform pressure pushes the grains of each
/// pair together with p times the chord, and the walls as if there were no grains.
TEST(FluidForces, UniformPressureOnAPairThatOverlaps)
{
	const std::vector<Disk> pair { { { 2.5, 0.1 }, 0.4 }, { { 3.1, 0.1 }, 0.3 } };
	const auto mesh = triangulate(pair, oblong);
	const double pressure = 1e5, load = pressure * lensChord(0.4, 0.3, 0.6);
	const auto force = fluidForces(mesh, std::vector<double>(mesh.cells.size(), pressure), pair, oblong);
	expectWallLoads(force, oblong, pressure);
	EXPECT_NEAR(force.grains[0].x, load, 1e-12 * load);
	EXPECT_NEAR(force.grains[1].x, -load, 1e-12 * load);
	EXPECT_NEAR(force.grains[0].y, 0, 1e-12 * load);
}

/// A grain that splits the box from left to right but for two gaps, more pressure below: the whole width
/// carries the difference, the gaps with the grain.
TEST(FluidForces, DifferenceOfPressureAcrossOneGrain)
{
	const Box box { 0, 2, 0, 4 };
	const std::vector<Disk> grain { { { 1, 1.5 }, 0.9 } };
	const auto mesh = triangulate(grain, box);
	std::vector<double> pressure;
	for (int c = 0; c < 4; ++c)
		pressure.push_back(cellCentre(mesh, c, grain, box).y < 1.5 ? 300 : 100);
	const auto force = fluidForces(mesh, pressure, grain, box);
	EXPECT_NEAR(force.grains[0].y, 200 * box.width(), 1e-12 * 400);
	EXPECT_NEAR(force.grains[0].x, 0, 1e-12 * 400);
}

} // namespace capfrac
