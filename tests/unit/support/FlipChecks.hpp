// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Comparison of a mesh that was flipped with one made anew, for the tests of flips.

#include "Samples.hpp"
#include "geometry/Flips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

namespace capfrac {

/// The same cells, neighbours and edges, in the same order.
inline bool identical(const Triangulation& a, const Triangulation& b)
{
	const auto sameCell = [](const Cell& c, const Cell& d) {
		return c.vertex == d.vertex && c.neighbour == d.neighbour;
	};
	const auto sameEdge = [](const Edge& e, const Edge& f) {
		return e.a == f.a && e.b == f.b && e.left == f.left && e.right == f.right;
	};
	return a.nGrains == b.nGrains
	        && std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(), sameCell)
	        && std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(), sameEdge);
}

/// How many edges of `mesh` are not in `other`.
inline int edgesNotIn(const Triangulation& other, const Triangulation& mesh)
{
	std::vector<std::pair<int, int>> here, there, lost;
	for (const Edge& e : mesh.edges)
		here.push_back({ e.a, e.b });
	for (const Edge& e : other.edges)
		there.push_back({ e.a, e.b });
	std::set_difference(here.begin(), here.end(), there.begin(), there.end(), std::back_inserter(lost));
	return static_cast<int>(lost.size());
}

/// Flips the mesh, and compares it with a new one or, where flips do not get there, with what it was.
inline Flips follow(Triangulation& mesh, const std::vector<Disk>& grains, const Box& box)
{
	const auto before = mesh, fresh = triangulate(grains, box);
	const auto flips = flipToRegular(mesh, grains, box);
	EXPECT_TRUE(identical(mesh, flips.done ? fresh : before));
	// A flip takes away one edge, for good.
	EXPECT_GE(flips.count, flips.done ? edgesNotIn(fresh, before) : 0);
	EXPECT_EQ(flips.count > 0, flips.done && !identical(before, fresh));
	return flips;
}

/// As follow(), for motions that flips must be able to follow. Returns how many it takes.
inline int followAllTheWay(Triangulation& mesh, const std::vector<Disk>& grains, const Box& box)
{
	const auto flips = follow(mesh, grains, box);
	EXPECT_TRUE(flips.done);
	return flips.count;
}

/// For motions that flips must not be able to follow.
inline void expectRefused(Triangulation mesh, const std::vector<Disk>& grains, const Box& box)
{
	const auto before = mesh;
	const auto flips = flipToRegular(mesh, grains, box);
	EXPECT_FALSE(flips.done);
	EXPECT_EQ(flips.count, 0);
	EXPECT_TRUE(identical(mesh, before));
}

/// Every grain moved by up to `step` in x and in y, but not across a wall.
inline std::vector<Disk> shaken(std::vector<Disk> grains, samples::Random& random, const Box& box, double step)
{
	for (Disk& g : grains) {
		const Vec2 to = g.centre + Vec2 { random.uniform(-step, step), random.uniform(-step, step) };
		if (to.x > box.left && to.x < box.right && to.y > box.bottom && to.y < box.top) g.centre = to;
	}
	return grains;
}

} // namespace capfrac
