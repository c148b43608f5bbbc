// SPDX-License-Identifier: GPL-2.0-or-later
#include "Supply.hpp"

namespace capfrac {

std::string nameOf(GasControl control)
{
	return control == GasControl::rate         ? "RateSupply"
	        : control == GasControl::reservoir ? "ReservoirSupply"
	                                           : "PressureSupply";
}

void checkOptions(const EquationOfState& gas)
{
	const std::string owner = gas.law == GasLaw::incompressible ? "IncompressibleGas" : "IdealGas";
	requirePositive(owner + ".molarMass [kg/mol]", gas.molarMass);
	requirePositive(owner + ".temperature [K]", gas.temperature);
	requirePositive(owner + ".deviation [-]", gas.deviation);
	for (std::size_t k = 0; k < gas.pressures.size(); ++k)
		for (const auto* column : { &gas.pressures, &gas.densities }) {
			const double value = (*column)[k];
			const bool ascends = k == 0 || value > (*column)[k - 1];
			if (isPositive(value) && ascends) continue;
			// Names are put together only when something is wrong: this runs every step.
			const std::string what = column == &gas.densities ? "density [kg/m³]" : "pressure [Pa]";
			const std::string name = what + " of pair " + std::to_string(k) + " of TabulatedGas.table";
			requirePositive(name, value);
			refuseAttribute(name, value, "ascending values");
		}
}

namespace {

	std::string nameOfReservoir(GasControl control)
	{
		return nameOf(control) + (control == GasControl::reservoir ? ".volume [m³]" : ".reservoirVolume [m³]");
	}

} // namespace

void checkOptions(const SupplyOptions& o)
{
	checkOptions(o.gas);
	requireFinite("pressureDatum [Pa]", o.pressureDatum);
	requireNotNegative("RateSupply.rate [kg/s]", o.rate);
	requireNotNegative(nameOfReservoir(o.control), o.reservoirVolume);
}

void checkTogether(const SupplyOptions& o, double waterPressure, double gasPressure)
{
	if (o.pressureFollows() && !o.gasCounted())
		refuseAttribute("supply", nameOf(o.control),
		        "PressureSupply with gasLaw = IncompressibleGas: no pressure follows from the amount of a gas "
		        "that does not yield, in a rigid box it would be infinite; set gasLaw = IdealGas or "
		        "TabulatedGas");
	if (o.control == GasControl::reservoir && !(o.reservoirVolume > 0))
		refuseAttribute(nameOfReservoir(o.control), o.reservoirVolume, "> 0 with supply = ReservoirSupply");
	if (o.gas.law == GasLaw::tabulated && o.gas.pressures.size() < 2)
		refuseAttribute("TabulatedGas.table, pairs", o.gas.pressures.size(), "at least two");
	if (o.gasCounted() && !(waterPressure + o.pressureDatum > 0))
		refuseAttribute("pressureDatum [Pa]", o.pressureDatum,
		        "> -waterPressure: the absolute pressure of the water is positive");
	if (o.gasCounted()) namingGas(o, [&] { return o.densityAt(gasPressure); });
}

} // namespace capfrac
