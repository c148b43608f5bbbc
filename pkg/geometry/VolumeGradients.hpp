// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The matrix B = dV/dx: how the void area of every cell answers to every grain and wall.
///
/// It couples both ways: F = B^T p are the fluid forces (fluidForces() does that sum without the matrix),
/// and B v is the rate at which the voids grow when grains and walls move, so that what the fluid gains in
/// pressure the grains lose in work, and the other way round. All per thickness, for a fixed triangulation.

#include "VoidGeometry.hpp"

namespace capfrac {

/// Row `cell`, columns of one grain.
struct GrainGradient {
	int cell = -1, grain = -1;
	Vec2 centre;       ///< dV/d(centre) [m]
	double radius = 0; ///< dV/d(radius) [m], centres held; 0 where it was not asked for
};

/// Row `cell`, column of one wall.
struct WallGradient {
	int cell = -1, wall = -1;
	double outward = 0; ///< dV/d(displacement along Box::outward) [m]
};

/// B by rows; every cell has one entry for each of its three vertices.
struct VolumeGradients {
	std::vector<GrainGradient> grains; ///< sorted by cell, then grain
	std::vector<WallGradient> walls;   ///< sorted by cell, then wall
};

/// What volumeGradients() computes: rigid grains need no derivatives by radii, half of its cost.
enum class Radii { vary, fixed };

/// B for all cells. Where a pair just touches, the derivative of the overlap is the one from outside, 0.
/// Throws nothing that triangulate() has not refused before.
VolumeGradients volumeGradients(
        const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box, Radii radii = Radii::vary);

/// B^T p [N/m]: fluidForces() to round-off. `pressure` [Pa] of the cells.
FluidForces fluidForces(const VolumeGradients& gradients, const std::vector<double>& pressure, std::size_t nGrains);

/// How fast grains and walls move and grow. `radius` may be left empty: rigid grains.
struct BoundaryRates {
	std::vector<Vec2> centre;              ///< velocities of the grains [m/s]
	std::array<double, nWalls> outward {}; ///< velocities of the walls along Box::outward [m/s]
	std::vector<double> radius;            ///< growth of the grains [m/s]
};

/// B v [m^2/s]: rates of the void areas of `nCells` cells.
std::vector<double> voidAreaRates(const VolumeGradients& gradients, const BoundaryRates& rates, std::size_t nCells);

} // namespace capfrac
