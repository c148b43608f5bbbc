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

	/// Eq. 9 with a shape factor.
	double duct(double scale, double gap, double r, double shape)
	{
		return scale * (shape * std::pow(throatArea(gap, r), 2) / (2 * r));
	}

	double fourSpheres(double scale, double gap, double r, const ThroatDetails&)
	{
		return gap <= -2 * r ? 0 : duct(scale, gap, r, shapeFactor(gap, r));
	}

	double constantShape(double scale, double gap, double r, const ThroatDetails&)
	{
		return gap <= -2 * r ? 0 : duct(scale, gap, r, 0.026);
	}

	double inscribedCircle(double scale, double gap, double r, const ThroatDetails&)
	{
		if (gap <= -2 * r) return 0;
		return scale * (M_PI / 8 * std::pow(inscribedRadius(gap, r), 4) / (2 * r));
	}

	double parallelPlates(double scale, double gap, double, const ThroatDetails& details)
	{
		return scale * std::pow(plateAperture(gap, details.normalForce, details.plates), 3) / 12;
	}

	double lubrication(double scale, double gap, double r, const ThroatDetails& details)
	{
		checkPositive("length of the throat [m]", details.length);
		return gap <= 0 ? 0 : scale * (details.length * 2 / (9 * M_PI) * gap * gap * std::sqrt(gap / r));
	}

} // namespace

const LawTable<ConductanceRow>& conductanceLaws()
{
	static const LawTable<ConductanceRow> table { "conductanceLaw",
		{
		        { "fourSpheres",
		                "C~ A^2 w/(2r mu), C~ of the duct between four spheres (Jain & Juanes 2008, Eq. 9)",
		                "all gaps, closed at -2r", fourSpheres, meanRadius, false },
		        { "constantShape", "the same with C~ = 0.026, that about contact",
		                "gaps of some percent of the radius", constantShape, meanRadius, false },
		        { "inscribedCircle",
		                "a pipe as wide as the inscribed sphere, (pi/8) r_in^4 w/(2r mu) (Poiseuille)",
		                "all gaps, closed at -2r", inscribedCircle, meanRadius, false },
		        { "parallelPlates",
		                "a slit that its contact's force closes, w a^3/(12 mu) (Al-Busaidi et al. 2005)",
		                "all gaps", parallelPlates, meanRadius, true },
		        { "lubrication",
		                "flow in the plane between true disks, 2 L w d^(5/2)/(9 pi mu sqrt(R*)) (Gebart 1992)",
		                "gaps well below the radius, closed in contact", lubrication, harmonicRadius, false },
		} };
	return table;
}

double meanRadius(double a, double b) { return 0.5 * (a + b); }

double harmonicRadius(double a, double b) { return 2 * a * b / (a + b); }

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

double conductance(const ConductanceRow& law, double gap, double r, double viscosity, double thickness,
        const ThroatDetails& details, double factor)
{
	checkThroat(gap, r);
	checkPositive("viscosity [Pa s]", viscosity);
	checkPositive("thickness [m]", thickness);
	checkNotNegative("conductance factor [-]", factor);
	return law.conductance(factor * thickness / viscosity, gap, r, details);
}

} // namespace capfrac
