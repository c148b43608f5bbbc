// SPDX-License-Identifier: GPL-2.0-or-later
/// laws/EntryPressure: Eq. 15 and the MS-P law against exact values and a printed table.

#include "laws/EntryPressure.hpp"
#include "geometry/Shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace capfrac {

namespace {

	/// Columns of an independent finite-element table, for radius and tension one, as
	/// printed there: four decimals of the radius, three of the pressures. Three of the MS-P values are not
	/// the notes' own: these print 8.325, 4.908 and 2.843, where the balance of the gas in the picture, solved
	/// by itself (quarterImbalance below), gives 8.32568, 4.90861 and 2.84240.
	struct Row {
		double e; ///< gap over twice the radius [-]
		double inscribedRadius, inscribedSphere, mayerStowePrincen;
	};

	constexpr Row table[] = {
		{ -0.30, 0.2207, 9.064, 8.326 },
		{ -0.20, 0.2806, 7.127, 6.605 },
		{ -0.10, 0.3454, 5.791, 5.389 },
		{ -0.05, 0.3793, 5.273, 4.909 },
		{ -0.02, 0.4001, 4.998, 4.652 },
		{ 0.00, 0.4142, 4.828, 4.492 },
		{ 0.02, 0.4284, 4.668, 4.341 },
		{ 0.05, 0.4500, 4.444, 4.129 },
		{ 0.10, 0.4866, 4.110, 3.809 },
		{ 0.20, 0.5620, 3.558, 3.274 },
		{ 0.30, 0.6401, 3.124, 2.842 },
		{ 0.50, 0.8028, 2.491, 2.000 },
		{ 1.00, 1.2361, 1.618, 1.000 },
	};

	/// Half of the last printed digit, and a little for the binary image of the printed number.
	double halfDigit(double digit) { return 0.5 * digit + 1e-12; }

	template <class Call> std::string messageOf(Call call)
	{
		try {
			call();
		} catch (const EntryLawError& error) {
			return error.what();
		}
		return "no EntryLawError";
	}

	void expectMessage(const std::string& message, const std::string& part)
	{
		EXPECT_NE(message.find(part), std::string::npos) << message;
	}

	/// Adds the arc from angle `from` to angle `to` and returns its length, both as a chain of chords.
	double addArc(std::vector<Vec2>& outline, Vec2 centre, double radius, double from, double to)
	{
		const int nChords = 1000;
		for (int i = 0; i <= nChords; ++i) {
			const double angle = from + (to - from) * i / nChords;
			outline.push_back(centre + radius * Vec2 { std::cos(angle), std::sin(angle) });
		}
		return nChords * 2 * radius * std::sin(0.5 * std::abs(to - from) / nChords);
	}

	/// MS-P from the picture: outline of the gas in a quarter of the throat, one grain of radius one about
	/// the origin, the middle of the throat at (1, 1 + gap/2). Returns the gas area less rc x its perimeter,
	/// relative to the area.
	double quarterImbalance(double gap, double rc)
	{
		const Vec2 middle { 1, 1 + 0.5 * gap };
		const Vec2 below { middle.x, std::sqrt((1 + rc) * (1 + rc) - middle.x * middle.x) };
		const Vec2 beside { std::sqrt((1 + rc) * (1 + rc) - middle.y * middle.y), middle.y };
		const double toBelow = std::atan2(below.y, below.x), toBeside = std::atan2(beside.y, beside.x);
		std::vector<Vec2> outline { middle };
		double perimeter = addArc(outline, beside, rc, M_PI, M_PI + toBeside);
		perimeter += addArc(outline, { 0, 0 }, 1, toBeside, toBelow);
		perimeter += addArc(outline, below, rc, M_PI + toBelow, 1.5 * M_PI);
		double area = 0;
		for (std::size_t k = 0; k < outline.size(); ++k)
			area += 0.5 * cross(outline[k], outline[(k + 1) % outline.size()]);
		return (area - rc * perimeter) / area;
	}

} // namespace

