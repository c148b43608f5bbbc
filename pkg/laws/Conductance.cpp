// SPDX-License-Identifier: GPL-2.0-or-later
#include "Conductance.hpp"

#include "EntryPressure.hpp"
#include "Refusal.hpp"

#include <cmath>
#include <sstream>

namespace capfrac {

namespace {

	// Written so that NaN and infinity fail every test.
	void checkPositive(const char* what, double value)
	{
		if (!(value > 0 && std::isfinite(value))) refuse<ConductanceError>(what, value, "> 0");
	}

	void checkNotNegative(const char* what, double value)
	{
		if (!(value >= 0 && std::isfinite(value))) refuse<ConductanceError>(what, value, ">= 0");
	}

	void checkThroat(double gap, double r)
	{
		checkPositive("mean radius of the throat [m]", r);
		if (!std::isfinite(gap)) refuse<ConductanceError>("gap of the throat [m]", gap, "a finite number");
	}

	/// Where the fits of C~ meet, in e.
	constexpr double nearlyClosed = -0.3, wideOpen = 0.5;

	/// Open area for r = 1, c = 1 + e > 0.
	double unitArea(double c)
	{
		if (c >= 1) return 4 * c - M_PI;
		// The terms cancel down to c^3 where the throat closes; there their series keeps the digits.
		if (c < 0.01) return c * c * c * (2.0 / 3 + c * c * (0.1 + c * c / 28));
		return 4 * c - M_PI + 2 * (std::acos(c) - c * std::sqrt(1 - c * c));
	}

	/// C~ A^2 for r = 1 between nearlyClosed and wideOpen (0.35 %).
	double aboutContact(double e)
	{
		return std::exp(-3.94125174
		        + e * (7.21896214 + e * (-2.35738873 + e * (1.02177363 + e * (-7.09268631 + e * 7.2097651)))));
	}

	/// C~ up to a factor below nearlyClosed (0.21 %).
	double closingShape(double c) { return c * (1 + c * c * (-1.71597114 + c * (2.59529965 - c * 1.47143155))); }

	/// Excess of the distance of the plates over the gap above wideOpen, up to a constant (0.07 % of C~ A^2).
	double behindCrests(double e) { return 0.03092171 / e; }

	double unitShapeFactor(double e)
	{
		const double area = unitArea(1 + e);
		if (e < nearlyClosed) {
			const double atJoint = aboutContact(nearlyClosed) / std::pow(unitArea(1 + nearlyClosed), 2);
			return atJoint * closingShape(1 + e) / closingShape(1 + nearlyClosed);
		}
		if (e <= wideOpen) return aboutContact(e) / (area * area);
		const double constant = std::cbrt(6 * aboutContact(wideOpen)) - 2 * wideOpen - behindCrests(wideOpen);
		const double distance = 2 * e + constant + behindCrests(e);
		return distance * distance * distance / (6 * area * area);
	}

	/// C~ A^2/(2r) of Eq. 9 [m^3], or what takes its place.
	double perLayer(ConductanceLaw law, double gap, double r)
	{
		if (gap <= -2 * r) return 0;
		if (law == ConductanceLaw::inscribedCircle)
			return M_PI / 8 * std::pow(inscribedRadius(gap, r), 4) / (2 * r);
		const double shape = law == ConductanceLaw::constantShape ? 0.026 : shapeFactor(gap, r);
		return shape * std::pow(throatArea(gap, r), 2) / (2 * r);
	}

	double lubrication(double gap, double r, double length)
	{
		checkPositive("length of the throat [m]", length);
		return gap <= 0 ? 0 : length * 2 / (9 * M_PI) * gap * gap * std::sqrt(gap / r);
	}

} // namespace

ConductanceLaw conductanceLawFromName(const std::string& name)
{
	if (name == "fourSpheres") return ConductanceLaw::fourSpheres;
	if (name == "constantShape") return ConductanceLaw::constantShape;
	if (name == "inscribedCircle") return ConductanceLaw::inscribedCircle;
	if (name == "parallelPlates") return ConductanceLaw::parallelPlates;
	if (name == "lubrication") return ConductanceLaw::lubrication;
	throw std::invalid_argument("conductanceLaw = '" + name
	        + "', allowed: 'fourSpheres', 'constantShape', 'inscribedCircle', 'parallelPlates', 'lubrication'");
}

double throatArea(double gap, double r)
{
	checkThroat(gap, r);
	const double c = 1 + gap / (2 * r);
	return c <= 0 ? 0 : r * r * unitArea(c);
}

double shapeFactor(double gap, double r)
{
	checkThroat(gap, r);
	const double e = gap / (2 * r);
	return e <= -1 ? 0 : unitShapeFactor(e);
}

double plateAperture(double gap, double normalForce, const PlateAperture& plates)
{
	if (!std::isfinite(gap)) refuse<ConductanceError>("gap of the throat [m]", gap, "a finite number");
	checkNotNegative("normal force of the contact [N]", normalForce);
	checkNotNegative("residual aperture [m]", plates.residual);
	checkPositive("force that halves the aperture [N]", plates.halvingForce);
	if (!(plates.gapMultiplier >= 0 && plates.gapMultiplier <= 1))
		refuse<ConductanceError>("multiplier of the gap [-]", plates.gapMultiplier, "0 to 1");
	if (gap > 0) return plates.residual + plates.gapMultiplier * gap;
	return plates.residual * plates.halvingForce / (normalForce + plates.halvingForce);
}

double conductance(ConductanceLaw law, double gap, double r, double viscosity, double thickness,
        const ThroatDetails& details, double factor)
{
	checkThroat(gap, r);
	checkPositive("viscosity [Pa s]", viscosity);
	checkPositive("thickness [m]", thickness);
	checkNotNegative("conductance factor [-]", factor);
	const double scale = factor * thickness / viscosity;
	switch (law) {
	case ConductanceLaw::parallelPlates:
		return scale * std::pow(plateAperture(gap, details.normalForce, details.plates), 3) / 12;
	case ConductanceLaw::lubrication:
		return scale * lubrication(gap, r, details.length);
	default:
		return scale * perLayer(law, gap, r);
	}
}

} // namespace capfrac
