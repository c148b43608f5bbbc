// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/FluidWeight: buoyancy as a gradient, and what it adds up to.

#include "Samples.hpp"
#include "geometry/FluidWeight.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	using samples::oblong;

	constexpr Vec2 weight { 0.3, -1.7 };

	/// w M of the whole void about a fixed point.
	double potential(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box)
	{
		VoidMoments sum;
		for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
			const auto one = voidMoments(mesh, c, grains, box);
			sum.area += one.area;
			// From the box's corner, which moves with the walls, to that of the oblong box.
			sum.first += one.first + one.area * Vec2 { box.left - oblong.left, box.bottom - oblong.bottom };
		}
		return dot(weight, sum.first);
	}

} // namespace

TEST(WeightForces, AreTheGradientOfTheWeightOfTheVoid)
{
	samples::Random random(31);
	// Away from bare contact, where the chord has no derivative.
	auto grains = samples::overlappingSample(random, 6, oblong, 1e-3);
	const auto mesh = triangulate(grains, oblong);
	const auto force = weightForces(mesh, grains, oblong, weight);
	const double h = 1e-5;
	auto slope = [&](double& moved) {
		const double at = moved;
		moved = at + h;
		const double up = potential(mesh, grains, oblong);
		moved = at - h;
		const double down = potential(mesh, grains, oblong);
		moved = at;
		return (up - down) / (2 * h);
	};
	// Central differences: h^2 of third derivatives of order 1/sqrt(overlap) ~ 1e2, and rounding 1e-14/h.
	for (std::size_t i = 0; i < grains.size(); ++i) {
		EXPECT_NEAR(force.grains[i].x, slope(grains[i].centre.x), 1e-6) << "grain " << i;
		EXPECT_NEAR(force.grains[i].y, slope(grains[i].centre.y), 1e-6) << "grain " << i;
	}
	for (int w = 0; w < nWalls; ++w) {
		auto moved = [&](double by) {
			Box box = oblong;
			(w == wallLeft                    ? box.left
			                : w == wallRight  ? box.right
			                : w == wallBottom ? box.bottom
			                                  : box.top) += by * (w % 2 ? 1 : -1);
			return potential(mesh, grains, box);
		};
		EXPECT_NEAR(dot(force.walls[w], Box::outward(w)), (moved(h) - moved(-h)) / (2 * h), 1e-6)
		        << "wall " << w;
	}
}

TEST(WeightForces, AddUpToTheWeightOfTheFluid)
{
	samples::Random random(32);
	for (double away : { 0.0, 1e-3 }) {
		const auto grains = samples::overlappingSample(random, 6, oblong, away);
		const auto mesh = triangulate(grains, oblong);
		const auto force = weightForces(mesh, grains, oblong, weight);
		Vec2 sum;
		double area = 0;
		for (Vec2 f : force.grains)
			sum += f;
		for (Vec2 f : force.walls)
			sum += f;
		for (double one : voidAreas(mesh, grains, oblong))
			area += one;
		// Some hundred terms of up to 10.
		EXPECT_NEAR(sum.x, area * weight.x, 1e-12);
		EXPECT_NEAR(sum.y, area * weight.y, 1e-12);
	}
}

TEST(WeightForces, AreThoseOfArchimedesOnALooseGrain)
{
	samples::Random random(33);
	const auto grains = samples::looseSample(random, 20, oblong, 2);
	const auto force = weightForces(triangulate(grains, oblong), grains, oblong, weight);
	for (std::size_t i = 0; i < grains.size(); ++i)
		EXPECT_DOUBLE_EQ(force.grains[i].y, M_PI * grains[i].radius * grains[i].radius * 1.7);
	EXPECT_EQ(force.walls[wallBottom].y, -(0.3 * 0.5 * oblong.width()) * oblong.width())
	        << "w x at the middle of the floor";
}

} // namespace capfrac
