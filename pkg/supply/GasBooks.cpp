// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasBooks.hpp"

#include "GasBalance.hpp"

#include <cmath>
#include <limits>

namespace capfrac {

double GasBooks::massIn(const PoreNetwork& network) const
{
	return network.options.thickness * network.contents.totalGasMass() + reservoirMass;
}

void GasBooks::settle(PoreNetwork& network, const SupplyOptions& supply, const std::vector<std::uint8_t>& shut,
        double waterPressure, double& gasPressure, double supplied)
{
	if (!supply.gasCounted()) {
		started = false;
		return;
	}
	takeWaterOut(network);
	Found found;
	found.room = network.voids();
	found.waterPressure = waterPressure, found.lowest = waterPressure + supply.pressureDatum;
	const auto entered = followVoids(network.contents, found.room);
	network.books.gasIn += network.options.thickness * entered[0];
	network.books.waterIn += network.options.thickness * entered[1];
	for (std::size_t c = 0; c < found.room.size(); ++c)
		found.room[c] -= network.contents.water[c];
	returnedWater.assign(found.room.size(), 0);
	namingGas(supply, [&] {
		if (!started) startCount(network, supply, gasPressure);
		if (supply.reservoirVolume != reservoirFilled) attachReservoir(supply, gasPressure);
		found.clusters = gasClusters(network.mesh, network.contents, shut);
		settleConnected(network, supply, found, gasPressure, supplied);
		settleCutOff(network, supply, found);
		cutOffPressures = findCutOffPressures(network, supply, found.clusters, waterPressure);
	});
}

/// All the gas that is there begins to count, at the gas pressure.
void GasBooks::startCount(PoreNetwork& network, const SupplyOptions& supply, double gasPressure)
{
	const double density = supply.densityAt(gasPressure);
	auto& contents = network.contents;
	for (std::size_t c = 0; c < contents.gas.size(); ++c)
		contents.gasMass[c] = density * contents.gas[c];
	reservoirMass = density * supply.reservoirVolume;
	reservoirFilled = supply.reservoirVolume;
	initialMass = injectedMass = massIn(network);
	started = true;
}

void GasBooks::attachReservoir(const SupplyOptions& supply, double gasPressure)
{
	const double mass = supply.densityAt(gasPressure) * (supply.reservoirVolume - reservoirFilled);
	reservoirMass += mass;
	initialMass += mass;
	injectedMass += mass;
	reservoirFilled = supply.reservoirVolume;
}

void GasBooks::settleConnected(
        PoreNetwork& network, const SupplyOptions& supply, const Found& found, double& gasPressure, double supplied)
{
	const double thickness = network.options.thickness;
	auto& gasMass = network.contents.gasMass;
	std::vector<int> cells;
	double inCells = 0, total = 0;
	for (std::size_t c = 0; c < found.room.size(); ++c)
		if (found.clusters.ofCell[c] == 0) {
			cells.push_back(static_cast<int>(c));
			inCells += gasMass[c];
			total += found.room[c];
		}
	if (!supply.pressureFollows()) {
		const double before = massIn(network), density = supply.densityAt(gasPressure);
		for (int c : cells)
			gasMass[c] = density * found.room[c];
		reservoirMass = density * supply.reservoirVolume;
		injectedMass += massIn(network) - before;
		return;
	}
	const double mass = thickness * inCells + reservoirMass + supplied;
	injectedMass += supplied;
	const auto balance = balanceGas(supply.gas, mass, supply.reservoirVolume, thickness * total, found.lowest);
	gasPressure = std::max(balance.pressure - supply.pressureDatum, found.waterPressure);
	inCells = 0;
	for (int c : cells) {
		shareOut(network, c, found.room[c], balance.share, balance.density);
		inCells += gasMass[c];
	}
	reservoirMass = mass - thickness * inCells; // what round-off leaves over stays in the books
}

void GasBooks::settleCutOff(PoreNetwork& network, const SupplyOptions& supply, const Found& found)
{
	const auto& clusters = found.clusters;
	if (clusters.count == 1) return;
	const double thickness = network.options.thickness;
	std::vector<double> mass(clusters.count, 0), total(clusters.count, 0);
	for (std::size_t c = 0; c < found.room.size(); ++c)
		if (const int k = clusters.ofCell[c]; k > 0)
			mass[k] += network.contents.gasMass[c], total[k] += found.room[c];
	std::vector<GasBalance> balance(clusters.count);
	for (int k = 1; k < clusters.count; ++k)
		// In a torn sample the void of a single cell may be negative; it keeps what it has until the cells
		// regroup.
		if (mass[k] > 0 && total[k] > 0)
			balance[k] = balanceGas(supply.gas, thickness * mass[k], 0, thickness * total[k], found.lowest);
	for (std::size_t c = 0; c < found.room.size(); ++c) {
		const int k = clusters.ofCell[c];
		if (k > 0 && balance[k].density > 0)
			shareOut(network, static_cast<int>(c), found.room[c], balance[k].share, balance[k].density);
	}
}

void GasBooks::takeWaterOut(PoreNetwork& network)
{
	const double thickness = network.options.thickness;
	for (std::size_t c = 0; c < returnedWater.size(); ++c) {
		network.books.gasIn += thickness * returnedWater[c];
		network.books.waterIn -= thickness * returnedWater[c];
		network.contents.gas[c] += returnedWater[c];
		network.contents.water[c] -= returnedWater[c];
	}
	returnedWater.clear();
}

/// Lets the gas take `share` of what there is for it in a cell, `room`, at `density`, and water the rest.
void GasBooks::shareOut(PoreNetwork& network, int c, double room, double share, double density)
{
	const double gas = share * room, thickness = network.options.thickness;
	auto& contents = network.contents;
	returnedWater[c] = room - gas;
	network.books.gasIn += thickness * (gas - contents.gas[c]);
	network.books.waterIn += thickness * returnedWater[c];
	contents.gas[c] = gas;
	contents.water[c] += returnedWater[c];
	contents.gasMass[c] = density * gas;
}

std::vector<double> GasBooks::findCutOffPressures(const PoreNetwork& network, const SupplyOptions& supply,
        const GasClusters& clusters, double waterPressure) const
{
	std::vector<double> mass(clusters.count, 0), volume(clusters.count, 0);
	for (std::size_t c = 0; c < clusters.ofCell.size(); ++c)
		if (const int k = clusters.ofCell[c]; k > 0)
			mass[k] += network.contents.gasMass[c], volume[k] += network.contents.gas[c];
	std::vector<double> pressures(clusters.ofCell.size(), std::numeric_limits<double>::quiet_NaN());
	for (std::size_t c = 0; c < pressures.size(); ++c) {
		const int k = clusters.ofCell[c];
		if (k > 0 && mass[k] > 0 && volume[k] > 0)
			pressures[c] = std::max(
			        gasPressure(supply.gas, mass[k] / volume[k]) - supply.pressureDatum, waterPressure);
	}
	return pressures;
}

void GasBooks::followCutOff(const PoreNetwork& network, const SupplyOptions& supply,
        const std::vector<std::uint8_t>& shut, double waterPressure)
{
	if (cutOffPressures.empty()) return;
	cutOffPressures = namingGas(supply, [&] {
		return findCutOffPressures(
		        network, supply, gasClusters(network.mesh, network.contents, shut), waterPressure);
	});
}

void GasBooks::checkMass(const PoreNetwork& network) const
{
	if (std::abs(massIn(network) - injectedMass) <= 1e-10 * std::abs(injectedMass)) return;
	std::ostringstream text;
	text.precision(17);
	text << "invariant violated: " << massIn(network) << " kg of gas are there, " << injectedMass
	     << " kg were injected";
	throw std::logic_error(text.str());
}

} // namespace capfrac
