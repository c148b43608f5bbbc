// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The partition of the box into cells: one for every vertex of the power diagram of the grains.
///
/// The cells are the faces of the regular (power) triangulation of the disks together with the four
/// walls, each wall being the limit of a huge disk that touches the box from outside. A face between
/// three grains is a triangle; a face between two grains and a wall stands for the trapezoid down to
/// their feet on the wall; a face between a grain and two walls stands for the rectangle in the corner.
/// Together they tile the box exactly, whatever the size of the huge disks, because that size only
/// decides which cells there are, never their shape. (Mirrored grains would do as well, but make every
/// cell at a wall degenerate.)
///
/// Vertices 0 … nGrains-1 are grains; nGrains + w is the wall w (see Wall).

#include "Shapes.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace capfrac {

/// One face of the triangulation, vertices counter-clockwise.
struct Cell {
	std::array<int, 3> vertex {};    ///< ids, the smallest first (a cell has one way to be written)
	std::array<int, 3> neighbour {}; ///< cell across the edge opposite to vertex k; -1 outside the box
};

/// The edge between two vertices, seen once. `a` is always a grain; `b` is a grain with b > a, or a wall.
struct Edge {
	int a = 0, b = 0;
	int left = -1, right = -1; ///< the cells on the left and on the right of a -> b
};

struct Triangulation {
	int nGrains = 0;
	std::vector<Cell> cells;
	std::vector<Edge> edges; ///< all edges but those between two walls; sorted by (a, b)

	bool isWall(int vertex) const { return vertex >= nGrains; }
	int wallOf(int vertex) const { return vertex - nGrains; }
};

/// What is wrong with a set of grains that cannot be triangulated. The grain and the finding are there
/// apart as well, so that a caller who numbers grains differently can name it by its own number.
struct GeometryError : std::invalid_argument {
	GeometryError(int grain_, const std::string& finding_)
	        : std::invalid_argument(grain_ < 0 ? finding_ : "grain " + std::to_string(grain_) + ": " + finding_)
	        , grain(grain_)
	        , finding(finding_)
	{
	}
	int grain; ///< -1 where no single grain is at fault
	std::string finding;
};

/// Checks that the grains can be triangulated: at least one, all numbers finite, radii > 0, all centres
/// inside the box, the box not empty. Throws GeometryError naming the first grain at fault and the value.
void checkGrains(const std::vector<Disk>& grains, const Box& box);

/// The power triangulation of the grains and the walls (CGAL, exact predicates).
/// Throws GeometryError as checkGrains() does, and when a grain has no cell of its own because it lies
/// within others (coincident grains, for one).
Triangulation triangulate(const std::vector<Disk>& grains, const Box& box);

/// Whether `mesh`, made for other positions of the same grains, still is their power triangulation.
/// An edge is checked against the two vertices opposite to it, which is enough (Edelsbrunner & Shah 1996).
bool isRegular(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box);

/// Fills mesh.edges and the neighbours of mesh.cells from the vertices of mesh.cells.
void connectCells(Triangulation& mesh);

} // namespace capfrac
