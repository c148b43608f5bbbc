// SPDX-License-Identifier: GPL-2.0-or-later
#include "Supply.hpp"

namespace capfrac {

GasControl gasControlFromName(const std::string& name)
{
	for (const auto control : { GasControl::pressure, GasControl::rate, GasControl::reservoir })
		if (name == nameOf(control)) return control;
	refuseAttribute("gasControl", "'" + name + "'", "'pressure', 'rate', 'reservoir'");
}

std::string nameOf(GasControl control)
{
	return control == GasControl::rate ? "rate" : control == GasControl::reservoir ? "reservoir" : "pressure";
}

void checkOptions(const SupplyOptions& o)
{
	requirePositive("gasMolarMass [kg/mol]", o.gas.molarMass);
	requirePositive("gasTemperature [K]", o.gas.temperature);
	requirePositive("gasDeviation [-]", o.gas.deviation);
	for (std::size_t k = 0; k < o.gas.pressures.size(); ++k)
		for (const auto* column : { &o.gas.pressures, &o.gas.densities }) {
			const std::string what = column == &o.gas.densities ? "density [kg/m³]" : "pressure [Pa]";
			const std::string name = what + " of pair " + std::to_string(k) + " of gasTable";
			requirePositive(name, (*column)[k]);
			if (k > 0 && !((*column)[k] > (*column)[k - 1]))
				refuseAttribute(name, (*column)[k], "ascending values");
		}
	requireFinite("pressureDatum [Pa]", o.pressureDatum);
	requireNotNegative("gasRate [kg/s]", o.rate);
	requireNotNegative("reservoirVolume [m³]", o.reservoirVolume);
}

void checkTogether(const SupplyOptions& o, double waterPressure, double gasPressure)
{
	if (o.pressureFollows() && !o.gasCounted())
		refuseAttribute("gasControl", "'" + nameOf(o.control) + "'",
		        "'pressure' with gasLaw = '" + o.lawName
		                + "': no pressure follows from the amount of a gas that does not yield, in a rigid box "
		                  "it would be infinite; set gasLaw = "
		                + compressibleGasLaws(" or "));
	if (o.control == GasControl::reservoir && !(o.reservoirVolume > 0))
		refuseAttribute("reservoirVolume [m³]", o.reservoirVolume, "> 0 with gasControl = 'reservoir'");
	if (o.gas.law == GasLaw::tabulated && o.gas.pressures.size() < 2)
		refuseAttribute("gasTable, pairs", o.gas.pressures.size(), "at least two with gasLaw = 'tabulated'");
	if (o.gasCounted() && !(waterPressure + o.pressureDatum > 0))
		refuseAttribute("pressureDatum [Pa]", o.pressureDatum,
		        "> -waterPressure: the absolute pressure of the water is positive");
	if (o.gasCounted()) namingGas(o, [&] { return o.densityAt(gasPressure); });
}

} // namespace capfrac
