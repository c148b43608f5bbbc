// SPDX-License-Identifier: GPL-2.0-or-later
/// laws/EquationOfState: densities against the ideal gas law by hand, the table, its inverse, what is refused.

#include "laws/EquationOfState.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace capfrac {

namespace {

	constexpr double nan = std::numeric_limits<double>::quiet_NaN();

	EquationOfState table()
	{
		EquationOfState gas;
		gas.law = GasLaw::tabulated;
		gas.pressures = { 1e6, 2e6, 4e6 };
		gas.densities = { 7, 15, 33 };
		return gas;
	}

	template <class Call> std::string messageOf(Call call)
	{
		try {
			call();
		} catch (const GasLawError& error) {
			return error.what();
		}
		return "no GasLawError";
	}

} // namespace

TEST(EquationOfState, IdealGasHasOneMolePerRT)
{
	// 28 g of a gas of 28 g/mol fill R T/p: 22.41396954 l at 0 degrees C and 101325 Pa (CODATA molar volume).
	EquationOfState gas;
	gas.molarMass = 0.028, gas.temperature = 273.15;
	EXPECT_NEAR(gasDensity(gas, 101325), 0.028 / 22.41396954e-3, 1e-9);
	gas.deviation = 0.5;
	EXPECT_NEAR(gasDensity(gas, 101325), 2 * 0.028 / 22.41396954e-3, 1e-9);
}

TEST(EquationOfState, TableIsLinearBetweenItsPairsAndAThinGasBelow)
{
	const auto gas = table();
	for (std::size_t i = 0; i < gas.pressures.size(); ++i)
		EXPECT_DOUBLE_EQ(gasDensity(gas, gas.pressures[i]), gas.densities[i]);
	EXPECT_DOUBLE_EQ(gasDensity(gas, 1.5e6), 11);
	EXPECT_DOUBLE_EQ(gasDensity(gas, 0.5e6), 3.5);
}

TEST(EquationOfState, DerivativeIsTheDifferenceQuotient)
{
	for (const auto& gas : { table(), EquationOfState {} })
		for (double p : { 0.3e6, 1.2e6, 3.1e6 }) // inside straight pieces, where the central difference has no
		                                         // error but round-off: 1e-16 p/step
			EXPECT_NEAR(gasDensityDerivative(gas, p)
			                / ((gasDensity(gas, p + 1e3) - gasDensity(gas, p - 1e3)) / 2e3),
			        1, 1e-11);
}

TEST(EquationOfState, PressureIsTheInverse)
{
	for (const auto& gas : { table(), EquationOfState {} })
		for (double p : { 0.3e6, 1e6, 1.2e6, 3.1e6, 4e6 })
			EXPECT_NEAR(gasPressure(gas, gasDensity(gas, p)) / p, 1, 1e-15 * 4);
}

TEST(EquationOfState, IncompressibleGasKeepsItsDensity)
{
	EquationOfState gas;
	gas.law = GasLaw::incompressible, gas.constant = 80;
	EXPECT_EQ(gasDensity(gas, 1e5), 80);
	EXPECT_EQ(gasDensity(gas, 1e7), 80);
	EXPECT_EQ(gasDensityDerivative(gas, 1e5), 0);
	EXPECT_NE(messageOf([&] { gasPressure(gas, 80); }).find("incompressible"), std::string::npos);
}

TEST(EquationOfState, BadParametersAreNamed)
{
	const auto after = [](auto spoil) {
		auto gas = table();
		spoil(gas);
		return messageOf([&] { checkEquationOfState(gas); });
	};
	EXPECT_EQ(after([](auto&) {}), "no GasLawError");
	EXPECT_NE(after([](auto& gas) {
		gas.law = GasLaw::ideal, gas.temperature = 0;
	}).find("temperature of the gas [K] = 0"),
	        std::string::npos);
	EXPECT_NE(after([](auto& gas) { gas.law = GasLaw::ideal, gas.molarMass = nan; }).find("molar mass"),
	        std::string::npos);
	EXPECT_NE(after([](auto& gas) {
		gas.law = GasLaw::ideal, gas.deviation = -1;
	}).find("deviation factor of the gas [-] = -1"),
	        std::string::npos);
	EXPECT_NE(
	        after([](auto& gas) { gas.law = GasLaw::incompressible, gas.constant = 0; }).find("density of the gas"),
	        std::string::npos);
	EXPECT_NE(after([](auto& gas) { gas.densities.pop_back(); }).find("3 pressures and 2 densities"),
	        std::string::npos);
	EXPECT_NE(after([](auto& gas) { gas.pressures[2] = 1.5e6; }).find("ascending"), std::string::npos);
	EXPECT_NE(messageOf([] { gasDensity(table(), 5e6); }).find("= 5000000, allowed: up to the last of the table"),
	        std::string::npos);
	EXPECT_NE(messageOf([] { gasDensity({}, -1); }).find("absolute pressure of the gas [Pa] = -1"),
	        std::string::npos);
	EXPECT_THROW(gasLawFromName("vanDerWaals"), std::invalid_argument);
}

} // namespace capfrac
