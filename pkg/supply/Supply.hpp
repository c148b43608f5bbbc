// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How gas is supplied to the inlet, and what that needs to know of the gas.

#include "../laws/EquationOfState.hpp"
#include "../laws/Options.hpp"

#include <string>
#include <vector>

namespace capfrac {

/// What is prescribed: the pressure (a ramp or a program), a rate, or a reservoir that is left to itself.
enum class GasControl { pressure, rate, reservoir };

/// As messages call it: the class of engines' `supply`.
std::string nameOf(GasControl control);

struct SupplyOptions {
	GasControl control = GasControl::pressure;
	double rate = 0;            ///< mass supplied per time with GasControl::rate [kg/s] >= 0
	double reservoirVolume = 0; ///< volume upstream of the inlet, at the pressure of the connected gas [m^3] >= 0
	EquationOfState gas;
	std::string lawName = "IdealGas"; ///< as messages call it
	double pressureDatum = 101325;    ///< absolute pressure where pressures are zero [Pa]

	/// By mass: only a gas whose density follows from its pressure.
	bool gasCounted() const { return gasLaws()[gas.law].compressible; }
	/// Whether the pressure follows from the mass of the gas.
	bool pressureFollows() const { return control != GasControl::pressure; }
	/// Density at a pressure above the datum [kg/m^3]. Throws std::runtime_error naming the law.
	double densityAt(double pressure) const;
};

/// Check what an option shows by itself. Throw std::invalid_argument naming it.
void checkOptions(const EquationOfState& gas);
void checkOptions(const SupplyOptions& options);
/// Checks what only the whole of the options shows, water having the pressure `waterPressure` [Pa] and the gas
/// `gasPressure` [Pa]. Throws std::invalid_argument, or std::runtime_error where the gas has no density there.
void checkTogether(const SupplyOptions& options, double waterPressure, double gasPressure);

/// Runs `work`; a GasLawError is thrown again as std::runtime_error naming the law.
template <class Work> auto namingGas(const SupplyOptions& options, Work work)
{
	try {
		return work();
	} catch (const GasLawError& error) {
		throw std::runtime_error("gasLaw = " + options.lawName + ": " + error.what());
	}
}

inline double SupplyOptions::densityAt(double pressure) const { return gasDensity(gas, pressure + pressureDatum); }

} // namespace capfrac
