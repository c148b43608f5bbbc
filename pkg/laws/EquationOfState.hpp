// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the density of the gas follows its pressure, at a constant temperature.
///
/// Gas is counted by mass. All pressures here are absolute [Pa]; the engines add their datum. Another law is one more
/// row of gasLaws(), or, without touching the code, a table of measured densities.

#include "Laws.hpp"

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace capfrac {

/// Laws that code asks for by name; the numbers are those of their rows in gasLaws().
enum class GasLaw : int {
	ideal,         ///< rho = p M/(Z R T) with a constant Z
	tabulated,     ///< linear between given pairs of pressure and density
	incompressible ///< a constant density
};

/// Parameters of the laws; each reads its own.
struct EquationOfState {
	GasLaw law = GasLaw::ideal;
	double molarMass = 0.016043;   ///< M [kg/mol] > 0; methane
	double temperature = 293.15;   ///< T [K] > 0
	double deviation = 1;          ///< Z [-] > 0; 1: an ideal gas
	double constant = 1;           ///< density of the incompressible gas [kg/m^3] > 0
	std::vector<double> pressures; ///< of the table [Pa], > 0, ascending, at least two
	std::vector<double> densities; ///< of the table [kg/m^3], > 0, ascending
};

/// A state the law does not hold for.
struct GasLawError : std::domain_error {
	using std::domain_error::domain_error;
};

/// A law of the density.
struct GasLawRow {
	using Law = GasLaw;
	const char *name, *doc, *range;
	/// Density [kg/m^3] at the absolute pressure [Pa] > 0, growing with it. Throws GasLawError where the law does
	/// not hold, if that depends on its parameters.
	double (*density)(const EquationOfState& gas, double pressure);
	/// d rho/dp [kg/(m^3 Pa)]; where null, from differences of the density (seven digits or more).
	double (*derivative)(const EquationOfState& gas, double pressure) = nullptr;
	/// The absolute pressure [Pa] of a density [kg/m^3] > 0; where null, the root of the density (15 digits).
	double (*pressure)(const EquationOfState& gas, double density) = nullptr;
	/// Throws GasLawError naming the parameter at fault; null: the law has none.
	void (*check)(const EquationOfState& gas) = nullptr;
	bool compressible = true; ///< whether the pressure follows from the density
	/// The highest absolute pressure for which the law holds [Pa]: beyond, it is not called.
	double highest = std::numeric_limits<double>::infinity();
};

/// The laws there are, one a row.
const LawTable<GasLawRow>& gasLaws();

/// The law of that name. Throws std::invalid_argument with the names that there are.
inline GasLaw gasLawFromName(const std::string& name) { return gasLaws().fromName(name); }

/// "'a' or 'b'" with `between` = " or ": the laws of gases whose pressure follows from their density.
std::string compressibleGasLaws(const std::string& between);

/// Checks the parameters of the law. Throws GasLawError naming the one at fault.
void checkEquationOfState(const GasLawRow& law, const EquationOfState& gas);
inline void checkEquationOfState(const EquationOfState& gas) { checkEquationOfState(gasLaws()[gas.law], gas); }

/// Density [kg/m^3] at the absolute pressure `pressure` [Pa] > 0. A table holds between its first and last pressure,
/// and below the first in proportion to the pressure, as a thin gas does; above the last it throws GasLawError.
double gasDensity(const GasLawRow& law, const EquationOfState& gas, double pressure);
inline double gasDensity(const EquationOfState& gas, double pressure)
{
	return gasDensity(gasLaws()[gas.law], gas, pressure);
}

/// d rho/dp [kg/(m^3 Pa)] there, from above at a point of the table; 0 for the incompressible gas.
double gasDensityDerivative(const GasLawRow& law, const EquationOfState& gas, double pressure);
inline double gasDensityDerivative(const EquationOfState& gas, double pressure)
{
	return gasDensityDerivative(gasLaws()[gas.law], gas, pressure);
}

/// Absolute pressure [Pa] at which the gas has the density `density` [kg/m^3] > 0: the inverse of gasDensity(). Throws
/// GasLawError for an incompressible gas, whose pressure does not follow from its density, and for a density beyond
/// what the law reaches.
double gasPressure(const GasLawRow& law, const EquationOfState& gas, double density);
inline double gasPressure(const EquationOfState& gas, double density)
{
	return gasPressure(gasLaws()[gas.law], gas, density);
}

} // namespace capfrac
