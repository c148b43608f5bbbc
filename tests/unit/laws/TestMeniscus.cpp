// SPDX-License-Identifier: GPL-2.0-or-later
/// laws/Meniscus: forces against the formulas as they are printed, energies against quadrature.

#include "laws/Meniscus.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace capfrac {

namespace {

	const double w = 0.7; // not one, so that it is not forgotten

	Menisci constantMenisci() { return { MeniscusLaw::constant, 0.05, 0, 10, 0.01, 0.1 }; }
	Menisci bridges(double angle = 0, double volume = 0.01)
	{
		return { MeniscusLaw::bridge, 0.05, angle, 10, volume, -1 };
	}

	/// Rabinovich's form, for spheres of radius R a gap H > 0 apart: 2 pi R gamma cos(theta)/(1 + H/(2 d)).
	double printedForce(double gap, double radius, double tension, double angle, double volume)
	{
		const double d = 0.5 * gap * (-1 + std::sqrt(1 + 2 * volume / (M_PI * radius * gap * gap)));
		return 2 * M_PI * radius * tension * std::cos(angle) / (1 + gap / (2 * d));
	}

	template <class Call> std::string messageOf(Call call)
	{
		try {
			call();
		} catch (const MeniscusError& error) {
			return error.what();
		}
		return "no MeniscusError";
	}

	void expectMessage(const std::string& message, const std::string& part)
	{
		EXPECT_NE(message.find(part), std::string::npos) << message;
	}

} // namespace

TEST(ConstantMeniscus, IsThePapersStrengthTimesItsArea)
{
	// sigma_c 2 r w with sigma_c = chi gamma/r and the mean radius: 2 chi gamma w for any grains.
	for (auto [r1, r2] : { std::pair(1e-3, 1e-3), std::pair(1e-6, 3e-6) })
		for (double gap : { -0.01, 0.0, 0.05 }) {
			const double mean = 0.5 * (r1 + r2);
			EXPECT_DOUBLE_EQ(meniscusForce(constantMenisci(), gap * mean, r1, r2, w),
			        (10 * 0.05 / mean) * 2 * mean * w);
		}
}

TEST(BridgeMeniscus, PullsAtContactWithHalfPiTensionOverRadius)
{
	// (pi/2) gamma/r as a stress over 2 r w, cos(theta) times that.
	for (double r : { 1e-3, 1e-6 })
		for (double angle : { 0.0, 0.5 })
			EXPECT_NEAR(meniscusForce(bridges(angle), 0, r, r, w) / (2 * r * w),
			        0.5 * M_PI * 0.05 / r * std::cos(angle), 1e-15 * 0.05 * M_PI / r);
}

TEST(BridgeMeniscus, IsThePrintedFormulaPerLayer)
{
	const double r1 = 1e-3, r2 = 1.7e-3, mean = 0.5 * (r1 + r2), derjaguin = 2 * r1 * r2 / (r1 + r2);
	for (double angle : { 0.0, 0.4 })
		for (double volume : { 1e-4, 1e-2, 0.1 })
			for (double gap : { 1e-5, 1e-3, 0.02, 0.2 }) {
				const double printed =
				        printedForce(gap * mean, derjaguin, 0.05, angle, volume * mean * mean * mean)
				        * w / (2 * mean);
				// The printed form takes the difference of a root and 1, as small as b^2/(2 H^2),
				// b^2/H^2 > 2e-3: some 1e3 epsilon.
				EXPECT_NEAR(meniscusForce(bridges(angle, volume), gap * mean, r1, r2, w), printed,
				        1e-12 * printed);
			}
}

TEST(MeniscusForce, IsTheSameFromBothSidesAndSteadyAtContact)
{
	for (const auto& menisci : { constantMenisci(), bridges(0.3) }) {
		EXPECT_EQ(meniscusForce(menisci, 1e-5, 1e-3, 2e-3, w), meniscusForce(menisci, 1e-5, 2e-3, 1e-3, w));
		const double atContact = meniscusForce(menisci, 0, 1e-3, 2e-3, w);
		EXPECT_EQ(meniscusForce(menisci, -1e-5, 1e-3, 2e-3, w), atContact);
		// b = sqrt(2 V/(pi R)) = 1e-4 m here: a gap of 1e-16 m changes the force by 1e-12 of it.
		EXPECT_NEAR(meniscusForce(menisci, 1e-16, 1e-3, 2e-3, w), atContact, 2e-12 * atContact);
	}
}

