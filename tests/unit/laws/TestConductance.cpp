// SPDX-License-Identifier: GPL-2.0-or-later
/// laws/Conductance: the duct between four spheres against a table, limits, scaling, errors.

#include "laws/Conductance.hpp"
#include "laws/EntryPressure.hpp"
#include "geometry/Shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace capfrac {

namespace {

	constexpr ConductanceLaw allLaws[] { ConductanceLaw::fourSpheres, ConductanceLaw::constantShape,
		ConductanceLaw::inscribedCircle, ConductanceLaw::parallelPlates, ConductanceLaw::lubrication };

	/// Duct between four spheres of radius one: finite elements on a mesh of 160 x 80, coarser than that of
	/// the fits. Four decimals of A, six of g = C~ A^2.
	struct Row {
		double e, area, g;
	};
	constexpr Row table[] {
		{ -0.30, 0.2494, 0.001626 },
		{ -0.20, 0.3854, 0.004075 },
		{ -0.10, 0.5759, 0.009228 },
		{ -0.05, 0.7003, 0.013484 },
		{ -0.02, 0.7891, 0.016800 },
		{ 0.00, 0.8585, 0.019401 },
		{ 0.02, 0.9385, 0.022366 },
		{ 0.05, 1.0585, 0.027613 },
		{ 0.10, 1.2585, 0.038972 },
		{ 0.20, 1.6585, 0.074946 },
		{ 0.30, 2.0585, 0.135437 },
		{ 0.50, 2.8585, 0.363693 },
		{ 1.00, 4.8585, 1.940773 },
	};

	template <class Call> std::string messageOf(Call call)
	{
		try {
			call();
		} catch (const std::exception& error) {
			return error.what();
		}
		return "no error";
	}

	void expectMessage(const std::string& message, const std::string& start)
	{
		EXPECT_EQ(message.substr(0, start.size()), start) << message;
	}

	/// Half of the slit's aperture at contact, so that every law conducts something.
	ThroatDetails details(double length)
	{
		ThroatDetails d;
		d.length = length;
		d.plates.residual = 0.1 * length;
		return d;
	}

} // namespace

TEST(ThroatArea, Table)
{
	for (const Row& row : table)
		// The area is that of the mesh: chords in place of arcs leave 0.93e-4 more open, since
		// 4 - pi = 0.8584 at e = 0; and half of the last digit.
		EXPECT_NEAR(throatArea(2 * row.e, 1), row.area, 1.5e-4) << "e = " << row.e;
}

TEST(ThroatArea, IsWhatTheSpheresLeaveOpen)
{
	// Midpoint sums of 4 (1 - sqrt(1 - y^2)) up to c, and the rest of the slot: error h^2/24 times the
	// jump of the slope, which grows like 1/sqrt(h) at y = 1: below h^1.5 = 3e-8 for h = 1e-5.
	for (double c : { 0.3, 0.69, 0.9, 1.0, 1.4 }) {
		const int n = 100000;
		double sum = 0;
		for (int i = 0; i < n; ++i) {
			const double y = (i + 0.5) / n * std::min(c, 1.0);
			sum += 4 * (1 - std::sqrt(1 - y * y)) * std::min(c, 1.0) / n;
		}
		EXPECT_NEAR(throatArea(2 * (c - 1), 1), sum + 4 * std::max(0.0, c - 1), 1e-7) << "c = " << c;
	}
}

TEST(ThroatArea, ClosesWithoutAJump)
{
	EXPECT_EQ(throatArea(-2, 1), 0);
	EXPECT_EQ(throatArea(-2.5, 1), 0);
	for (double c :
	        { 1e-8, 1e-4, 3e-3 }) // the slit of parabolic width: 2/3 c^3 (1 + 3/20 c^2); gap + 2 keeps eps/c
		EXPECT_NEAR(throatArea(2 * (c - 1), 1) / (2.0 / 3 * c * c * c), 1, 0.2 * c * c + 4 * 2.3e-16 / c);
	// From the series to the closed form, whose terms of size one cancel to 7e-7: 10 eps of them remain.
	EXPECT_NEAR(throatArea(2 * (0.01 - 1e-12 - 1), 1), throatArea(2 * (0.01 + 1e-12 - 1), 1), 1e-15);
}

TEST(ShapeFactor, Table)
{
	// The fits' 0.4 %, and 0.05 % of the table (its coarser mesh, half of the last digit of the first row).
	for (const Row& row : table)
		EXPECT_NEAR(shapeFactor(2 * row.e, 1) * std::pow(throatArea(2 * row.e, 1), 2), row.g, 4.5e-3 * row.g)
		        << "e = " << row.e;
}

