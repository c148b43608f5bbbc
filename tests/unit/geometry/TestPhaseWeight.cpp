// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/FluidWeight with a weight per cell: two fluids at rest.

#include "Samples.hpp"
#include "geometry/FluidWeight.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	using samples::oblong;

	std::vector<Vec2> weights(samples::Random& random, std::size_t nCells)
	{
		std::vector<Vec2> weight(nCells);
		for (auto& w : weight)
			w = random.chance(0.5) ? Vec2 { 0.3, -1.7 } : Vec2 { 0.02, -0.1 };
		return weight;
	}

	/// Sum of w_c M_c about a fixed point.
	double potential(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box,
	        const std::vector<Vec2>& weight)
	{
		double sum = 0;
		for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
			const auto one = voidMoments(mesh, c, grains, box);
			sum += dot(weight[c],
			        one.first + one.area * Vec2 { box.left - oblong.left, box.bottom - oblong.bottom });
		}
		return sum;
	}

} // namespace

TEST(PhaseWeight, IsTheGradientOfTheWeightOfBothFluids)
{
	for (unsigned seed = 41; seed <= 43; ++seed) {
		samples::Random random(seed);
		auto grains = samples::looseSample(random, 25, oblong, 2);
		const auto mesh = triangulate(grains, oblong);
		const auto weight = weights(random, mesh.cells.size());
		const auto force = weightForces(mesh, grains, oblong, weight);
		const double h = 1e-5;
		auto slope = [&](double& moved) {
			const double at = moved;
			moved = at + h;
			const double up = potential(mesh, grains, oblong, weight);
			moved = at - h;
			const double down = potential(mesh, grains, oblong, weight);
			moved = at;
			return (up - down) / (2 * h);
		};
		// Central differences: h^2 of third derivatives of order 10, and rounding 1e-15 x 20/h.
		for (std::size_t i = 0; i < grains.size(); ++i) {
			EXPECT_NEAR(force.grains[i].x, slope(grains[i].centre.x), 1e-8) << "grain " << i;
			EXPECT_NEAR(force.grains[i].y, slope(grains[i].centre.y), 1e-8) << "grain " << i;
		}
		for (int w = 0; w < nWalls; ++w) {
			auto moved = [&](double by) {
				Box box = oblong;
				(w == wallLeft                    ? box.left
				                : w == wallRight  ? box.right
				                : w == wallBottom ? box.bottom
				                                  : box.top) += by * (w % 2 ? 1 : -1);
				return potential(mesh, grains, box, weight);
			};
			EXPECT_NEAR(dot(force.walls[w], Box::outward(w)), (moved(h) - moved(-h)) / (2 * h), 1e-8)
			        << "wall " << w;
		}
	}
}

TEST(PhaseWeight, OneWeightIsThatOfOneFluid)
{
	samples::Random random(44);
	const auto grains = samples::overlappingSample(random, 6, oblong, 0);
	const auto mesh = triangulate(grains, oblong);
	const Vec2 weight { 0.3, -1.7 };
	const auto one = weightForces(mesh, grains, oblong, weight),
	           many = weightForces(mesh, grains, oblong, std::vector<Vec2>(mesh.cells.size(), weight));
	for (std::size_t i = 0; i < grains.size(); ++i) // sums of some ten terms of up to 10
		EXPECT_NEAR(norm(one.grains[i] - many.grains[i]), 0, 1e-13);
	for (int w = 0; w < nWalls; ++w)
		EXPECT_NEAR(norm(one.walls[w] - many.walls[w]), 0, 1e-12);
}

TEST(PhaseWeight, AddsUpToTheWeightOfBothFluids)
{
	samples::Random random(45);
	for (const auto& grains :
	        { samples::looseSample(random, 40, oblong, 2), samples::overlappingSample(random, 6, oblong, 1e-3) }) {
		const auto mesh = triangulate(grains, oblong);
		const auto weight = weights(random, mesh.cells.size());
		const auto force = weightForces(mesh, grains, oblong, weight);
		Vec2 sum, expected;
		for (Vec2 f : force.grains)
			sum += f;
		for (Vec2 f : force.walls)
			sum += f;
		double lenses = 0; // where they turn between two weights is left out: see weightForces()
		for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c)
			expected += voidArea(mesh, c, grains, oblong) * weight[c];
		for (const Edge& e : mesh.edges)
			lenses += mesh.isWall(e.b)
			        ? segmentArea(grains[e.a].radius, oblong.distance(mesh.wallOf(e.b), grains[e.a].centre))
			        : lensArea(grains[e.a].radius, grains[e.b].radius,
			                norm(grains[e.b].centre - grains[e.a].centre));
		// A hundred terms of up to 10; a lens at most in the wrong half.
		EXPECT_NEAR(norm(sum - expected), 0, 1e-12 + 1.7 * lenses);
	}
}

} // namespace capfrac
