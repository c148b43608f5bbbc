// SPDX-License-Identifier: GPL-2.0-or-later
/// Pressures of DrainedInvasion, place by place: columns of gas and of water at rest, and how they load the grains.

#include "DrainedInvasion.hpp"

#include "../geometry/FluidWeight.hpp"
#include "../invasion/TrappedWater.hpp"

#include <cmath>

namespace capfrac {

/// Pressure of the gas in a cell that holds gas [Pa], at the datum.
double DrainedInvasion::pressureOfGas(const PoreNetwork& network, int cell) const
{
	if (network.contents.held[cell]) return network.contents.heldPressure[cell];
	if (!gas.supply.gasCounted() || !books.started) return gasPressure;
	const auto& cutOff = books.cutOffPressures;
	return cutOff.size() == network.mesh.cells.size() && std::isfinite(cutOff[cell]) ? cutOff[cell] : gasPressure;
}

/// Per cell the pressure that its fluid has, or would have, at the datum [Pa].
std::vector<double> DrainedInvasion::pressuresAtDatum(const PoreNetwork& network) const
{
	std::vector<double> pressure(network.mesh.cells.size());
	for (std::size_t c = 0; c < pressure.size(); ++c) {
		const int cell = static_cast<int>(c);
		pressure[c] = network.isGas(cell) ? pressureOfGas(network, cell) : gas.waterPressure;
	}
	if (!options.trapping || gas.filmConductance <= 0) return pressure;
	const auto drainage = drainageNetwork(network);
	for (const auto& cluster : trappedClusters(drainage)) {
		if (cluster.throat < 0) continue;
		const double held =
		        std::max(gas.waterPressure, gasPressure - drainage.throats[cluster.throat].entryPressure);
		for (int d : cluster.domains)
			for (int c : network.domains.cellsOf(d))
				pressure[c] = held;
	}
	return pressure;
}

std::vector<double> DrainedInvasion::cellPressures(const PoreNetwork& network) const
{
	auto pressure = pressuresAtDatum(network);
	const auto weights = columns(network);
	if (!weights.heavy()) return pressure;
	for (std::size_t c = 0; c < pressure.size(); ++c) {
		const int cell = static_cast<int>(c);
		pressure[c] += dot(weights.weight(network.isGas(cell)), network.voidCentre(cell) - weights.datum);
	}
	return pressure;
}

/// A fluid at rest has the pressure p + w.(x - datum) = (p - w.datum) + w.x: the forces of a pressure per cell, and
/// those of the weights (geometry/FluidWeight).
FluidForces DrainedInvasion::loads(const PoreNetwork& network) const
{
	const auto weights = columns(network);
	if (!weights.heavy()) return FluidModel::loads(network);
	auto pressure = pressuresAtDatum(network);
	std::vector<Vec2> weight(pressure.size());
	const Vec2 toDatum = weights.datum - Vec2 { network.box.left, network.box.bottom };
	for (std::size_t c = 0; c < pressure.size(); ++c) {
		weight[c] = weights.weight(network.isGas(static_cast<int>(c)));
		pressure[c] -= dot(weight[c], toDatum);
	}
	auto forces = fluidForces(network.mesh, pressure, network.grains, network.box);
	forces += weightForces(network.mesh, network.grains, network.box, weight);
	return forces;
}

} // namespace capfrac