TEST(ShapeFactor, LimitsOutsideOfTheTable)
{
	EXPECT_EQ(shapeFactor(-2, 1), 0);
	EXPECT_EQ(shapeFactor(-3, 1), 0);
	// C~ = (3/56) c where the slit closes; the fit meets that within 0.4 %, its next term is 1.7 c^2.
	for (double c : { 1e-6, 1e-2 })
		EXPECT_NEAR(shapeFactor(2 * (c - 1), 1), 3.0 / 56 * c, 4.5e-3 * 3.0 / 56 * c);
	// Finite elements beyond the table, 120 x 240 and extrapolated: C~ A^2 and C~.
	EXPECT_NEAR(shapeFactor(2 * -0.9, 1), 0.00527177, 4.5e-3 * 0.00527);
	EXPECT_NEAR(shapeFactor(2 * -0.5, 1), 0.02152712, 4.5e-3 * 0.0215);
	EXPECT_NEAR(shapeFactor(2 * 3.0, 1) * std::pow(throatArea(6, 1), 2), 40.60865, 4.5e-3 * 40.6);
	EXPECT_NEAR(shapeFactor(2 * 10.0, 1) * std::pow(throatArea(20, 1), 2), 1381.546, 4.5e-3 * 1381);
}

TEST(ShapeFactor, HasNoJumpWhereTheFitsMeet)
{
	for (double e : { -0.3, 0.0, 0.5 }) // slopes of C~ are of order 0.05: 2e-10 apart, 1e-11 in C~
		EXPECT_NEAR(shapeFactor(2 * (e - 1e-10), 1), shapeFactor(2 * (e + 1e-10), 1), 4e-11) << "e = " << e;
}

TEST(Conductance, IsEquationNine)
{
	const double r = 2e-3, gap = 4e-4, mu = 1.3e-3, w = 0.7; // e = 0.1
	// Half a percent for the fit.
	EXPECT_NEAR(conductance(ConductanceLaw::fourSpheres, gap, r, mu, w), 0.038972 * r * r * r * w / (2 * mu),
	        5e-3 * 0.039 * r * r * r * w / (2 * mu));
	const double area = (4 * 1.1 - M_PI) * r * r;
	const double constant = 0.026 * area * area * w / (2 * r * mu);
	EXPECT_NEAR(conductance(ConductanceLaw::constantShape, gap, r, mu, w), constant, 1e-14 * constant);
	const double circle = M_PI / 8 * std::pow(inscribedRadius(gap, r), 4) * w / (2 * r * mu);
	EXPECT_NEAR(conductance(ConductanceLaw::inscribedCircle, gap, r, mu, w), circle, 1e-14 * circle);
}

/// C~ A^2 of one throat grows with r^4 and w/(2r) of them lie one behind the other: all lengths but the
/// thickness times ten make C thousandfold, and with L the permeability a hundredfold, but for rounding.
TEST(Conductance, ScalesWithTheCubeOfLengths)
{
	for (auto law : allLaws)
		for (double e : { -0.5, -0.1, 0.0, 0.1, 0.7, 2.0 }) {
			const double small = conductance(law, 2e-3 * e, 1e-3, 1e-3, 1, details(2e-3));
			const double large = conductance(law, 2e-2 * e, 1e-2, 1e-3, 1, details(2e-2));
			EXPECT_NEAR(large, 1000 * small, 1e-12 * large)
			        << "law " << static_cast<int>(law) << ", e = " << e;
			EXPECT_EQ(small > 0, law != ConductanceLaw::lubrication || e > 0);
		}
	// C~ A^2 itself goes with r^4.
	const double one = shapeFactor(0.02, 1e-2) * std::pow(throatArea(0.02, 1e-2), 2);
	EXPECT_NEAR(shapeFactor(2, 1) * std::pow(throatArea(2, 1), 2), 1e8 * one, 1e-12 * 1e8 * one);
}

TEST(Conductance, IsProportionalToFluidityThicknessAndFactor)
{
	for (auto law : allLaws) {
		const double unit = conductance(law, 1e-4, 1e-3, 1, 1, details(2e-3));
		EXPECT_NEAR(conductance(law, 1e-4, 1e-3, 2e-3, 0.3, details(2e-3), 0.32), unit * 0.3 * 0.32 / 2e-3,
		        1e-14 * unit * 48);
		EXPECT_EQ(conductance(law, 1e-4, 1e-3, 1, 1, details(2e-3), 0), 0);
	}
}

TEST(Conductance, GrowsWithTheGapAndClosesAtLast)
{
	for (auto law :
	        { ConductanceLaw::fourSpheres, ConductanceLaw::constantShape, ConductanceLaw::inscribedCircle }) {
		EXPECT_EQ(conductance(law, -2, 1, 1, 1), 0);
		EXPECT_EQ(conductance(law, -2.1, 1, 1, 1), 0);
		double before = 0;
		for (double e = -0.99; e < 3; e += 0.01) {
			const double now = conductance(law, 2 * e, 1, 1, 1);
			EXPECT_GT(now, before) << "law " << static_cast<int>(law) << ", e = " << e;
			before = now;
		}
	}
}

