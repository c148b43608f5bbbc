// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/Triangulation: the cells tile the box, whatever the grains.

#include "Samples.hpp"
#include "geometry/VoidGeometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	double shoelace(const CellPolygon& p)
	{
		double twice = 0;
		for (std::size_t k = 0; k < p.size(); ++k)
			twice += cross(p[k] - p[0], p[(k + 1) % p.size()] - p[0]);
		return 0.5 * twice;
	}

	bool holds(const std::vector<Vec2>& convex, Vec2 point)
	{
		for (std::size_t k = 0; k < convex.size(); ++k)
			if (cross(convex[(k + 1) % convex.size()] - convex[k], point - convex[k]) < 0) return false;
		return true;
	}

	double power(const Disk& g, Vec2 x) { return dot(x - g.centre, x - g.centre) - g.radius * g.radius; }

	/// Where three disks have the same power.
	Vec2 powerCentre(const Disk& a, const Disk& b, const Disk& c)
	{
		const Vec2 u = b.centre - a.centre, v = c.centre - a.centre;
		const double p = 0.5 * (dot(u, u) + a.radius * a.radius - b.radius * b.radius);
		const double q = 0.5 * (dot(v, v) + a.radius * a.radius - c.radius * c.radius);
		return a.centre + (1 / cross(u, v)) * Vec2 { p * v.y - q * u.y, q * u.x - p * v.x };
	}

	int wallsOf(const Triangulation& mesh, const Cell& cell)
	{
		return static_cast<int>(
		        std::count_if(cell.vertex.begin(), cell.vertex.end(), [&](int v) { return mesh.isWall(v); }));
	}

	bool hasSide(const Cell& cell, int from, int to)
	{
		for (int k = 0; k < 3; ++k)
			if (cell.vertex[k] == from && cell.vertex[(k + 1) % 3] == to) return true;
		return false;
	}

	void expectSoundCells(const Triangulation& mesh)
	{
		const int n = mesh.nGrains;
		// Euler for n + 4 vertices of which 4 are the hull.
		EXPECT_EQ(mesh.cells.size(), 2u * n + 2);
		std::set<int> used;
		int corners = 0;
		for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
			const auto& v = mesh.cells[c].vertex;
			EXPECT_LT(v[0], std::min(v[1], v[2]));
			EXPECT_NE(v[1], v[2]);
			used.insert(v.begin(), v.end());
			EXPECT_LT(wallsOf(mesh, mesh.cells[c]), 3);
			if (wallsOf(mesh, mesh.cells[c]) == 2) {
				++corners;
				EXPECT_NE(mesh.wallOf(v[1]) / 2, mesh.wallOf(v[2]) / 2)
				        << "opposite walls share no corner";
			}
			if (c > 0) {
				EXPECT_LT(mesh.cells[c - 1].vertex, v) << "sorted, none twice";
			}
		}
		EXPECT_EQ(corners, 4);
		EXPECT_EQ(used.size(), n + 4u);
		EXPECT_EQ(*used.begin(), 0);
		EXPECT_EQ(*used.rbegin(), n + 3);
	}

	void expectSoundNeighbours(const Triangulation& mesh)
	{
		for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c)
			for (int k = 0; k < 3; ++k) {
				const int from = mesh.cells[c].vertex[(k + 1) % 3],
				          to = mesh.cells[c].vertex[(k + 2) % 3];
				const int other = mesh.cells[c].neighbour[k];
				EXPECT_EQ(other == -1, mesh.isWall(from) && mesh.isWall(to));
				if (other < 0) continue;
				ASSERT_LT(other, static_cast<int>(mesh.cells.size()));
				EXPECT_TRUE(hasSide(mesh.cells[other], to, from));
				const auto& back = mesh.cells[other].neighbour;
				EXPECT_EQ(std::count(back.begin(), back.end(), c), 1) << "cells share one edge at most";
			}
		EXPECT_EQ(mesh.edges.size(), 3u * mesh.nGrains + 1) << "Euler, less the four edges between walls";
		for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
			const Edge& edge = mesh.edges[e];
			EXPECT_LT(edge.a, edge.b);
			EXPECT_FALSE(mesh.isWall(edge.a));
			ASSERT_TRUE(edge.left >= 0 && edge.right >= 0);
			EXPECT_TRUE(hasSide(mesh.cells[edge.left], edge.a, edge.b));
			EXPECT_TRUE(hasSide(mesh.cells[edge.right], edge.b, edge.a));
			if (e > 0) {
				EXPECT_LT(std::make_pair(mesh.edges[e - 1].a, mesh.edges[e - 1].b),
				        std::make_pair(edge.a, edge.b));
			}
		}
	}

	void expectTiling(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box)
	{
		double sum = 0;
		std::vector<CellPolygon> polygons;
		for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
			polygons.push_back(cellPolygon(mesh, c, grains, box));
			EXPECT_EQ(polygons.back().size(), wallsOf(mesh, mesh.cells[c]) == 0 ? 3u : 4u);
			EXPECT_GT(shoelace(polygons.back()), 0);
			sum += shoelace(polygons.back());
		}
		// A polygon is rounded by less than 10 eps of its squared diameter, and these add up to less than
		// 40 boxes in any of the samples here: 400 eps = 9e-14.
		EXPECT_NEAR(sum, box.area(), 1e-13 * box.area());
		Random random(7);
		for (int i = 0; i < 100; ++i) {
			const Vec2 p { random.uniform(box.left, box.right), random.uniform(box.bottom, box.top) };
			EXPECT_EQ(std::count_if(polygons.begin(), polygons.end(),
			                  [&](const auto& polygon) { return holds(polygon, p); }),
			        1);
		}
	}

	/// Every cell stands for a vertex of the power diagram: no grain has less power there than its own.
	void expectPowerDiagram(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box)
	{
		const double size = std::max(box.width(), box.height());
		for (const Cell& cell : mesh.cells) {
			std::vector<int> own, walls;
			for (int v : cell.vertex)
				(mesh.isWall(v) ? walls : own).push_back(v);
			Vec2 at;
			if (walls.empty())
				at = powerCentre(grains[own[0]], grains[own[1]], grains[own[2]]);
			else if (walls.size() == 2)
				at = box.foot(
				        mesh.wallOf(walls[0]), box.foot(mesh.wallOf(walls[1]), grains[own[0]].centre));
			else {
				// The mirror image of a grain has the same power on the wall and makes the third of
				// three.
				Disk mirrored = grains[own[0]];
				mirrored.centre += 2 * box.distance(mesh.wallOf(walls[0]), mirrored.centre)
				        * Box::outward(mesh.wallOf(walls[0]));
				at = powerCentre(grains[own[0]], mirrored, grains[own[1]]);
			}
			double lowest = power(grains[0], at);
			for (const Disk& g : grains)
				lowest = std::min(lowest, power(g, at));
			// A huge disk of 1e5 boxes sags by (size/2)^2 / (2e5 size) = 1.25e-6 boxes at a corner, where
			// the powers of two grains change by at most 2 sizes times that against each other.
			EXPECT_LE(power(grains[own[0]], at), lowest + 2.5e-6 * size * size);
			for (int w = 0; w < nWalls; ++w)
				EXPECT_GE(box.distance(w, at), -2.5e-6 * size);
		}
	}

	void expectSound(const std::vector<Disk>& grains, const Box& box)
	{
		const auto mesh = triangulate(grains, box);
		ASSERT_EQ(mesh.nGrains, static_cast<int>(grains.size()));
		expectSoundCells(mesh);
		expectSoundNeighbours(mesh);
		expectTiling(mesh, grains, box);
		expectPowerDiagram(mesh, grains, box);
		EXPECT_TRUE(isRegular(mesh, grains, box));
	}

} // namespace

