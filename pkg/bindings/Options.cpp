// SPDX-License-Identifier: GPL-2.0-or-later
#include "Options.hpp"

namespace capfrac {

namespace py = boost::python;

namespace {

	std::vector<double> numbersOf(const py::object& list)
	{
		std::vector<double> numbers;
		for (int k = 0; k < py::len(list); ++k)
			numbers.push_back(py::extract<double>(list[k])());
		return numbers;
	}

	Vec2 vectorOf(const py::object& pair)
	{
		return { py::extract<double>(pair[0])(), py::extract<double>(pair[1])() };
	}

	std::vector<PointValue> pointsOf(const py::object& list)
	{
		std::vector<PointValue> points;
		for (int k = 0; k < py::len(list); ++k)
			points.push_back({ vectorOf(list[k]), py::extract<double>(list[k][2])() });
		return points;
	}

	std::string textOf(const py::object& text) { return py::extract<std::string>(text)(); }

	GasControl gasControlFromName(const std::string& name)
	{
		if (name == "pressure") return GasControl::pressure;
		if (name == "rate") return GasControl::rate;
		if (name == "reservoir") return GasControl::reservoir;
		refuseAttribute("gasControl", "'" + name + "'", "'pressure', 'rate', 'reservoir'");
	}

} // namespace

void OptionTable::read(const py::dict& given) const
{
	const py::list names = given.keys();
	for (int k = 0; k < py::len(names); ++k) {
		const std::string name = textOf(names[k]);
		const auto found = setters.find(name);
		if (found == setters.end()) {
			std::string all;
			for (const auto& [known, set] : setters)
				all += (all.empty() ? "" : ", ") + known;
			throw std::invalid_argument("option '" + name + "', allowed: " + all);
		}
		found->second(given[name]);
	}
}

void addNetwork(OptionTable& table, NetworkOptions& o)
{
	table.add("poreMode", [&o](const py::object& name) { o.mode = poreModeFromName(textOf(name)); });
	table.add("mergeTolerance", o.mergeTolerance);
	table.add("mergeHysteresis", o.mergeHysteresis);
	table.add("remeshDisplacement", o.remeshDisplacement);
	table.add("localFlips", o.localFlips);
	table.add("thickness", o.thickness);
}

void addFlow(OptionTable& table, FlowOptions& o)
{
	table.add("bulkModulus", o.bulkModulus);
	table.add("viscosity", o.viscosity);
	table.add("conductanceLaw", [&o](const py::object& name) { o.law = conductanceLawFromName(textOf(name)); });
	table.add("conductanceFactor", o.conductanceFactor);
	table.add("residualAperture", o.residualAperture);
	table.add("halvingForce", o.halvingForce);
	table.add("timeIntegration", [&o](const py::object& name) { o.scheme = flowSchemeFromName(textOf(name)); });
	table.add("wallPressures", [&o](const py::object& list) { o.wallPressures = numbersOf(list); });
	table.add("wallFluxes", [&o](const py::object& list) { o.wallFluxes = numbersOf(list); });
	table.add("pointPressures", [&o](const py::object& list) { o.pointPressures = pointsOf(list); });
	table.add("pointFluxes", [&o](const py::object& list) { o.pointFluxes = pointsOf(list); });
	table.add("fluidDensity", o.density);
	table.add("gravity", [&o](const py::object& vector) { o.gravity = vectorOf(vector); });
	table.add("grainBulkModulus", o.grainBulkModulus);
	table.add("closedPore", o.closedPore);
}

void addGas(OptionTable& table, GasOptions& o, double& gasPressure)
{
	table.add("gasPressure", gasPressure);
	table.add("interfacialTension", o.tension);
	table.add("contactAngle", o.contactAngle);
	table.add("entryLaw", [&o](const py::object& name) { o.law = entryLawFromName(textOf(name)); });
	table.add("waterPressure", o.waterPressure);
	table.add("inletWall", o.inlet.wall);
	table.add("inletFrom", o.inlet.from);
	table.add("inletTo", o.inlet.to);
	table.add("outletWall", o.outletWall);
	table.add("gasLaw", [&o](const py::object& name) {
		o.supply.gas.law = gasLawFromName(textOf(name));
		o.supply.lawName = "'" + textOf(name) + "'";
	});
	table.add("gasMolarMass", o.supply.gas.molarMass);
	table.add("gasTemperature", o.supply.gas.temperature);
	table.add("gasDeviation", o.supply.gas.deviation);
	table.add("pressureDatum", o.supply.pressureDatum);
	table.add("gasControl", [&o](const py::object& name) { o.supply.control = gasControlFromName(textOf(name)); });
	table.add("gasRate", o.supply.rate);
	table.add("reservoirVolume", o.supply.reservoirVolume);
	table.add("invasionInterval", o.levels.invasionInterval);
	table.add("fluidDensity", o.waterDensity);
	table.add("gasDensity", o.gasDensity);
	table.add("gravity", [&o](const py::object& vector) { o.gravity = vectorOf(vector); });
	table.add("filmConductance", o.filmConductance);
	table.add("openingThreshold", o.openingThreshold);
	table.add("checkInvariants", o.checkInvariants);
}

void addDrained(OptionTable& table, DrainedOptions& o)
{
	table.add("trapping", o.trapping);
	table.add("imbibition", o.imbibition);
	table.add("snapOff", o.snapOff);
}

void addViscous(OptionTable& table, ViscousOptions& o)
{
	table.add("gasViscosity", o.gasViscosity);
	table.add("maxFilling", o.maxFilling);
}

} // namespace capfrac
