// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How easily fluid passes the throat between two grains.
///
/// Eq. 8 and 9 of Jain & Juanes (2008): a throat carries q = C (p - p_j)/L_j with the conductance
///
///     C = (C~/mu) (A^2/(2r)) w                                        [m^4/(Pa s)]
///
/// where A is the open area of one throat, C~ the shape factor of a duct of that cross-section, mu the
/// viscosity and w the thickness. The disks are read as layers of spheres 2r apart in the direction that
/// the model does not show, so that there are w/(2r) throats one behind the other; each is the opening
/// between four spheres on the corners of a rectangle 2r x (2r + d), the reading of EntryPressure.hpp.
/// d is the gap of the pair, d < 0 an overlap, e = d/(2r).

#include "Laws.hpp"

#include <stdexcept>
#include <string>

namespace capfrac {

/// Laws that code asks for by name; the numbers are those of their rows in conductanceLaws().
enum class ConductanceLaw : int {
	fourSpheres,     ///< Eq. 9 with C~ of the duct between four spheres, shapeFactor()
	constantShape,   ///< Eq. 9 with C~ = 0.026, the value about contact, whatever the gap
	inscribedCircle, ///< one Poiseuille pipe per layer, as wide as the inscribed sphere: C = (pi/8) r_in^4 w/(2r
	                 ///< mu)
	parallelPlates,  ///< a slit that closes under the force of its contact: C = w a^3/(12 mu), plateAperture()
	lubrication      ///< flow in the plane between two true disks; nothing passes a contact
};

/// A throat for which a conductance law does not hold.
struct ConductanceError : std::domain_error {
	using std::domain_error::domain_error;
};

/// Open area between four spheres [m^2], c = 1 + e:
///
///     A = r^2 (4c - pi + 2 (acos c - c sqrt(1 - c^2)))                the last term for c < 1 only
///
/// It closes to 0 at gap = -2r and stays 0 beyond. `r` [m] > 0 is the mean radius of the pair, `gap` [m]
/// finite; otherwise ConductanceError.
double throatArea(double gap, double r);

/// Shape factor C~ of the duct between four spheres [-]: Stokes flow under the gradient of pressure G
/// carries Q = C~ A^2 G/mu. 0.0263 at contact, between 0.0246 and 0.0279 for |e| <= 0.2.
///
/// Fits to finite-element solutions (120 x 240, extrapolated), within 0.4 % of them for every e > -1:
///   -0.3 <= e <= 0.5   ln(C~ A^2/r^4) is a polynomial in e;
///   e < -0.3           goes to the slit of parabolic width that is left at last, C~ = (3/56) c for c -> 0;
///   e > 0.5            C~ A^2 = r h^3/6, parallel plates 2r wide per layer at h = d + r (0.235 + 0.031/e):
///                      the walls of touching spheres lie a little behind their crests (e up to 10 solved).
/// 0 where the throat is closed. Arguments as above.
double shapeFactor(double gap, double r);

/// The slit of the law parallelPlates.
struct PlateAperture {
	double residual = 0;      ///< a_0 [m] >= 0: aperture of a contact that bears no force
	double halvingForce = 1;  ///< F_0 [N] > 0: force that halves it
	double gapMultiplier = 1; ///< m [-] in [0, 1]: how much of a gap counts as aperture
};

/// Aperture of the slit [m]:
///
///     a = a_0 F_0/(F + F_0)     in contact (gap <= 0) under the normal force F [N] >= 0 (compression)
///     a = a_0 + m d             apart (gap > 0)
///
/// the hyperbolic closure that network models of rock use (Al-Busaidi, Hazzard & Young 2005,
/// doi:10.1029/2004JB003297). Throws ConductanceError outside of the ranges named.
double plateAperture(double gap, double normalForce, const PlateAperture& plates);

/// What single laws need besides the gap and the mean radius.
struct ThroatDetails {
	double length = 0;      ///< L_j [m] > 0, from pore to pore; for laws of a resistance that does not depend on it
	double normalForce = 0; ///< of the contact [N] >= 0; for laws with `contactForce`
	PlateAperture plates;   ///< of the law parallelPlates
};

/// The mean radius of a pair [m], (a + b)/2.
double meanRadius(double a, double b);
/// The harmonic mean of the radii of a pair [m], 2 a b/(a + b): that of the parabola between two true disks.
double harmonicRadius(double a, double b);

/// A law of the conductance.
struct ConductanceRow {
	using Law = ConductanceLaw;
	const char *name, *doc, *range;
	/// C [m^4/(Pa s)] of a throat by `scale` = factor w/mu [m/(Pa s)], its gap [m] and the radius r [m] that the
	/// law wants. Throws ConductanceError where the law does not hold.
	double (*conductance)(double scale, double gap, double r, const ThroatDetails& details);
	double (*radius)(double a, double b); ///< the radius that it wants, of the radii of the pair [m]
	bool contactForce;                    ///< whether it asks for ThroatDetails::normalForce
};

/// The laws there are, one a row.
const LawTable<ConductanceRow>& conductanceLaws();

/// The law of that name. Throws std::invalid_argument with the names that there are.
inline ConductanceLaw conductanceLawFromName(const std::string& name) { return conductanceLaws().fromName(name); }

/// Conductance C of a throat [m^4/(Pa s)] by a law, times `factor` [-] >= 0.
///
/// `r` [m] > 0 is the radius that the law wants: the mean radius of the pair, for lubrication the harmonic mean
/// R* = 2 r_a r_b/(r_a + r_b) (at a wall 2 r_a); `viscosity` mu [Pa s] > 0, `thickness` w [m] > 0. Lubrication, valid
/// for d << r:
///
///     q = (2/(9 pi)) d^(5/2) w (p - p_j)/(mu sqrt(R*)),   C = L_j q/(p - p_j);   0 for d <= 0
///
/// from the integral of dx/(d + x^2/R*)^3; the constant is that of Gebart (1992),
/// doi:10.1177/002199839202600802. The other laws are those of ConductanceLaw; a closed throat
/// has C = 0. Throws ConductanceError that names the value and what is allowed.
double conductance(const ConductanceRow& law, double gap, double r, double viscosity, double thickness,
        const ThroatDetails& details = {}, double factor = 1);

/// The same by the chosen law.
inline double conductance(ConductanceLaw law, double gap, double r, double viscosity, double thickness,
        const ThroatDetails& details = {}, double factor = 1)
{
	return conductance(conductanceLaws()[law], gap, r, viscosity, thickness, details, factor);
}

} // namespace capfrac