TEST(ParallelPlates, CloseUnderForce)
{
	const PlateAperture plates { 2e-5, 300, 0.5 };
	EXPECT_EQ(plateAperture(0, 0, plates), 2e-5);
	EXPECT_EQ(plateAperture(-1e-6, 300, plates), 1e-5);
	EXPECT_NEAR(plateAperture(-1e-6, 2700, plates), 2e-6, 1e-20);
	EXPECT_EQ(plateAperture(4e-5, 0, plates), 4e-5);
	ThroatDetails d;
	d.normalForce = 300, d.plates = plates;
	EXPECT_NEAR(
	        conductance(ConductanceLaw::parallelPlates, -1e-6, 1e-3, 1e-3, 2, d), 2 * 1e-15 / 12e-3, 1e-14 * 2e-13);
}

TEST(Lubrication, IntegratesTheGap)
{
	// Pressure gradients 12 mu q/(w h^3) between two disks, h = d + x^2/R*, summed over the whole line;
	// the trapezoidal rule on a smooth peak that decays like x^-6 is exact to the tail, (d/X^2)^2.5.
	const double d = 1e-5, ra = 1e-3, rb = 3e-3, harmonic = 2 * ra * rb / (ra + rb), mu = 2e-3, w = 0.5,
	             length = 4e-3;
	const double scale = std::sqrt(d * harmonic), dx = 0.01 * scale;
	double resistance = 0;
	for (int i = -20000; i <= 20000; ++i)
		resistance += 12 * mu / w * dx / std::pow(d + i * dx * i * dx / harmonic, 3);
	ThroatDetails throat;
	throat.length = length;
	const double c = conductance(ConductanceLaw::lubrication, d, harmonic, mu, w, throat);
	EXPECT_NEAR(c / length * resistance, 1, 1e-10);
	throat.length = 2 * length; // the resistance is in the gap
	EXPECT_NEAR(conductance(ConductanceLaw::lubrication, d, harmonic, mu, w, throat), 2 * c, 1e-14 * c);
	EXPECT_EQ(conductance(ConductanceLaw::lubrication, 0, harmonic, mu, w, throat), 0);
	EXPECT_EQ(conductance(ConductanceLaw::lubrication, -d, harmonic, mu, w, throat), 0);
}

TEST(ConductanceErrors, NameTheValueAndWhatIsAllowed)
{
	const double nan = std::nan("");
	for (auto law : allLaws) {
		auto message = [law](double gap, double r, double mu, double w, double factor) {
			return messageOf([=] { conductance(law, gap, r, mu, w, details(1), factor); });
		};
		expectMessage(message(0, 0, 1, 1, 1), "mean radius of the throat [m] = 0, allowed: > 0");
		expectMessage(message(0, -1, 1, 1, 1), "mean radius of the throat [m] = -1, allowed: > 0");
		expectMessage(message(0, nan, 1, 1, 1), "mean radius of the throat [m] = nan");
		expectMessage(message(nan, 1, 1, 1, 1), "gap of the throat [m] = nan, allowed: a finite number");
		expectMessage(message(0, 1, 0, 1, 1), "viscosity [Pa s] = 0, allowed: > 0");
		expectMessage(message(0, 1, -1e-3, 1, 1), "viscosity [Pa s] = -0.001, allowed: > 0");
		expectMessage(message(0, 1, nan, 1, 1), "viscosity [Pa s] = nan");
		expectMessage(message(0, 1, 1, 0, 1), "thickness [m] = 0, allowed: > 0");
		expectMessage(message(0, 1, 1, 1, -0.1), "conductance factor [-] = -0.1, allowed: >= 0");
	}
	expectMessage(messageOf([] { conductance(ConductanceLaw::lubrication, 1e-3, 1, 1, 1); }),
	        "length of the throat [m] = 0, allowed: > 0");
	expectMessage(messageOf([] { throatArea(0, -2); }), "mean radius of the throat [m] = -2");
	expectMessage(messageOf([] { shapeFactor(0, 0); }), "mean radius of the throat [m] = 0");
	expectMessage(
	        messageOf([] { plateAperture(0, -1, {}); }), "normal force of the contact [N] = -1, allowed: >= 0");
	expectMessage(messageOf([] {
		plateAperture(0, 1, { -1, 1, 1 });
	}),
	        "residual aperture [m] = -1, allowed: >= 0");
	expectMessage(messageOf([] {
		plateAperture(0, 1, { 1, 0, 1 });
	}),
	        "force that halves the aperture [N] = 0, allowed: > 0");
	expectMessage(messageOf([] {
		plateAperture(0, 1, { 1, 1, 1.5 });
	}),
	        "multiplier of the gap [-] = 1.5, allowed: 0 to 1");
}

TEST(Conductance, ChoosesTheLawByName)
{
	const char* names[] { "fourSpheres", "constantShape", "inscribedCircle", "parallelPlates", "lubrication" };
	for (int i = 0; i < 5; ++i)
		EXPECT_EQ(conductanceLawFromName(names[i]), allLaws[i]);
	EXPECT_THROW(conductanceLawFromName("darcy"), std::invalid_argument);
	EXPECT_EQ(messageOf([] { conductanceLawFromName("darcy"); })
	                  .find("conductanceLaw = 'darcy', allowed: 'fourSpheres', 'constantShape', 'inscribedCircle', "
	                        "'parallelPlates', 'lubrication'"),
	        0u);
}

} // namespace capfrac
