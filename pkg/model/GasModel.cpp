// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasModel.hpp"

#include "SinglePhase.hpp"

#include <algorithm>
#include <cmath>

namespace capfrac {

void checkOptions(const GasOptions& o)
{
	requirePositive("interfacialTension [N/m]", o.tension);
	if (!(o.contactAngle >= 0 && o.contactAngle < M_PI / 2))
		refuseAttribute("contactAngle [rad]", o.contactAngle, "0 <= angle < pi/2 (water wets)");
	if (const auto& law = entryLaws()[o.law]; !law.anyAngle && o.contactAngle != 0)
		refuseAttribute(
		        "contactAngle [rad]", o.contactAngle, "0 with entryLaw = '" + std::string(law.name) + "'");
	requirePositive("openingThreshold [-]", o.openingThreshold);
	wallFromName("inletWall", o.inlet.wall);
	wallsFromName("outletWall", o.outletWall);
	requireNotNegative("filmConductance [m³/(Pa·s)]", o.filmConductance);
	requireNotNegative("fluidDensity [kg/m³]", o.waterDensity);
	requireNotNegative("gasDensity [kg/m³]", o.gasDensity);
	requireFinite("gravity [m/s²]", dot(o.gravity, o.gravity));
	if (o.historyInterval < 0) refuseAttribute("historyInterval [-]", o.historyInterval, ">= 0");
	checkOptions(o.supply);
	checkOptions(o.levels);
}

double datumDensity(const SupplyOptions& supply)
{
	auto ideal = supply.gas;
	ideal.law = GasLaw::ideal;
	return supply.pressureDatum > 0 ? gasDensity(ideal, supply.pressureDatum)
	                                : std::numeric_limits<double>::quiet_NaN();
}

void GasModel::start(PoreNetwork& network, const Moment& now)
{
	if (gasPressure < gas.waterPressure) refuseAttribute("gasPressure [Pa]", gasPressure, ">= waterPressure");
	checkWeight(gas.gravity, gas.waterDensity == 0 && gas.gasDensity == 0);
	checkStart();
	fillInlet(network);
	startFluids(network);
	network.regroup();
	startGrains = network.grains, startBox = network.box;
	gasSaturation = saturation(network);
	levels.start = -1;
	noteBreakthrough(network, now.iteration); // an inlet may reach the outlet from the start
}

void GasModel::fillInlet(PoreNetwork& network)
{
	reachWallEnds(network, gas.inlet);
	checkInlet(network, gas.inlet);
	const auto inlet = inletDomains(network, gas.inlet);
	if (inlet.empty())
		throw std::invalid_argument("no inlet: no pore of the " + gas.inlet.wall
		        + " wall has its middle between inletFrom and inletTo; widen the inlet");
	checkOutlet(network, inlet);
	inletPores = static_cast<int>(inlet.size());
	inletWidth = capfrac::inletWidth(network, gas.inlet, inlet);
	for (int d : inlet) {
		fillWithGas(network, d);
		for (int c : network.domains.cellsOf(d))
			network.contents.source[c] = 1;
	}
}

void GasModel::checkOutlet(const PoreNetwork& network, const std::vector<int>& inlet) const
{
	if (!needsOutlet()) return;
	for (int wall : outlets())
		for (const auto& stretch : network.stretches(wall))
			if (!std::binary_search(inlet.begin(), inlet.end(), stretch.domain)) return;
	refuseAttribute("no outlet for the water: outletWall", "'" + gas.outletWall + "'",
	        "a wall with a pore that is not the inlet's");
}

void GasModel::fillWithGas(PoreNetwork& network, int domain)
{
	auto& contents = network.contents;
	for (int c : network.domains.cellsOf(domain)) {
		network.books.waterIn -= network.options.thickness * contents.water[c];
		network.books.gasIn += network.options.thickness * contents.water[c];
		contents.gas[c] += contents.water[c];
		contents.water[c] = 0;
		contents.phase[c] = Phase::gas;
	}
}

double GasModel::connectedGas(const PoreNetwork& network) const
{
	const auto hanging = clusters(network);
	const auto voids = network.voids();
	double volume = 0;
	for (std::size_t c = 0; c < voids.size(); ++c)
		if (hanging.ofCell[c] == 0)
			volume += network.options.thickness * (voids[c] - network.contents.water[c]);
	return volume;
}

double GasModel::injectedMass(const PoreNetwork& network) const
{
	return gas.supply.gasCounted() ? books.injectedMass : datumDensity(gas.supply) * network.books.gasIn;
}

double GasModel::entryPressureOf(const PoreNetwork& network, int e) const
{
	const auto [gap, r] = network.throatShape(e);
	try {
		return entryPressure(gas.law, gap, r, gas.tension, gas.contactAngle);
	} catch (const EntryLawError& error) {
		const auto& edge = network.mesh.edges[e];
		throw std::runtime_error("throat between " + network.nameOf(edge.a) + " and " + network.nameOf(edge.b)
		        + ": " + error.what());
	}
}

double GasModel::entryPressureAtDatum(const PoreNetwork& network, const Hydrostatics& columns, int e) const
{
	const double entry = entryPressureOf(network, e);
	return columns.heavy() ? entry - columns.head(network.throatPlace(e)) : entry;
}

double GasModel::gapGrowth(const PoreNetwork& network, int e) const
{
	const auto& edge = network.mesh.edges[e];
	return network.gaps[e] - gap(network.mesh, edge.a, edge.b, startGrains, startBox);
}

std::vector<double> GasModel::displacements(const PoreNetwork& network) const
{
	std::vector<double> moved(network.grains.size());
	for (std::size_t i = 0; i < moved.size(); ++i)
		moved[i] = norm(network.grains[i].centre - startGrains[i].centre) / network.grains[i].radius;
	return moved;
}

void GasModel::record(const PoreNetwork& network, const GrainAnswer& grains, const Moment& now, int e, int domain)
{
	const auto& edge = network.mesh.edges[e];
	InvasionEvent event;
	event.time = now.time, event.iteration = static_cast<int>(now.iteration);
	event.level = static_cast<int>(levels.closed.size());
	event.gasPressure = gasPressure, event.entryPressure = entryPressureOf(network, e);
	event.throat = { network.idOf(edge.a), network.idOf(edge.b) };
	event.gap = network.gaps[e], event.gapGrowth = gapGrowth(network, e);
	event.bondBroken = grains.bondBroken(edge.a, edge.b);
	event.opened = event.bondBroken || event.gapGrowth > gas.openingThreshold * network.throatShape(e).second;
	Vec2 place;
	for (int c : network.domains.cellsOf(domain)) {
		event.volume += network.options.thickness * network.contents.water[c];
		place += network.cellMiddle(c);
		++event.cells;
	}
	event.place = { place.x / event.cells, place.y / event.cells };
	const auto& v = network.mesh.cells[network.domains.first[domain]].vertex;
	for (int k = 0; k < 3; ++k)
		event.pore[k] = network.idOf(v[k]);
	events.push_back(event);
}

void GasModel::noteBreakthrough(const PoreNetwork& network, long iteration)
{
	if (breakthrough.iteration >= 0) return;
	const auto walls = outlets();
	for (int d = 0; d < network.domains.count; ++d)
		if (network.isGas(network.domains.first[d]) && std::any_of(walls.begin(), walls.end(), [&](int wall) {
			    return network.touches(d, wall);
		    })) {
			breakthrough = { gasPressure, static_cast<int>(iteration) };
			return;
		}
}

} // namespace capfrac
