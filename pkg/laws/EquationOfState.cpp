// SPDX-License-Identifier: GPL-2.0-or-later
#include "EquationOfState.hpp"
#include "Refusal.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace capfrac {

namespace {

	constexpr double gasConstant = 8.31446261815324; // [J/(mol K)], exact in the SI

	void requirePositive(const std::string& what, double value)
	{
		if (!(value > 0 && std::isfinite(value))) refuse<GasLawError>(what, value, "finite and > 0");
	}

	void checkColumn(const std::string& what, const std::vector<double>& column)
	{
		for (std::size_t i = 0; i < column.size(); ++i) {
			requirePositive(what, column[i]);
			if (i > 0 && !(column[i] > column[i - 1]))
				refuse<GasLawError>(what, column[i], "ascending values");
		}
	}

	double perPressure(const EquationOfState& gas)
	{
		return gas.molarMass / (gas.deviation * gasConstant * gas.temperature);
	}

	/// Where a straight piece of the table begins: `x` lies between x[i] and x[i + 1], or beyond the last.
	std::size_t pieceOf(const std::vector<double>& x, double value)
	{
		const auto next = std::upper_bound(x.begin(), x.end(), value) - x.begin();
		return std::min<std::size_t>(next - 1, x.size() - 2);
	}

	/// The table read from the column `x` to the column `y`; in proportion below its first pair.
	double lookUp(const std::vector<double>& x, const std::vector<double>& y, double value, const std::string& what)
	{
		if (value > x.back())
			refuse<GasLawError>(what, value, "up to the last of the table, " + std::to_string(x.back()));
		if (value < x.front()) return y.front() * value / x.front();
		const auto i = pieceOf(x, value);
		return y[i] + (y[i + 1] - y[i]) * (value - x[i]) / (x[i + 1] - x[i]);
	}

} // namespace

GasLaw gasLawFromName(const std::string& name)
{
	if (name == "ideal") return GasLaw::ideal;
	if (name == "tabulated") return GasLaw::tabulated;
	if (name == "incompressible") return GasLaw::incompressible;
	throw std::invalid_argument("gasLaw = '" + name + "', allowed: 'ideal', 'tabulated', 'incompressible'");
}

void checkEquationOfState(const EquationOfState& gas)
{
	if (gas.law == GasLaw::ideal) {
		requirePositive("molar mass of the gas [kg/mol]", gas.molarMass);
		requirePositive("temperature of the gas [K]", gas.temperature);
		requirePositive("deviation factor of the gas [-]", gas.deviation);
	} else if (gas.law == GasLaw::incompressible)
		requirePositive("density of the gas [kg/m³]", gas.constant);
	else {
		if (gas.pressures.size() < 2 || gas.densities.size() != gas.pressures.size())
			throw GasLawError("table of the gas: " + std::to_string(gas.pressures.size())
			        + " pressures and " + std::to_string(gas.densities.size())
			        + " densities, allowed: as many of each, at least two");
		checkColumn("pressure in the table of the gas [Pa]", gas.pressures);
		checkColumn("density in the table of the gas [kg/m³]", gas.densities);
	}
}

double gasDensity(const EquationOfState& gas, double pressure)
{
	if (gas.law == GasLaw::incompressible) return gas.constant;
	requirePositive("absolute pressure of the gas [Pa]", pressure);
	if (gas.law == GasLaw::ideal) return perPressure(gas) * pressure;
	return lookUp(gas.pressures, gas.densities, pressure, "absolute pressure of the gas [Pa]");
}

double gasDensityDerivative(const EquationOfState& gas, double pressure)
{
	if (gas.law == GasLaw::incompressible) return 0;
	requirePositive("absolute pressure of the gas [Pa]", pressure);
	if (gas.law == GasLaw::ideal) return perPressure(gas);
	const auto& x = gas.pressures;
	const auto& y = gas.densities;
	if (pressure < x.front()) return y.front() / x.front();
	const auto i = pieceOf(x, pressure);
	return (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
}

double gasPressure(const EquationOfState& gas, double density)
{
	if (gas.law == GasLaw::incompressible)
		throw GasLawError("the pressure of an incompressible gas does not follow from its density");
	requirePositive("density of the gas [kg/m³]", density);
	if (gas.law == GasLaw::ideal) return density / perPressure(gas);
	return lookUp(gas.densities, gas.pressures, density, "density of the gas [kg/m³]");
}

} // namespace capfrac
