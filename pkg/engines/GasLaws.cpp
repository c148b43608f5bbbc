// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasLaws.hpp"
#include "../supply/Supply.hpp"

namespace yade {

YADE_PLUGIN(CAPFRAC_GAS_LAWS);

capfrac::EquationOfState GasLaw::equation() const
{
	capfrac::refuseAttribute("gasLaw", getClassName(), "an object such as IdealGas()");
}

void GasLaw::check() const { capfrac::checkOptions(equation()); }

capfrac::EquationOfState IncompressibleGas::equation() const
{
	capfrac::EquationOfState gas;
	gas.law = capfrac::GasLaw::incompressible;
	return gas;
}

capfrac::EquationOfState IdealGas::equation() const
{
	capfrac::EquationOfState gas;
	gas.law = capfrac::GasLaw::ideal;
	gas.molarMass = molarMass, gas.temperature = temperature, gas.deviation = deviation;
	return gas;
}

capfrac::EquationOfState TabulatedGas::equation() const
{
	capfrac::EquationOfState gas;
	gas.law = capfrac::GasLaw::tabulated;
	for (const auto& pair : table)
		gas.pressures.push_back(pair[0]), gas.densities.push_back(pair[1]);
	return gas;
}

} // namespace yade
