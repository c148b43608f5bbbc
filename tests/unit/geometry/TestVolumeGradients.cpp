// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/VolumeGradients: B is the derivative of the void areas and the transpose of the fluid forces.

#include "Samples.hpp"
#include "geometry/VolumeGradients.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	/// Packings, loose and tight, with walls cutting grains, and two of the smallest.
	std::vector<std::vector<Disk>> allSamples(Random& random)
	{
		return { samples::looseSample(random, 60, oblong, 3), samples::packedSample(random, 100, oblong, 1.67),
			samples::overlappingSample(random, 6, oblong, 1e-3), samples::looseSample(random, 2, oblong, 2),
			{ { { 2.2, 0.4 }, 0.5 } } };
	}

	/// The void areas after a displacement of one wall along its outward normal.
	std::vector<double> areasAfter(
	        const Triangulation& mesh, const std::vector<Disk>& grains, Box box, int wall, double outward)
	{
		double& at = *std::array<double*, nWalls> { &box.left, &box.right, &box.bottom, &box.top }[wall];
		at += (wall % 2 == 0 ? -1 : 1) * outward;
		return voidAreas(mesh, grains, box);
	}

	/// One column of B against central differences; cells without an entry must not change at all.
	void expectColumn(const std::vector<double>& column, const std::vector<double>& plus,
	        const std::vector<double>& minus, double h, double tolerance)
	{
		for (std::size_t c = 0; c < column.size(); ++c)
			EXPECT_NEAR(column[c], (plus[c] - minus[c]) / (2 * h), tolerance) << "cell " << c;
	}

} // namespace

TEST(VolumeGradients, AreTheDerivativeOfVoidAreas)
{
	for (unsigned seed = 1; seed <= 3; ++seed) {
		// Lengths in units of the spacing s = 1/2. No pair is closer to bare contact than 1e-3 s, so the
		// third derivative of V is at most 1.2e4/s (the overlap's), for the radius, which moves both
		// chord and arc, a few times that: h^2/6 of it is 1e-8 s for h = 1e-6 s. Round-off, 10 eps of
		// areas up to s^2 and as much again of the coordinates, over 2h: 4e-9 s. 1e-7 s is ten times that.
		const double s = 0.5, h = 1e-6 * s, tolerance = 1e-7 * s;
		Random random(seed);
		auto grains = samples::overlappingSample(random, 6, oblong, 1e-3);
		const auto mesh = triangulate(grains, oblong);
		const auto gradients = volumeGradients(mesh, grains, oblong);
		for (std::size_t i = 0; i < grains.size(); ++i) {
			std::vector<double> x(mesh.cells.size()), y(mesh.cells.size()), r(mesh.cells.size());
			for (const auto& g : gradients.grains)
				if (g.grain == static_cast<int>(i))
					x[g.cell] = g.centre.x, y[g.cell] = g.centre.y, r[g.cell] = g.radius;
			auto areas = [&](Vec2 step, double growth) {
				auto moved = grains;
				moved[i].centre += step, moved[i].radius += growth;
				return voidAreas(mesh, moved, oblong);
			};
			expectColumn(x, areas({ h, 0 }, 0), areas({ -h, 0 }, 0), h, tolerance);
			expectColumn(y, areas({ 0, h }, 0), areas({ 0, -h }, 0), h, tolerance);
			expectColumn(r, areas({ 0, 0 }, h), areas({ 0, 0 }, -h), h, tolerance);
		}
		for (int w = 0; w < nWalls; ++w) {
			std::vector<double> column(mesh.cells.size());
			for (const auto& g : gradients.walls)
				if (g.wall == w) column[g.cell] = g.outward;
			expectColumn(column, areasAfter(mesh, grains, oblong, w, h),
			        areasAfter(mesh, grains, oblong, w, -h), h, tolerance);
		}
	}
}

TEST(VolumeGradients, TransposedAreTheFluidForces)
{
	for (unsigned seed = 1; seed <= 3; ++seed) {
		Random random(seed);
		for (const auto& grains : allSamples(random)) {
			const auto mesh = triangulate(grains, oblong);
			std::vector<double> pressure(mesh.cells.size());
			for (double& p : pressure)
				p = random.uniform(0, 2e5);
			const auto expected = fluidForces(mesh, pressure, grains, oblong);
			const auto found = fluidForces(volumeGradients(mesh, grains, oblong), pressure, grains.size());
			// A force is a sum of about 12 terms of at most p times the longest edge, a few eps each. Edges
			// are shorter than the box; 12 x 4 eps = 1e-14.
			const double tolerance = 1e-14 * 2e5 * oblong.height();
			for (std::size_t i = 0; i < grains.size(); ++i) {
				EXPECT_NEAR(found.grains[i].x, expected.grains[i].x, tolerance) << "grain " << i;
				EXPECT_NEAR(found.grains[i].y, expected.grains[i].y, tolerance) << "grain " << i;
			}
			for (int w = 0; w < nWalls; ++w)
				EXPECT_NEAR(norm(found.walls[w] - expected.walls[w]), 0, 10 * tolerance)
				        << "wall " << w; // of all its cells
		}
	}
}

