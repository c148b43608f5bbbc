// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A triangulation that follows its grains by local flips instead of being made anew.
///
/// Grains that moved a little leave all but a few edges as they were. An edge that is no longer locally
/// regular is replaced by the other diagonal of its two cells, and the four edges about them are looked at
/// again (Lawson 1977, for weighted points Edelsbrunner & Shah 1996). A power triangulation is the lower
/// hull of the vertices lifted to the height |x|^2 - r^2; every flip lowers the lifted surface, so an edge
/// that went never comes back and the flips end.
///
/// With weights, flips may get stuck at an edge that fails but is no diagonal of a convex quadrilateral. In
/// the plane that tells that a grain is hidden: the end of the edge where the corner is reflex lies within
/// the triangle of the other three vertices, and above it when lifted, so it is on no lower hull. From cells
/// of which none is turned over, flips thus reach every power triangulation that hides no grain, in whatever
/// order they are made.

#include "Triangulation.hpp"

namespace capfrac {

/// What flipToRegular() did.
struct Flips {
	int count = 0;     ///< flips made; 0 where not done
	bool done = false; ///< whether the triangulation now is regular
};

/// Makes `mesh`, made for other positions, radii or walls, the power triangulation of the same grains as
/// they are now: every edge between two cells is checked as by isRegular(), and those that fail are flipped
/// until none is left. For grains in general position the result is what triangulate() returns, to the
/// order of cells and edges; where four vertices share a power circle it is one of several regular ones.
///
/// Where nothing fails, nothing is changed, at the cost of isRegular(). Where flips do not get there, done
/// is false and the mesh is exactly as it was, for triangulate() to replace: when the motion turned a cell
/// over, when a grain is hidden (triangulate() will name it), or when it takes so many flips that a new
/// triangulation is no slower.
///
/// `mesh` must be as triangulate() left it, and the grains such that checkGrains() accepts them.
Flips flipToRegular(Triangulation& mesh, const std::vector<Disk>& grains, const Box& box);

} // namespace capfrac
