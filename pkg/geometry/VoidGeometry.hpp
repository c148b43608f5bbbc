// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Void areas of the cells, gaps of the throats, and how both answer when grains and walls move.
///
/// The void area of a cell is its polygon less the sectors of its disks plus half of the lens (or the
/// circular segment, at a wall) of every pair on its border that overlaps:
///
///     V = A - 1/2 sum theta_i r_i^2 + 1/2 sum lens                    [m^2, times the thickness w: m^3]
///
/// so that the sum over all cells is the area of the box, less the disks, plus the overlaps, exactly.
/// Forces are the gradient of sum p V and nothing else (energy-consistent, no spurious work): fluid that
/// presses on both sides of a throat and the traction in the gap itself are both in it.

#include "Triangulation.hpp"

namespace capfrac {

/// Gap of a pair [m]: distance of the surfaces, negative where they overlap. `b` may be a wall.
double gap(const Triangulation& mesh, int a, int b, const std::vector<Disk>& grains, const Box& box);

/// Area common to two disks whose centres are `distance` apart [m^2]; 0 where they do not overlap.
double lensArea(double ra, double rb, double distance);

/// Part of a disk that lies beyond a wall at `distance` from its centre [m^2]; 0 where it does not reach it.
double segmentArea(double r, double distance);

/// Chord common to two overlapping circles [m], = -d(lensArea)/d(distance); 0 where they do not overlap.
double lensChord(double ra, double rb, double distance);

/// Chord that a wall at `distance` cuts from a circle [m]; 0 where it does not reach it.
double segmentChord(double r, double distance);

/// Void area of one cell [m^2]. Negative only for cells that are turned over or nearly full of disk.
double voidArea(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box);

/// Void areas of all cells [m^2].
std::vector<double> voidAreas(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box);

/// Area [m^2] and first moment [m^3] of a void; the moment is taken about the lower left corner of the box.
struct VoidMoments {
	double area = 0;
	Vec2 first;
};

/// Area (to the last bit that of voidArea()) and first moment of the void of one cell. Sums over the cells of a pore,
/// divided, give the centroid of its void, whatever the cells that it is cut into.
VoidMoments voidMoments(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box);

/// Centre of a cell, for reports and pictures [m]: mean of its corners (grain centres, feet, box corners).
Vec2 cellCentre(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box);

/// Corners of a cell, counter-clockwise [m]: three for a triangle, four for a cell at a wall. No heap: there is one for
/// each cell in each step.
class CellPolygon {
public:
	void push_back(Vec2 p) { corners[n++] = p; }
	std::size_t size() const { return n; }
	const Vec2& operator[](std::size_t k) const { return corners[k]; }
	const Vec2* begin() const { return corners.data(); }
	const Vec2* end() const { return corners.data() + n; }

private:
	std::array<Vec2, 6> corners; ///< two for each vertex that is a wall, at most
	std::size_t n = 0;
};
CellPolygon cellPolygon(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box);

/// Fluid forces per thickness [N/m]: the gradient of sum p V.
struct FluidForces {
	std::vector<Vec2> grains;       ///< on the grains
	std::array<Vec2, nWalls> walls; ///< on the walls; only the normal component can differ from zero

	/// Adds other forces on the same grains and walls.
	FluidForces& operator+=(const FluidForces& other);
};

/// Forces of the pressures [Pa] of the cells on grains and walls, F = sum over cells of p dV/dx.
/// One pass over the edges; the sum over all grains and walls is zero to round-off.
FluidForces fluidForces(const Triangulation& mesh, const std::vector<double>& pressure, const std::vector<Disk>& grains,
        const Box& box);

} // namespace capfrac
