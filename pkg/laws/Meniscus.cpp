// SPDX-License-Identifier: GPL-2.0-or-later
#include "Meniscus.hpp"
#include "Refusal.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace capfrac {

namespace {

	// Written so that NaN fails every test.
	void requirePositive(const char* what, double value)
	{
		if (!(value > 0 && std::isfinite(value))) refuse<MeniscusError>(what, value, "finite and > 0");
	}

	void check(const Menisci& menisci, double r1, double r2, double thickness)
	{
		requirePositive("interfacial tension [N/m]", menisci.tension);
		if (!(menisci.contactAngle >= 0 && menisci.contactAngle < M_PI / 2))
			refuse<MeniscusError>(
			        "contact angle [rad]", menisci.contactAngle, "0 <= angle < pi/2 (water wets)");
		requirePositive("chi [-]", menisci.chi);
		requirePositive("bridge volume over the cube of the radius [-]", menisci.bridgeVolume);
		if (!std::isfinite(menisci.ruptureGap))
			refuse<MeniscusError>("rupture gap over the radius [-]", menisci.ruptureGap, "finite");
		requirePositive("radius [m]", r1);
		requirePositive("radius [m]", r2);
		requirePositive("thickness [m]", thickness);
	}

	/// Force at contact [N] and the length b [m] over which that of a bridge falls.
	struct Pull {
		double atContact, length;

		Pull(const Menisci& menisci, double r1, double r2, double thickness)
		        : atContact(0)
		        , length(0)
		{
			check(menisci, r1, r2, thickness);
			if (menisci.law == MeniscusLaw::constant) {
				atContact = 2 * menisci.chi * menisci.tension * thickness;
				return;
			}
			const double mean = 0.5 * (r1 + r2), derjaguin = 2 * r1 * r2 / (r1 + r2);
			atContact = thickness / (2 * mean) * 2 * M_PI * derjaguin * menisci.tension
			        * std::cos(menisci.contactAngle);
			length = std::sqrt(2 * menisci.bridgeVolume * mean * mean * mean / (M_PI * derjaguin));
		}
	};

	double requireNumber(double gap)
	{
		if (!std::isfinite(gap)) refuse<MeniscusError>("gap [m]", gap, "finite");
		return gap;
	}

} // namespace

MeniscusLaw meniscusLawFromName(const std::string& name)
{
	if (name == "constant") return MeniscusLaw::constant;
	if (name == "bridge") return MeniscusLaw::bridge;
	throw std::invalid_argument("law = '" + name + "', allowed: 'constant', 'bridge'");
}

double lianRuptureGap(double bridgeVolume, double contactAngle)
{
	return (1 + 0.5 * contactAngle) * std::cbrt(bridgeVolume);
}

double ruptureGap(const Menisci& menisci, double r1, double r2)
{
	return 0.5 * (r1 + r2)
	        * (menisci.ruptureGap >= 0 ? menisci.ruptureGap
	                                   : lianRuptureGap(menisci.bridgeVolume, menisci.contactAngle));
}

double meniscusForce(const Menisci& menisci, double gap, double r1, double r2, double thickness)
{
	const Pull pull(menisci, r1, r2, thickness);
	if (requireNumber(gap) <= 0 || menisci.law == MeniscusLaw::constant) return pull.atContact;
	return pull.atContact * (1 - gap / std::hypot(gap, pull.length));
}

double meniscusEnergy(const Menisci& menisci, double gap, double r1, double r2, double thickness)
{
	const Pull pull(menisci, r1, r2, thickness);
	const double end = ruptureGap(menisci, r1, r2);
	if (menisci.law == MeniscusLaw::constant) return pull.atContact * (requireNumber(gap) - end);
	// Work from H to H' per force at contact: (H' - H) - (hypot(H', b) - hypot(H, b)), H' > H >= 0.
	const double open = std::max(requireNumber(gap), 0.0), overlap = std::min(gap, 0.0);
	return pull.atContact
	        * (overlap + (open - end) - (std::hypot(open, pull.length) - std::hypot(end, pull.length)));
}

} // namespace capfrac
