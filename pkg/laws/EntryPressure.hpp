// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Capillary pressure at which gas enters the throat between two grains that water wets.
///
/// The disks are read as layers of spheres, 2r apart in the direction that the model does not show (the
/// reading that makes the paper's Eq. 9 and Eq. 15 agree with each other). The throat between two grains
/// is then the opening between four spheres on the corners of a rectangle 2r x (2r + d), where d is the
/// gap of the pair; d < 0 is an overlap.

#include <stdexcept>
#include <string>

namespace capfrac {

enum class EntryLaw {
	inscribedSphere,  ///< Eq. 15 of Jain & Juanes (2008), corrected: the largest sphere through the throat
	mayerStowePrincen ///< MS-P: balance of the work of the meniscus and of the surfaces it leaves behind
};

/// A throat for which an entry law does not hold.
struct EntryLawError : std::domain_error {
	using std::domain_error::domain_error;
};

/// The law's name, "inscribedSphere" or "mayerStowePrincen", to the law. Throws std::invalid_argument.
EntryLaw entryLawFromName(const std::string& name);

/// Radius of the largest sphere that passes the throat [m]:
///
///     r_in = r ( sqrt(1 + (1 + d/(2r))^2) - 1 )
///
/// half of the rectangle's diagonal less the grain. `r` [m] > 0 is the mean radius of the pair, `gap` [m]
/// > -2r; a throat that is closed (gap <= -2r) throws EntryLawError.
double inscribedRadius(double gap, double r);

/// Entry pressure p_g - p_w [Pa], Eq. 15 of Jain & Juanes (2008) as corrected (its print has the "- 1"
/// under the root), times the cosine of the contact angle:
///
///     P_c = 2 gamma cos(theta) / r_in
///
/// 4.828 gamma/r at contact. `tension` gamma [N/m] > 0, `contactAngle` theta [rad] through the water, in
/// [0, pi/2). Throws EntryLawError outside of these.
double inscribedSphereEntryPressure(double gap, double r, double tension, double contactAngle);

/// Entry pressure after Mayer & Stowe (1965) and Princen [Pa], for theta = 0: P_c = gamma/r_c where r_c
/// is the free area of the throat over its free perimeter, wedges of water cut off by menisci of radius
/// r_c left out on both counts. Where no meniscus of that radius bridges the gap any more the gas enters
/// as a sheet, P_c = 2 gamma/d. 4.492 gamma/r at contact. Arguments as above; theta must be 0.
double mayerStowePrincenEntryPressure(double gap, double r, double tension, double contactAngle);

/// The entry pressure by the chosen law [Pa].
double entryPressure(EntryLaw law, double gap, double r, double tension, double contactAngle);

} // namespace capfrac
