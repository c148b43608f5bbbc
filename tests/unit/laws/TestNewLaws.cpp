// SPDX-License-Identifier: GPL-2.0-or-later
/// laws/Laws: the tables of laws; and a law of each family that is added as doc/extending.md says.

#include "laws/Conductance.hpp"
#include "laws/EntryPressure.hpp"
#include "laws/EquationOfState.hpp"
#include "laws/Refusal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace capfrac {

namespace {

	template <class Call> std::string messageOf(Call call)
	{
		try {
			call();
		} catch (const std::exception& error) {
			return error.what();
		}
		return "no error";
	}

	// What doc/extending.md shows: a law is a function ...

	/// Gas enters an open gap as a sheet: 2 gamma cos(theta)/d.
	double sheetEntryPressure(double gap, double, double tension, double contactAngle)
	{
		if (!(gap > 0)) refuse<EntryLawError>("gap of the throat [m]", gap, "> 0");
		return 2 * tension * std::cos(contactAngle) / gap;
	}

	/// A slit as wide as the gap: w d^3/(12 mu).
	double openSlit(double scale, double gap, double, const ThroatDetails&)
	{
		return gap <= 0 ? 0 : scale * gap * gap * gap / 12;
	}

	constexpr double gasConstant = 8.31446261815324; // [J/(mol K)]
	constexpr double secondVirial = -43e-6;          // [m^3/mol], methane at room temperature

	/// rho = p M/(R T + B p).
	double virialDensity(const EquationOfState& gas, double pressure)
	{
		return pressure * gas.molarMass / (gasConstant * gas.temperature + secondVirial * pressure);
	}

	// ... and a row.

	const EntryLawRow sheet { "sheet", "a sheet in an open gap, 2 gamma cos(theta)/d", "open gaps",
		sheetEntryPressure, true };
	const ConductanceRow slit { "openSlit", "parallel plates a gap apart, w d^3/(12 mu)", "all gaps", openSlit,
		meanRadius, false };
	const GasLawRow virial = [] {
		GasLawRow law { "virial", "rho = p M/(R T + B p), B of methane", "pressures up to 10 MPa",
			virialDensity };
		law.highest = 1e7;
		return law;
	}();

	/// What holds of every table: names once, texts in one line.
	template <class Row> void expectSound(const LawTable<Row>& table)
	{
		std::set<std::string> names;
		int number = 0;
		for (const auto& law : table) {
			EXPECT_TRUE(names.insert(law.name).second) << law.name << " stands twice";
			EXPECT_EQ(static_cast<int>(table.fromName(law.name)), number++);
			EXPECT_NE(table.names().find("'" + std::string(law.name) + "'"), std::string::npos);
			for (const std::string text : { law.doc, law.range }) {
				EXPECT_FALSE(text.empty()) << law.name;
				EXPECT_EQ(text.find('\n'), std::string::npos) << law.name;
			}
		}
		EXPECT_EQ(table.listing().size(), names.size());
		EXPECT_THROW(table[static_cast<typename Row::Law>(number)], std::out_of_range);
	}

} // namespace

TEST(LawTables, AreSound)
{
	expectSound(entryLaws());
	expectSound(conductanceLaws());
	expectSound(gasLaws());
	expectSound(entryLaws().with(sheet));
	expectSound(conductanceLaws().with(slit));
	expectSound(gasLaws().with(virial));
}

TEST(LawTables, NameTheirLaws)
{
	const LawTable<EntryLawRow> two { "entryLaw", { sheet, entryLaws()[EntryLaw::inscribedSphere] } };
	EXPECT_EQ(two.names(), "'sheet', 'inscribedSphere'");
	EXPECT_EQ(two.listing()[0].first, "sheet");
	EXPECT_EQ(two.listing()[0].second, "a sheet in an open gap, 2 gamma cos(theta)/d, for open gaps");
	EXPECT_EQ(messageOf([&] { two.fromName("purcell"); }),
	        "entryLaw = 'purcell', allowed: 'sheet', 'inscribedSphere'");
}

TEST(LawTables, NumbersAreThoseOfTheEnums)
{
	EXPECT_STREQ(gasLaws()[GasLaw::ideal].name, "ideal");
	EXPECT_STREQ(gasLaws()[GasLaw::tabulated].name, "tabulated");
	EXPECT_STREQ(gasLaws()[GasLaw::incompressible].name, "incompressible");
	EXPECT_EQ(compressibleGasLaws(" or ").find("'ideal' or 'tabulated'"), 0u);
	EXPECT_EQ(compressibleGasLaws(", ").find("incompressible"), std::string::npos);
}

