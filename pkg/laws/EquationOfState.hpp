// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the density of the gas follows its pressure, at a constant temperature.
///
/// Gas is counted by mass. All pressures here are absolute [Pa]; the engines add their datum. Another law
/// is one more entry of GasLaw, or, without touching the code, a table of measured densities.

#include <stdexcept>
#include <string>
#include <vector>

namespace capfrac {

enum class GasLaw {
	ideal,         ///< rho = p M/(Z R T) with a constant Z
	tabulated,     ///< linear between given pairs of pressure and density
	incompressible ///< a constant density
};

/// The law's name, "ideal", "tabulated" or "incompressible", to the law. Throws std::invalid_argument.
GasLaw gasLawFromName(const std::string& name);

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

/// Checks the parameters of the law. Throws GasLawError naming the one at fault.
void checkEquationOfState(const EquationOfState& gas);

/// Density [kg/m^3] at the absolute pressure `pressure` [Pa] > 0. A table holds between its first and last pressure,
/// and below the first in proportion to the pressure, as a thin gas does; above the last it throws GasLawError.
double gasDensity(const EquationOfState& gas, double pressure);

/// d rho/dp [kg/(m^3 Pa)] there, from above at a point of the table; 0 for the incompressible gas.
double gasDensityDerivative(const EquationOfState& gas, double pressure);

/// Absolute pressure [Pa] at which the gas has the density `density` [kg/m^3] > 0: the inverse of gasDensity(). Throws
/// GasLawError for an incompressible gas, whose pressure does not follow from its density.
double gasPressure(const EquationOfState& gas, double density);

} // namespace capfrac
