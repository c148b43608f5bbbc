// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The weighted points of a power triangulation and the exact predicates on them.
///
/// Internal to the sources of this folder: it alone brings CGAL in, which no other header does. Whatever
/// makes a triangulation, checks it or mends it must take the points from here: the same rounding of a
/// point and the same predicate, or one would call regular what another does not.

#include "Triangulation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

namespace capfrac {

class PowerPoints {
public:
	using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
	using WeightedPoint = Kernel::Weighted_point_2;

	PowerPoints(const std::vector<Disk>& grains, const Box& box)
	{
		points.reserve(grains.size() + nWalls);
		for (const Disk& g : grains)
			points.emplace_back(Kernel::Point_2(g.centre.x, g.centre.y), g.radius * g.radius);
		for (int w = 0; w < nWalls; ++w)
			points.push_back(weightedWall(w, box));
	}

	int size() const { return static_cast<int>(points.size()); }
	const WeightedPoint& operator[](int vertex) const { return points[vertex]; }

	/// Whether the three vertices are in counter-clockwise order and not on one line.
	bool isCounterClockwise(const std::array<int, 3>& v) const
	{
		return orientation(points[v[0]].point(), points[v[1]].point(), points[v[2]].point()) == CGAL::LEFT_TURN;
	}

	/// Whether `vertex` lies inside the power circle of three vertices in counter-clockwise order.
	bool isInside(const std::array<int, 3>& v, int vertex) const
	{
		return powerSide(points[v[0]], points[v[1]], points[v[2]], points[vertex]) == CGAL::ON_POSITIVE_SIDE;
	}

private:
	/// Radius of the disk that stands for a wall, in box sizes. Its surface then sags by less than 1e-5 of
	/// the box over the wall, and its rounding error stays below 1e-11 of it.
	static constexpr double wallRadiusInBoxes = 1e5;

	static WeightedPoint weightedWall(int wall, const Box& box)
	{
		const double radius = wallRadiusInBoxes * std::max(box.width(), box.height());
		const Vec2 middle { 0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top) };
		const Vec2 centre = box.foot(wall, middle) + radius * Box::outward(wall);
		return WeightedPoint(Kernel::Point_2(centre.x, centre.y), radius * radius);
	}

	Kernel::Orientation_2 orientation;
	Kernel::Power_side_of_oriented_power_circle_2 powerSide;
	std::vector<WeightedPoint> points;
};

/// The vertex of `other`, the neighbour of `cell` across its edge k, that is not on that edge.
inline int apexAcross(const Cell& cell, int k, const Cell& other)
{
	return other.vertex[0] + other.vertex[1] + other.vertex[2] - cell.vertex[(k + 1) % 3]
	        - cell.vertex[(k + 2) % 3];
}

/// Whether the edge of cell c opposite to its vertex k is locally regular: the vertex across does not lie
/// inside the cell's power circle (on it is allowed), or there is none. Both cells must be counter-clockwise.
inline bool isLocallyRegular(const std::vector<Cell>& cells, int c, int k, const PowerPoints& points)
{
	const int other = cells[c].neighbour[k];
	return other < 0 || !points.isInside(cells[c].vertex, apexAcross(cells[c], k, cells[other]));
}

} // namespace capfrac
