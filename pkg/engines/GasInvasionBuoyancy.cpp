// SPDX-License-Identifier: GPL-2.0-or-later
/// Pressures of GasInvasionEngine, place by place: columns of gas and of water at rest.

#include "GasInvasionEngine.hpp"
#include "Walls.hpp"

#include "../geometry/FluidWeight.hpp"
#include "../invasion/TrappedWater.hpp"

namespace yade {

bool GasInvasionEngine::heavy() const
{
	return (fluidDensity > 0 || gasDensity > 0) && (gravity[0] != 0 || gravity[1] != 0);
}

capfrac::Vec2 GasInvasionEngine::datum() const
{
	if (!inletPoints.empty()) {
		Vector2r sum = Vector2r::Zero();
		for (const auto& p : inletPoints)
			sum += p;
		return { sum[0] / inletPoints.size(), sum[1] / inletPoints.size() };
	}
	const Real middle = 0.5 * (inletFrom + inletTo);
	return reader.box.foot(wallFromName("inletWall", inletWall), { middle, middle });
}

/// What the pressures of both fluids at rest at a place exceed those at the datum by [Pa].
capfrac::FluidHeads GasInvasionEngine::headsAt(capfrac::Vec2 place) const
{
	if (!heavy()) return {};
	const auto from = datum();
	const Real fall = gravity[0] * (place.x - from.x) + gravity[1] * (place.y - from.y);
	return { fluidDensity * fall, gasDensity * fall };
}

/// What the capillary pressure at a place exceeds that at the datum by [Pa].
Real GasInvasionEngine::head(capfrac::Vec2 place) const
{
	if (!heavy()) return 0;
	const auto from = datum();
	return (gasDensity - fluidDensity) * (gravity[0] * (place.x - from.x) + gravity[1] * (place.y - from.y));
}

/// The middle of a gap; at a wall, the foot: the middle between the grain and its image.
capfrac::Vec2 GasInvasionEngine::throatPlace(int e) const
{
	const auto& edge = mesh.edges[e];
	const auto& a = reader.grains[edge.a];
	if (mesh.isWall(edge.b)) return reader.box.foot(mesh.wallOf(edge.b), a.centre);
	const auto& b = reader.grains[edge.b];
	return a.centre + (a.radius + 0.5 * gaps[e]) / capfrac::norm(b.centre - a.centre) * (b.centre - a.centre);
}

/// The capillary pressure at the datum at which gas enters a throat [Pa].
Real GasInvasionEngine::entryPressureAtDatum(int e) const
{
	const Real entry = throatEntryPressure(e);
	return heavy() ? entry - head(throatPlace(e)) : entry;
}

/// Per cell the pressure that its fluid has, or would have, at the datum [Pa].
std::vector<double> GasInvasionEngine::pressuresAtDatum() const
{
	std::vector<double> pressure(mesh.cells.size());
	for (std::size_t c = 0; c < pressure.size(); ++c)
		pressure[c] =
		        contents.phase[c] == capfrac::Phase::gas ? pressureOfGas(static_cast<int>(c)) : waterPressure;
	if (!trapping || filmConductance <= 0) return pressure;
	const auto network = drainageNetwork();
	for (const auto& cluster : capfrac::trappedClusters(network)) {
		if (cluster.throat < 0) continue;
		const Real held = math::max(waterPressure, gasPressure - network.throats[cluster.throat].entryPressure);
		for (int d : cluster.domains)
			for (int c : domains.cellsOf(d))
				pressure[c] = held;
	}
	return pressure;
}

capfrac::Vec2 GasInvasionEngine::weightOf(int cell) const
{
	const Real density = contents.phase[cell] == capfrac::Phase::gas ? gasDensity : fluidDensity;
	return { density * gravity[0], density * gravity[1] };
}

/// Centroid of what is void in a cell; the cell's own where grains that overlap leave none.
capfrac::Vec2 GasInvasionEngine::voidCentre(int cell) const
{
	const auto moments = capfrac::voidMoments(mesh, cell, reader.grains, reader.box);
	if (!(moments.area > 0)) return capfrac::cellCentre(mesh, cell, reader.grains, reader.box);
	return capfrac::Vec2 { reader.box.left, reader.box.bottom } + (1 / moments.area) * moments.first;
}

std::vector<double> GasInvasionEngine::cellPressures() const
{
	if (!drained()) return SinglePhaseFlowEngine::cellPressures();
	auto pressure = pressuresAtDatum();
	if (!heavy()) return pressure;
	const auto from = datum();
	for (std::size_t c = 0; c < pressure.size(); ++c)
		pressure[c] += capfrac::dot(weightOf(static_cast<int>(c)), voidCentre(static_cast<int>(c)) - from);
	return pressure;
}

/// A fluid at rest has the pressure p + w.(x - datum) = (p - w.datum) + w.x: the forces of a pressure per cell, and
/// those of the weights (geometry/FluidWeight).
capfrac::FluidForces GasInvasionEngine::forcesOfFluids() const
{
	if (!drained()) return SinglePhaseFlowEngine::forcesOfFluids();
	if (!heavy()) return PoreNetworkEngine::forcesOfFluids();
	auto pressure = pressuresAtDatum();
	std::vector<capfrac::Vec2> weight(pressure.size());
	const capfrac::Vec2 toDatum = datum() - capfrac::Vec2 { reader.box.left, reader.box.bottom };
	for (std::size_t c = 0; c < pressure.size(); ++c) {
		weight[c] = weightOf(static_cast<int>(c));
		pressure[c] -= capfrac::dot(weight[c], toDatum);
	}
	auto forces = capfrac::fluidForces(mesh, pressure, reader.grains, reader.box);
	forces += capfrac::weightForces(mesh, reader.grains, reader.box, weight);
	return forces;
}

// --- solved water -----------------------------------------------------------------------------------

/// Fills the cells of water under the pressure at rest. By their first moments, in which pressure and amount are
/// linear: so a pore of several cells, too, has exactly the pressure at its centroid.
void GasInvasionEngine::letWaterRest()
{
	const capfrac::Vec2 toDatum = datum() - capfrac::Vec2 { reader.box.left, reader.box.bottom };
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int cell = static_cast<int>(c);
		if (contents.phase[c] == capfrac::Phase::gas) continue;
		const auto moments = capfrac::voidMoments(mesh, cell, reader.grains, reader.box);
		contents.water[c] += capfrac::dot(weightOf(cell), moments.first - moments.area * toDatum) / bulkModulus;
		cellState[c] = waterPressure + headsAt(voidCentre(cell)).water;
	}
}

