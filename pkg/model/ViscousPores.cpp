// SPDX-License-Identifier: GPL-2.0-or-later
/// The pores of ViscousInvasion as a problem of two fluids: phases, throats, boundaries, the reservoir.

#include "ViscousInvasion.hpp"

#include "../laws/Refill.hpp"

#include <utility>

namespace capfrac {

namespace {

	/// Conductance from the reservoir to a pore of the inlet over that of the widest throat [-]: no obstacle, and
	/// well conditioned.
	constexpr double inletConductance = 100;
	/// Negative amounts up to this share of a pore are round-off and go to the books [-].
	constexpr double roundOff = 1e-9;

} // namespace

/// A pore that was closed and joined to its neighbour takes over that neighbour's phase.
void ViscousInvasion::joinPhases(PoreNetwork& network) const
{
	const auto& pore = flow.poreOfCell;
	std::vector<double> asGas(flow.nPores, 0);
	for (std::size_t c = 0; c < pore.size(); ++c)
		asGas[pore[c]] += network.isGas(static_cast<int>(c)) ? network.options.thickness * flow.voids[c] : 0;
	for (std::size_t c = 0; c < pore.size(); ++c)
		network.contents.phase[c] = asGas[pore[c]] > 0.5 * flow.poreVolume[pore[c]] ? Phase::gas : Phase::water;
}

/// Where the menisci of the pores are the least curved: in the widest of their cells.
std::vector<double> ViscousInvasion::bodyPressures(const PoreNetwork& network) const
{
	std::vector<double> radius(flow.nPores, 0), pressure(flow.nPores, std::numeric_limits<double>::max());
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
		auto& widest = radius[flow.poreOfCell[c]];
		const auto body = poreBody(network.mesh, static_cast<int>(c), network.grains, network.box);
		widest = std::max(widest, body.radius);
	}
	for (int p = 0; p < flow.nPores; ++p)
		if (radius[p] > 0) pressure[p] = refillPressure(radius[p], gas.tension, gas.contactAngle);
	return pressure;
}

/// What the pores hold, and under what pressures it was at the end of the last step.
std::vector<TwoFluidPore> ViscousInvasion::twoFluidPores(const PoreNetwork& network) const
{
	const double thickness = network.options.thickness;
	const auto& contents = network.contents;
	const auto weights = columns(network);
	std::vector<TwoFluidPore> pores(flow.nPores);
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
		auto& pore = pores[flow.poreOfCell[c]];
		pore.water += thickness * contents.water[c], pore.gas += thickness * contents.gas[c];
		pore.held += thickness * contents.gas[c] * cellHeld[c];
		pore.pressure += thickness * flow.voids[c] * cellState[c];
		pore.isGas = contents.phase[c] == Phase::gas;
	}
	for (int p = 0; p < flow.nPores; ++p) {
		auto& pore = pores[p];
		pore.volume = flow.poreVolume[p];
		pore.pressure /= flow.poreVolume[p];
		pore.held = pore.isGas || !(pore.gas > 0) ? 0 : pore.held / pore.gas;
		pore.head = weights.headsAt(flow.poreCentre[p]);
	}
	return pores;
}

TwoFluidNetwork ViscousInvasion::twoFluidNetwork(PoreNetwork& network, const GrainAnswer& grains)
{
	TwoFluidNetwork pores;
	pores.fluids = fluids();
	pores.filmConductance = gas.filmConductance, pores.filmPressure = gas.waterPressure;
	pores.pores = twoFluidPores(network);
	const auto bodies = bodyPressures(network);
	FlowNetwork boundaries;
	boundaries.pores.resize(flow.nPores);
	flow.addBoundaries(network, boundaries);
	auto& volumes = network.books;
	for (int p = 0; p < flow.nPores; ++p) {
		auto& pore = pores.pores[p];
		// Cells of a torn sample may have a negative void, and share of what is there: sums that cancel leave
		// round-off.
		for (auto [amount, book] :
		        { std::pair(&pore.gas, &volumes.gasIn), std::pair(&pore.water, &volumes.waterIn) })
			if (*amount < 0 && *amount > -roundOff * pore.volume) *book -= std::exchange(*amount, 0);
		pore.bodyPressure = bodies[p];
		if (pore.isGas) continue;
		pore.fixedPressure = boundaries.pores[p].fixedPressure, pore.source = boundaries.pores[p].source;
		if (pore.fixedPressure)
			*pore.fixedPressure += pore.head.water; // what is prescribed is that at the datum
	}
	addThroats(network, grains, pores);
	addReservoir(network, pores);
	return pores;
}

void ViscousInvasion::addThroats(const PoreNetwork& network, const GrainAnswer& grains, TwoFluidNetwork& pores)
{
	const auto weights = columns(network);
	edgeOfThroat.clear();
	for (std::size_t e = 0; e < network.mesh.edges.size(); ++e) {
		const int edge = static_cast<int>(e);
		const auto found = flow.throatAt(network, edge, grains);
		if (!found) continue;
		TwoFluidThroat throat { found->a, found->b, found->conductance * flow.options.viscosity,
			entryPressureOf(network, edge) };
		throat.advancing = edgeAdvancing[e] != 0;
		throat.head = weights.headsAt(network.throatPlace(edge));
		pores.throats.push_back(throat);
		edgeOfThroat.push_back(edge);
	}
}

void ViscousInvasion::addReservoir(const PoreNetwork& network, TwoFluidNetwork& pores) const
{
	const double density = gas.supply.densityAt(0);
	double widest = 0;
	for (const auto& throat : pores.throats)
		widest = std::max(widest, throat.conductance);
	TwoFluidPore reservoir; // at the datum: without heads
	reservoir.isGas = true;
	reservoir.volume = reservoirSize(network);
	reservoir.pressure = gasPressure;
	reservoir.gas = books.reservoirMass / density;
	if (gas.supply.control == GasControl::pressure) reservoir.fixedPressure = gasPressure;
	if (gas.supply.control == GasControl::rate) reservoir.source = gas.supply.rate / density;
	pores.pores.push_back(reservoir);
	std::vector<char> joined(flow.nPores, 0);
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
		const int p = flow.poreOfCell[c];
		if (!network.contents.source[c] || !pores.pores[p].isGas || std::exchange(joined[p], 1)) continue;
		pores.throats.push_back({ flow.nPores, p, inletConductance * widest });
	}
}

} // namespace capfrac