TEST(VolumeGradients, RowsAreSortedAndComplete)
{
	Random random(4);
	for (const auto& grains : allSamples(random)) {
		const auto mesh = triangulate(grains, oblong);
		const auto gradients = volumeGradients(mesh, grains, oblong);
		EXPECT_EQ(gradients.grains.size() + gradients.walls.size(), 3 * mesh.cells.size());
		for (std::size_t k = 1; k < gradients.grains.size(); ++k) {
			const auto &a = gradients.grains[k - 1], &b = gradients.grains[k];
			EXPECT_LT(std::tie(a.cell, a.grain), std::tie(b.cell, b.grain));
		}
		for (std::size_t k = 1; k < gradients.walls.size(); ++k) {
			const auto &a = gradients.walls[k - 1], &b = gradients.walls[k];
			EXPECT_LT(std::tie(a.cell, a.wall), std::tie(b.cell, b.wall));
		}
	}
}

TEST(VolumeGradients, MovingEverythingTogetherChangesNothing)
{
	Random random(5);
	for (const auto& grains : allSamples(random)) {
		const auto mesh = triangulate(grains, oblong);
		const auto gradients = volumeGradients(mesh, grains, oblong);
		const Vec2 velocity { 0.7, -1.3 };
		BoundaryRates rates;
		rates.centre.assign(grains.size(), velocity);
		for (int w = 0; w < nWalls; ++w)
			rates.outward[w] = dot(velocity, Box::outward(w));
		// Six terms up to the height of the box, a few eps each: 1e-14.
		for (double rate : voidAreaRates(gradients, rates, mesh.cells.size()))
			EXPECT_NEAR(rate, 0, 1e-14 * oblong.height());
	}
}

TEST(VolumeGradients, SimilarGrowthIsTwiceTheArea)
{
	// x -> (1 + t) x, r -> (1 + t) r makes V -> (1 + t)^2 V: Euler's relation, dV/dt = 2 V.
	Random random(6);
	for (const auto& grains : allSamples(random)) {
		const auto mesh = triangulate(grains, oblong);
		const auto area = voidAreas(mesh, grains, oblong);
		BoundaryRates rates;
		for (const Disk& g : grains) {
			rates.centre.push_back(g.centre);
			rates.radius.push_back(g.radius);
		}
		rates.outward = { -oblong.left, oblong.right, -oblong.bottom, oblong.top };
		const auto now = voidAreaRates(volumeGradients(mesh, grains, oblong), rates, area.size());
		// Terms of x times an edge, up to 4.5 x 4, nine of them with a few eps: 1e-13.
		for (std::size_t c = 0; c < area.size(); ++c)
			EXPECT_NEAR(now[c], 2 * area[c], 1e-13) << "cell " << c;
	}
}

TEST(VolumeGradients, GrainWithinAnotherStopsCounting)
{
	// A disk wholly beneath the overlap of a larger one: its growth changes no void, its whole circle
	// counted back by the lens.
	EXPECT_EQ(lensArea(0.1, 0.5, 0.35), M_PI * 0.1 * 0.1);
	const std::vector<Disk> grains { { { 3, 0 }, 0.5 }, { { 3.35, 0 }, 0.1 } };
	const auto mesh = triangulate(grains, oblong);
	const auto gradients = volumeGradients(mesh, grains, oblong);
	double total = 0;
	for (const auto& g : gradients.grains)
		if (g.grain == 1) total += g.radius;
	const double h = 1e-6;
	auto sumFor = [&](double r) {
		const std::vector<Disk> grown { grains[0], { grains[1].centre, r } };
		double sum = 0;
		for (double v : voidAreas(mesh, grown, oblong))
			sum += v;
		return sum;
	};
	EXPECT_NEAR(total, (sumFor(0.1 + h) - sumFor(0.1 - h)) / (2 * h), 1e-8); // 12 eps/2h
}

} // namespace capfrac