class RandomGrains : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(RandomGrains, CellsTileTheBox)
{
	const auto [n, ratio] = GetParam();
	for (unsigned seed = 1; seed <= 3; ++seed) {
		Random random(seed);
		expectSound(samples::looseSample(random, n, oblong, ratio), oblong);
	}
}

TEST_P(RandomGrains, NumberingDoesNotMatter)
{
	const auto [n, ratio] = GetParam();
	Random random(11);
	const auto grains = samples::looseSample(random, n, oblong, ratio);
	const auto order = random.permutation(n);
	const auto plain = triangulate(grains, oblong), mixed = triangulate(samples::renumbered(grains, order), oblong);

	std::vector<std::array<int, 3>> expected, found;
	for (const Cell& cell : plain.cells)
		expected.push_back(cell.vertex);
	for (const Cell& cell : mixed.cells) {
		auto v = cell.vertex;
		for (int& i : v)
			i = mixed.isWall(i) ? i : order[i];
		std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
		found.push_back(v);
	}
	std::sort(found.begin(), found.end());
	EXPECT_EQ(found, expected);
}

INSTANTIATE_TEST_SUITE_P(SizesAndRatios, RandomGrains,
        testing::Combine(testing::Values(1, 2, 3, 10, 60, 200), testing::Values(1.0, 1.67, 4.0, 10.0)));

TEST(Triangulation, PackedGrainsWithOverlaps)
{
	for (double ratio : { 1.0, 1.67, 4.0 }) {
		Random random(5);
		expectSound(samples::packedSample(random, 80, oblong, ratio), oblong);
	}
}

TEST(Triangulation, CollinearGrains)
{
	const Vec2 middle { 3.0, 0.0 };
	for (Vec2 along : { Vec2 { 0.7, 0 }, Vec2 { 0, 0.7 }, Vec2 { 0.5, 0.5 }, Vec2 { 0.6, -0.3 } })
		for (int n = 1; n <= 3; ++n) {
			std::vector<Disk> grains;
			for (int i = 0; i < n; ++i)
				grains.push_back({ middle + (i - 0.5 * (n - 1)) * along, 0.2 + 0.03 * i });
			expectSound(grains, oblong);
		}
}

TEST(Triangulation, LatticesWhereFourGrainsShareACircle)
{
	for (double radius : { 0.1, 0.25 }) {
		std::vector<Disk> grains;
		for (int i = 0; i < 6; ++i)
			for (int j = 0; j < 8; ++j)
				grains.push_back(
				        { { oblong.left + 0.25 + 0.5 * i, oblong.bottom + 0.25 + 0.5 * j }, radius });
		expectSound(grains, oblong);
	}
}

TEST(Triangulation, FarFromTheOrigin)
{
	Random random(3);
	const Vec2 far { 3e6, -8e5 };
	const auto grains = samples::looseSample(random, 60, oblong, 3);
	expectSound(samples::shifted(grains, far), samples::shifted(oblong, far));
}

} // namespace capfrac
