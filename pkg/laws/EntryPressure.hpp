// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Capillary pressure at which gas enters the throat between two grains that water wets.
///
/// The disks are read as layers of spheres, 2r apart in the direction that the model does not show (the
/// reading that makes the paper's Eq. 9 and Eq. 15 agree with each other). The throat between two grains
/// is then the opening between four spheres on the corners of a rectangle 2r x (2r + d), where d is the
/// gap of the pair; d < 0 is an overlap.

#include "Laws.hpp"

#include <stdexcept>
#include <string>

namespace capfrac {

/// Laws that code asks for by name; the numbers are those of their rows in entryLaws().
enum class EntryLaw : int { inscribedSphere, mayerStowePrincen };

/// A law of the entry pressure.
struct EntryLawRow {
	using Law = EntryLaw;
	const char *name, *doc, *range;
	/// p_g - p_w [Pa] of a throat by its gap [m], mean radius [m], the interfacial tension [N/m] and the contact
	/// angle [rad]. Throws EntryLawError where the law does not hold.
	double (*pressure)(double gap, double r, double tension, double contactAngle);
	bool anyAngle; ///< whether it holds for other contact angles than 0
};

/// The laws there are, one a row.
const LawTable<EntryLawRow>& entryLaws();

/// A throat for which an entry law does not hold.
struct EntryLawError : std::domain_error {
	using std::domain_error::domain_error;
};

/// The law of that name. Throws std::invalid_argument with the names that there are.
inline EntryLaw entryLawFromName(const std::string& name) { return entryLaws().fromName(name); }

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

/// The entry pressure by the chosen law [Pa]. Arguments and errors as of EntryLawRow::pressure.
inline double entryPressure(EntryLaw law, double gap, double r, double tension, double contactAngle)
{
	return entryLaws()[law].pressure(gap, r, tension, contactAngle);
}

} // namespace capfrac