TEST(InscribedSphere, ExactValuesAtContact)
{
	const double tension = 0.05;
	for (double r : { 1e-3, 1.5e-3, 2e-3, 1e-6 }) {
		const double exact = 2 * tension / (r * (std::sqrt(2) - 1));
		// sqrt(2) - 1 loses about one bit on both sides.
		EXPECT_NEAR(inscribedSphereEntryPressure(0, r, tension, 0), exact, 1e-12 * exact);
	}
	EXPECT_NEAR(inscribedSphereEntryPressure(0, 1e-3, tension, 0), 241.421356237, 5e-10);
	EXPECT_NEAR(inscribedSphereEntryPressure(0, 1.5e-3, tension, 0), 160.9476,
	        halfDigit(1e-4)); // the notes cut it off at 160.9
	EXPECT_NEAR(inscribedSphereEntryPressure(0, 2e-3, tension, 0), 120.7, halfDigit(0.1));
}

TEST(InscribedSphere, Table)
{
	for (const Row& row : table) {
		EXPECT_NEAR(inscribedRadius(2 * row.e, 1), row.inscribedRadius, halfDigit(1e-4)) << "e = " << row.e;
		EXPECT_NEAR(inscribedSphereEntryPressure(2 * row.e, 1, 1, 0), row.inscribedSphere, halfDigit(1e-3))
		        << "e = " << row.e;
	}
}

TEST(InscribedSphere, TouchesTheFourSpheres)
{
	// Half of the diagonal of 2r x (2r + d) is what sphere and grain fill together.
	for (double r : { 1.0, 2e-3, 3e-6 })
		for (double e = -0.95; e < 3; e += 0.05)
			EXPECT_NEAR(inscribedRadius(2 * e * r, r) + r, 0.5 * std::hypot(2 * r, 2 * r * (1 + e)),
			        1e-15 * 4 * r);
}

TEST(MayerStowePrincen, Table)
{
	for (const Row& row : table)
		EXPECT_NEAR(mayerStowePrincenEntryPressure(2 * row.e, 1, 1, 0), row.mayerStowePrincen, halfDigit(1e-3))
		        << "e = " << row.e;
}

TEST(MayerStowePrincen, BalancesTheGasInThePicture)
{
	// Chords in place of arcs: error angle^2/24 / 1000^2 < 1e-7 of every length and area.
	for (double e = -0.8; e < 0.45; e += 0.05)
		EXPECT_NEAR(quarterImbalance(2 * e, 1 / mayerStowePrincenEntryPressure(2 * e, 1, 1, 0)), 0, 1e-6)
		        << "e = " << e;
}

TEST(MayerStowePrincen, TurnsIntoASheetWithoutAJump)
{
	double previous = mayerStowePrincenEntryPressure(2 * -0.9, 1, 1, 0);
	for (double e = -0.899; e < 1.5; e += 0.001) {
		const double now = mayerStowePrincenEntryPressure(2 * e, 1, 1, 0);
		EXPECT_LT(now, previous) << "e = " << e;
		// P falls like (1+e)^-2 where a throat is nearly closed and like 1/e in the end; twice that slope
		// is allowed, so that a jump of half a percent would show.
		EXPECT_LT(previous - now, 0.001 * 4 / (1 + e) * now) << "e = " << e;
		EXPECT_LT(now, inscribedSphereEntryPressure(2 * e, 1, 1, 0)) << "e = " << e;
		if (e > 0.55) {
			EXPECT_NEAR(now, 1 / e, 1e-14 / e);
		}
		previous = now;
	}
}