/// As SinglePhaseFlowEngine has it, with a weight per pore: where both fluids are in one, by their shares.
capfrac::FluidForces GasInvasionEngine::weightOfFluid() const
{
	if (drained() || !heavy() || cellState.size() != mesh.cells.size()) return {};
	const auto fluids = twoFluids();
	const auto pores = twoFluidPores();
	const capfrac::Vec2 corner { reader.box.left, reader.box.bottom };
	std::vector<double> atCentroid(mesh.cells.size());
	std::vector<capfrac::Vec2> weight(mesh.cells.size());
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const auto& pore = pores[poreOfCell[c]];
		// From the fluid that does not flow through the pore: the other takes what room the grains leave it.
		const Real water = math::min(Real(1),
		        math::max(Real(0), capfrac::waterVolume(fluids, pore.water, pore.pressure) / pore.volume));
		const Real share = pore.isGas ? 1 - water : capfrac::gasShare(fluids, pore);
		const Real density = share * gasDensity + (1 - share) * fluidDensity;
		weight[c] = { density * gravity[0], density * gravity[1] };
		atCentroid[c] = -capfrac::dot(weight[c], poreCentre[poreOfCell[c]] - corner);
	}
	auto forces = capfrac::fluidForces(gradients, atCentroid, reader.grains.size());
	forces += capfrac::weightForces(mesh, reader.grains, reader.box, weight);
	return forces;
}

} // namespace yade
