// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Capillary pressures below which water comes back: into a pore body, and into a throat (snap-off).
///
/// The grains are read as in EntryPressure.hpp, as layers of spheres 2r apart in the direction that the model does not
/// show. On the plane midway between two layers a point at the in-plane distance rho of a sphere's centre is
///
///     sqrt(rho^2 + r^2) - r
///
/// off its surface. In a throat the widest such point is the middle of the gap, rho = r + d/2: Eq. 15. In a cell it is
/// the centre of the circle that touches the cell's three disks: with s the radius of that circle rho = r + s, r the
/// mean radius.

#include "../geometry/VoidGeometry.hpp"

namespace capfrac {

/// The widest place of a cell.
struct PoreBody {
	double radius = 0; ///< of the largest sphere there [m]; 0 where the cell has none of its own
	Vec2 centre;       ///< [m]
};

/// The circle that touches three disks from outside (Apollonius): with centres x_i and radii r_i, |c - x_i| = s + r_i.
/// Less the first, these are linear in c and s, c = u - s v; the first is then a quadratic in s, (|v|^2 - 1) s^2 - 2
/// (u.v + r_0) s + |u|^2 - r_0^2 = 0. `radius` is s [m] (negative where the disks leave no room between them), NaN
/// where there is no such circle.
PoreBody touchingCircle(const Disk& a, const Disk& b, const Disk& c);

/// Radius of the largest sphere in a pore whose in-plane circle has the radius `s` [m], > -r, between grains of mean
/// radius `r` [m], > 0: r ( sqrt(1 + (1 + s/r)^2) - 1 ); inscribedRadius() of the gap 2s. 0.5275 r between three equal
/// disks in contact, 0.7321 r between four on a square.
double bodyRadius(double s, double r);

/// The widest place of a cell. At a wall the grains meet their mirror images: the circle of a cell of two grains has
/// its centre on the wall, that of one grain in a corner has it in the corner. A circle whose centre lies outside of
/// the cell (an obtuse triangle's) is not of this cell, which is then nowhere wider than at its sides: radius 0.
PoreBody poreBody(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box);

/// Capillary pressure below which water refills a pore body [Pa]: 2 gamma cos(theta)/radius. `tension` gamma [N/m] > 0,
/// `contactAngle` theta [rad] in [0, pi/2), `radius` [m] > 0. Throws EntryLawError outside of these.
double refillPressure(double radius, double tension, double contactAngle);

/// Half of the angle of the corners that hold the water in a throat when it snaps off [rad]: 45 degrees. The films'
/// menisci meet where the grains are nearest to the throat's axis, on its inscribed circle. There the four grains'
/// tangents enclose a square (at contact; a rhombus of 90 degrees on the average otherwise).
constexpr double snapOffCorner = 0.25 * 3.14159265358979323846;

/// Capillary pressure below which the water films in a throat snap its gas off [Pa]:
///
///     P_c = gamma/r_in (cos(theta) - sin(theta) tan(beta)),    beta = snapOffCorner
///
/// half of the entry pressure at theta = 0. `radius` r_in [m] > 0 is the throat's inscribed radius. Valid for theta +
/// beta < 90 degrees: beyond, films do not swell. Throws EntryLawError outside.
double snapOffPressure(double radius, double tension, double contactAngle);

} // namespace capfrac
