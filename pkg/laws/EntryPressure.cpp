// SPDX-License-Identifier: GPL-2.0-or-later
#include "EntryPressure.hpp"
#include "Refusal.hpp"

#include <boost/math/tools/roots.hpp>

#include <cmath>
#include <sstream>

namespace capfrac {

namespace {

	// Written so that NaN fails every test.
	void checkThroat(double gap, double r)
	{
		if (!(r > 0)) refuse<EntryLawError>("mean radius of the throat [m]", r, "> 0");
		if (!(gap > -2 * r)) {
			std::ostringstream allowed;
			allowed << "> " << -2 * r << " (minus twice the mean radius): the throat is closed";
			refuse<EntryLawError>("gap of the throat [m]", gap, allowed.str());
		}
	}

	void checkTension(double tension)
	{
		if (!(tension > 0)) refuse<EntryLawError>("interfacial tension [N/m]", tension, "> 0");
	}

	/// Water wedge between two circles of radius r whose centres are 2 halfBase apart, cut off by a
	/// meniscus of radius rc that touches both; everything for one side of the line of centres.
	struct Wedge {
		double liquidAndGrains; ///< area between the line of centres and the meniscus that is no gas
		double meniscus;        ///< length of the arc
		double wetted;          ///< angle that each circle loses to the wedge
	};

	Wedge wedge(double halfBase, double r, double rc)
	{
		const double hypotenuse = r + rc;
		const double angle = std::acos(std::min(1.0, halfBase / hypotenuse));
		const double height = hypotenuse * std::sin(angle);
		const double halfArc = M_PI / 2 - angle;
		return { halfBase * height - rc * rc * halfArc, 2 * rc * halfArc, angle };
	}

	/// Free area less rc times the free perimeter, for menisci of radius rc in all four wedges. The
	/// overlap of grains needs no term of its own: it lies below the menisci.
	double mayerStowePrincenBalance(double gap, double r, double rc)
	{
		const Wedge outOfPlane = wedge(r, r, rc), inPlane = wedge(r + 0.5 * gap, r, rc);
		const double freeAngle = M_PI / 2 - outOfPlane.wetted - inPlane.wetted; // of each quarter of a grain
		const double area = 2 * r * (2 * r + gap) - 2 * (outOfPlane.liquidAndGrains + inPlane.liquidAndGrains)
		        - 2 * r * r * freeAngle;
		const double perimeter = 2 * (outOfPlane.meniscus + inPlane.meniscus) + 4 * r * freeAngle;
		return area - rc * perimeter;
	}

} // namespace

const LawTable<EntryLawRow>& entryLaws()
{
	static const LawTable<EntryLawRow> table { "entryLaw",
		{
		        { "inscribedSphere",
		                "sphere through the throat, 2 gamma cos(theta)/r_in (Jain & Juanes 2008, Eq. 15)",
		                "open throats, contact angles below 90 degrees", inscribedSphereEntryPressure, true },
		        { "mayerStowePrincen",
		                "work of the meniscus against that of the surfaces behind it (Mayer & Stowe 1965)",
		                "open throats, contact angle 0", mayerStowePrincenEntryPressure, false },
		} };
	return table;
}

double inscribedRadius(double gap, double r)
{
	checkThroat(gap, r);
	const double ratio = 1 + gap / (2 * r);
	return r * (std::sqrt(1 + ratio * ratio) - 1);
}

double inscribedSphereEntryPressure(double gap, double r, double tension, double contactAngle)
{
	checkTension(tension);
	if (!(contactAngle >= 0 && contactAngle < M_PI / 2))
		refuse<EntryLawError>("contact angle [rad]", contactAngle, "0 <= angle < pi/2 (water wets)");
	return 2 * tension * std::cos(contactAngle) / inscribedRadius(gap, r);
}

double mayerStowePrincenEntryPressure(double gap, double r, double tension, double contactAngle)
{
	checkTension(tension);
	if (contactAngle != 0)
		refuse<EntryLawError>(
		        "contact angle [rad]", contactAngle, "0 (the mayerStowePrincen law is for perfect wetting)");
	// The menisci fit between two limits: so small that they bridge the gap just at its narrowest, and
	// so large that the four of them meet, at the inscribed sphere.
	const double widest = inscribedRadius(gap, r);
	const double narrowest = std::max(0.5 * gap, 1e-9 * widest);
	if (narrowest >= widest || mayerStowePrincenBalance(gap, r, narrowest) <= 0)
		return 2 * tension / gap; // a sheet
	const auto root = boost::math::tools::bisect([=](double rc) { return mayerStowePrincenBalance(gap, r, rc); },
	        narrowest, widest, boost::math::tools::eps_tolerance<double>(50));
	return tension / (0.5 * (root.first + root.second));
}

} // namespace capfrac