TEST(NewLaws, AnEntryLaw)
{
	const auto laws = entryLaws().with(sheet);
	const auto law = laws.fromName("sheet");
	EXPECT_DOUBLE_EQ(laws[law].pressure(1e-4, 1e-3, 0.05, 0), 1000);
	EXPECT_DOUBLE_EQ(laws[law].pressure(1e-4, 1e-3, 0.05, M_PI / 3), 500);
	EXPECT_EQ(messageOf([&] { laws[law].pressure(0, 1e-3, 0.05, 0); }), "gap of the throat [m] = 0, allowed: > 0");
	// Beyond the gap where no meniscus bridges it any more the law of Mayer, Stowe and Princen is the same.
	EXPECT_DOUBLE_EQ(laws[law].pressure(1.2, 1, 1, 0), entryPressure(EntryLaw::mayerStowePrincen, 1.2, 1, 1, 0));
	// The others are still there.
	EXPECT_EQ(laws[EntryLaw::inscribedSphere].pressure(0, 1, 1, 0),
	        entryPressure(EntryLaw::inscribedSphere, 0, 1, 1, 0));
}

TEST(NewLaws, AConductanceLaw)
{
	const auto laws = conductanceLaws().with(slit);
	const auto& law = laws[laws.fromName("openSlit")];
	const double c = conductance(law, 2e-4, 1e-3, 1e-3, 2, {}, 0.5);
	EXPECT_NEAR(c, 0.5 * 2 * 8e-12 / 12e-3, 1e-14 * c);
	EXPECT_EQ(conductance(law, -1e-5, 1e-3, 1e-3, 2), 0);
	// It is that of parallel plates without an aperture of their own.
	EXPECT_NEAR(conductance(ConductanceLaw::parallelPlates, 2e-4, 1e-3, 1e-3, 2, {}, 0.5), c, 1e-14 * c);
	// What is checked for every law is checked for this one, too.
	EXPECT_EQ(messageOf([&] { conductance(law, 0, 1, 0, 1); }), "viscosity [Pa s] = 0, allowed: > 0");
}

TEST(NewLaws, AnEquationOfState)
{
	const auto laws = gasLaws().with(virial);
	const auto& law = laws[laws.fromName("virial")];
	EquationOfState gas;
	checkEquationOfState(law, gas);
	const double rt = gasConstant * gas.temperature;
	for (double p : { 1e-3, 1e3, 1e5, 3e6, 1e7 }) {
		const double density = gasDensity(law, gas, p), denominator = rt + secondVirial * p;
		EXPECT_DOUBLE_EQ(density, p * gas.molarMass / denominator);
		// The row gives neither the derivative nor the inverse: differences, and a root.
		const double slope = gas.molarMass * rt / (denominator * denominator);
		EXPECT_NEAR(gasDensityDerivative(law, gas, p) / slope, 1, p < law.highest ? 1e-9 : 1e-5);
		EXPECT_NEAR(gasPressure(law, gas, density) / p, 1, 1e-14);
	}
	EXPECT_EQ(messageOf([&] { gasDensity(law, gas, 2e7); }),
	        "absolute pressure of the gas [Pa] = 20000000, allowed: up to 10000000.000000");
	EXPECT_NE(messageOf([&] {
		gasPressure(law, gas, 1e3);
	}).find("density of the gas [kg/m³] = 1000, allowed: up to 7"),
	        std::string::npos);
	EXPECT_NE(messageOf([&] { gasPressure(law, gas, -1); }).find("finite and > 0"), std::string::npos);
}

TEST(NewLaws, DifferencesAndRootsAgreeWithTheClosedForms)
{
	auto law = gasLaws()[GasLaw::ideal];
	const auto exact = law;
	law.derivative = nullptr, law.pressure = nullptr;
	const EquationOfState gas;
	for (double p : { 10.0, 1e5, 4e6, 1e9 }) {
		const double density = gasDensity(exact, gas, p);
		EXPECT_NEAR(gasDensityDerivative(law, gas, p) / gasDensityDerivative(exact, gas, p), 1, 1e-9);
		EXPECT_NEAR(gasPressure(law, gas, density) / gasPressure(exact, gas, density), 1, 1e-14);
	}
}

} // namespace capfrac