TEST(MeniscusEnergy, IsTheWorkUpToTheRuptureGap)
{
	using boost::math::quadrature::gauss_kronrod;
	const double r1 = 1e-3, r2 = 1.7e-3, mean = 0.5 * (r1 + r2);
	for (const auto& menisci : { constantMenisci(), bridges(), bridges(0.4, 0.1), bridges(0, 1e-4) }) {
		const double end = ruptureGap(menisci, r1, r2);
		EXPECT_NEAR(
		        meniscusEnergy(menisci, end, r1, r2, w), 0, 1e-15 * meniscusForce(menisci, 0, r1, r2, w) * end);
		for (double gap : { -0.02 * mean, 0.0, 0.1 * end, 0.7 * end }) {
			auto force = [&](double h) { return meniscusForce(menisci, h, r1, r2, w); };
			const double work = (gap < 0 ? -gap * force(0) : 0)
			        + gauss_kronrod<double, 31>::integrate(force, std::max(gap, 0.0), end, 15, 1e-13);
			// The energy is a difference of lengths as large as the rupture gap: round-off of some epsilon
			// F H_r.
			EXPECT_NEAR(meniscusEnergy(menisci, gap, r1, r2, w), -work, 1e-12 * force(0) * end);
		}
	}
}

TEST(MeniscusEnergy, HasTheForceAsItsSlope)
{
	const double r1 = 1e-3, r2 = 1.7e-3, mean = 0.5 * (r1 + r2), h = 1e-6 * mean;
	for (const auto& menisci : { constantMenisci(), bridges(0.4) })
		for (double gap : { -0.01, 0.01, 0.1, 0.2 }) {
			auto energy = [&](double H) { return meniscusEnergy(menisci, H, r1, r2, w); };
			const double slope = (energy(gap * mean + h) - energy(gap * mean - h)) / (2 * h);
			const double force = meniscusForce(menisci, gap * mean, r1, r2, w);
			// Truncation h^2/6 U''' ~ (h/b)^2 = 1e-10 F(0); round-off epsilon F(0) H_r/h ~ 1e-10 F(0).
			EXPECT_NEAR(slope, force, 1e-9 * meniscusForce(menisci, 0, r1, r2, w));
		}
}

TEST(MeniscusRupture, FollowsLianOrTheGivenGap)
{
	EXPECT_DOUBLE_EQ(lianRuptureGap(0.008, 0), 0.2);
	EXPECT_DOUBLE_EQ(lianRuptureGap(0.008, 1.0), 0.3);
	EXPECT_DOUBLE_EQ(ruptureGap(bridges(1.0, 0.008), 1e-3, 2e-3), 0.3 * 1.5e-3);
	EXPECT_DOUBLE_EQ(ruptureGap(constantMenisci(), 1e-3, 2e-3), 0.1 * 1.5e-3);
}

TEST(MeniscusErrors, NameTheValueAndWhatIsAllowed)
{
	const double nan = std::numeric_limits<double>::quiet_NaN();
	auto with = [&](auto change) {
		auto menisci = bridges();
		change(menisci);
		return messageOf([&] { meniscusForce(menisci, 0, 1e-3, 1e-3, w); });
	};
	expectMessage(
	        with([](Menisci& m) { m.tension = 0; }), "interfacial tension [N/m] = 0, allowed: finite and > 0");
	expectMessage(with([&](Menisci& m) { m.contactAngle = nan; }), "contact angle [rad] = nan");
	expectMessage(with([](Menisci& m) { m.contactAngle = 1.6; }),
	        "contact angle [rad] = 1.6, allowed: 0 <= angle < pi/2");
	expectMessage(with([](Menisci& m) { m.chi = -1; }), "chi [-] = -1");
	expectMessage(
	        with([](Menisci& m) { m.bridgeVolume = 0; }), "bridge volume over the cube of the radius [-] = 0");
	expectMessage(with([&](Menisci& m) { m.ruptureGap = nan; }),
	        "rupture gap over the radius [-] = nan, allowed: finite");
	expectMessage(
	        messageOf([&] { meniscusForce(bridges(), nan, 1e-3, 1e-3, w); }), "gap [m] = nan, allowed: finite");
	expectMessage(messageOf([&] { meniscusEnergy(bridges(), 0, 0, 1e-3, w); }), "radius [m] = 0");
	expectMessage(messageOf([&] { meniscusEnergy(bridges(), 0, 1e-3, 1e-3, -1); }), "thickness [m] = -1");
	EXPECT_EQ(meniscusLawFromName("constant"), MeniscusLaw::constant);
	EXPECT_EQ(meniscusLawFromName("bridge"), MeniscusLaw::bridge);
	EXPECT_THROW(meniscusLawFromName("none"), std::invalid_argument);
}

} // namespace capfrac
