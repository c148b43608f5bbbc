// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The forces of a fluid's weight on grains and walls: buoyancy.
///
/// A pore has one pressure, that at its centroid x_p; under its weight w = rho g the fluid in it presses with
/// p + w (x - x_p). The forces of that are the gradient of
///
///     sum over pores of (p - w x_p) V_p  +  w M,      M = first moment of all the void
///
/// at fixed p and x_p: those of the excess pressures p - w x_p (fluidForces()), and those of the second term, which
/// does not know pores: it is what a fluid at rest, of pressure w x, does. On a grain that is its area times -w, on a
/// wall w x along it. Pressures alone would make grains carry the fluid's weight, too: 20 % too much in a dense pack.

#include "VoidGeometry.hpp"

namespace capfrac {

/// Gradient of w M per thickness [N/m]: forces of the pressure w (x - corner) in a fluid of weight `weight` [N/m^3] at
/// rest, corner being the lower left one of the box. They add up to the fluid's weight. Where disks overlap or reach
/// beyond a wall the fluid does not press.
FluidForces weightForces(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box, Vec2 weight);

/// The same for a weight per cell [N/m^3]: the gradient of the sum of w_c M_c, M_c the first moment of the void of cell
/// c about the lower left corner of the box (held fixed). Two fluids at rest: pressures (p - w x_p) of fluidForces()
/// and these make up both fluids' forces. The sum over grains and walls is the weight of both. Exact but for the half
/// of a lens (of grains that overlap) that turns between two weights, some 1e-4 r^2 times their difference in a stiff
/// pack: there the mean weight counts.
FluidForces weightForces(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box,
        const std::vector<Vec2>& weightOfCell);

} // namespace capfrac
