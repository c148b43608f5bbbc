// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The pull of a meniscus between two grains that water wets (Fig. 6 of Jain & Juanes 2008).
///
/// Like throats (EntryPressure.hpp), menisci belong to the reading of the disks as layers of spheres, 2r apart in
/// the direction that the model does not show, r being the mean radius of the pair: one meniscus per layer and pair,
/// w/(2r) of them in a thickness w. H is the gap of the pair, H < 0 an overlap.
///
///     constant:  F = sigma_c 2 r w,  sigma_c = chi gamma/r :   F = 2 chi gamma w       (Eq. 5 with the paper's
///     sigma_c) bridge:    F = (w/(2r)) 2 pi R gamma cos(theta) (1 - H/sqrt(H^2 + 2V/(pi R))),   R = 2 r1 r2/(r1 + r2)
///
/// The second is the force of a pendular bridge of the volume V between spheres after Rabinovich, Esayanur & Moudgil
/// (2005, Eq. 20) and Lambert et al. (2008, Eq. 65), who write it 2 pi R gamma cos(theta)/(1 + H/(2 d)) with the
/// height d = (H/2)(-1 + sqrt(1 + 2V/(pi R H^2))) up to which the bridge wets them; that the two are the same one sees
/// by putting d in. At contact of equal grains F = pi gamma cos(theta) w, that is sigma_c = (pi/2) gamma/r. R is
/// Derjaguin's radius. In an overlap the force is that of contact. A meniscus breaks beyond the rupture gap H_r.
///
/// The energy is that of pulling the grains apart to H_r, below which it is negative:
///
///     constant:  U = F (H - H_r)
///     bridge:    U = F(0) ((H - sqrt(H^2 + b^2)) - (H_r - sqrt(H_r^2 + b^2))),  b^2 = 2V/(pi R);  linear for H < 0
///
/// so that F = dU/dH exactly, and a meniscus that breaks at H_r loses no energy: all that a cycle loses is lost when it
/// forms.

#include <stdexcept>
#include <string>

namespace capfrac {

enum class MeniscusLaw { constant, bridge };

/// A meniscus outside of the range of these laws.
struct MeniscusError : std::domain_error {
	using std::domain_error::domain_error;
};

/// "constant" or "bridge". Throws std::invalid_argument.
MeniscusLaw meniscusLawFromName(const std::string& name);

/// What the menisci of a sample share.
struct Menisci {
	MeniscusLaw law = MeniscusLaw::bridge;
	double tension = 0.05;      ///< gamma [N/m], > 0
	double contactAngle = 0;    ///< theta through the water [rad], in [0, pi/2)
	double chi = 10;            ///< strength of the constant law, sigma_c = chi gamma/r [-], > 0
	double bridgeVolume = 0.01; ///< V over the cube of the mean radius [-], > 0
	double ruptureGap = -1;     ///< H_r over the mean radius [-], >= 0; negative: that of lianRuptureGap()
};

/// Gap at which a bridge breaks after Lian, Thornton & Adams (1993), over the mean radius [-]: (1 + theta/2) V^(1/3), V
/// over the cube of the mean radius [-], theta [rad].
double lianRuptureGap(double bridgeVolume, double contactAngle);

/// The rupture gap H_r of grains of radii r1 and r2 [m].
double ruptureGap(const Menisci& menisci, double r1, double r2);

/// The attraction of a meniscus on each of the two grains [N], >= 0, at the gap H [m] (any sign; not cut off at H_r).
/// Radii [m] > 0, `thickness` w [m] > 0. Throws MeniscusError naming the value out of range.
double meniscusForce(const Menisci& menisci, double gap, double r1, double r2, double thickness);

/// Its energy [J], 0 at the rupture gap; arguments and errors as above.
double meniscusEnergy(const Menisci& menisci, double gap, double r1, double r2, double thickness);

} // namespace capfrac