TEST(EntryPressure, ScalesWithTensionOverLength)
{
	for (auto law : { EntryLaw::inscribedSphere, EntryLaw::mayerStowePrincen })
		for (double e : { -0.3, 0.0, 0.2, 0.8 }) {
			const double unit = entryPressure(law, 2 * e, 1, 1, 0);
			for (double r : { 1e-3, 2e-6 }) // MS-P is the root of a bisection to 50 bits
				EXPECT_NEAR(entryPressure(law, 2 * e * r, r, 0.05, 0), unit * 0.05 / r,
				        1e-13 * unit * 0.05 / r);
		}
}

TEST(EntryPressure, ContactAngle)
{
	for (double angle : { 0.0, 0.3, M_PI / 3, 1.5 }) {
		const double wetting = inscribedSphereEntryPressure(1e-4, 1e-3, 0.07, 0);
		EXPECT_NEAR(entryPressure(EntryLaw::inscribedSphere, 1e-4, 1e-3, 0.07, angle),
		        wetting * std::cos(angle), 1e-15 * wetting);
	}
}

TEST(EntryPressure, ChoosesTheLawByName)
{
	EXPECT_EQ(entryLawFromName("inscribedSphere"), EntryLaw::inscribedSphere);
	EXPECT_EQ(entryLawFromName("mayerStowePrincen"), EntryLaw::mayerStowePrincen);
	EXPECT_EQ(entryPressure(EntryLaw::inscribedSphere, 0.1, 1, 1, 0), inscribedSphereEntryPressure(0.1, 1, 1, 0));
	EXPECT_EQ(
	        entryPressure(EntryLaw::mayerStowePrincen, 0.1, 1, 1, 0), mayerStowePrincenEntryPressure(0.1, 1, 1, 0));
	try {
		entryLawFromName("purcell");
		ADD_FAILURE() << "no error";
	} catch (const std::invalid_argument& error) {
		EXPECT_EQ(error.what(), "entryLaw = 'purcell', allowed: " + entryLaws().names());
	}
	EXPECT_EQ(entryLaws().names().find("'inscribedSphere', 'mayerStowePrincen'"), 0u);
}

TEST(EntryPressureErrors, NameTheValueAndWhatIsAllowed)
{
	const double nan = std::nan("");
	for (auto law : { EntryLaw::inscribedSphere, EntryLaw::mayerStowePrincen }) {
		auto message = [law](double gap, double r, double tension, double angle) {
			return messageOf([=] { entryPressure(law, gap, r, tension, angle); });
		};
		expectMessage(message(-2, 1, 1, 0),
		        "gap of the throat [m] = -2, allowed: > -2 (minus twice the mean radius): the throat is "
		        "closed");
		expectMessage(message(-2.5, 1, 1, 0), "gap of the throat [m] = -2.5");
		expectMessage(message(nan, 1, 1, 0), "gap of the throat [m] = nan");
		expectMessage(message(0, 0, 1, 0), "mean radius of the throat [m] = 0, allowed: > 0");
		expectMessage(message(0, -1, 1, 0), "mean radius of the throat [m] = -1");
		expectMessage(message(0, nan, 1, 0), "mean radius of the throat [m] = nan");
		expectMessage(message(0, 1, 0, 0), "interfacial tension [N/m] = 0, allowed: > 0");
		expectMessage(message(0, 1, -0.05, 0), "interfacial tension [N/m] = -0.05");
		expectMessage(message(0, 1, nan, 0), "interfacial tension [N/m] = nan");
		expectMessage(message(0, 1, 1, M_PI / 2), "contact angle [rad] = 1.570796327, allowed");
		expectMessage(message(0, 1, 1, -0.1), "contact angle [rad] = -0.1, allowed");
		expectMessage(message(0, 1, 1, nan), "contact angle [rad] = nan, allowed");
	}
	expectMessage(messageOf([] { mayerStowePrincenEntryPressure(0, 1, 1, 0.2); }),
	        "contact angle [rad] = 0.2, allowed: 0 (the mayerStowePrincen law is for perfect wetting)");
	expectMessage(messageOf([] { inscribedRadius(-2, 1); }), "the throat is closed");
}

} // namespace capfrac
