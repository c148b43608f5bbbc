// SPDX-License-Identifier: GPL-2.0-or-later
/// The pores of GasInvasionEngine as a problem of two fluids: phases, throats, boundaries, the reservoir.

#include "GasInvasionEngine.hpp"

#include <utility>

namespace yade {

namespace {

	/// Conductance from the reservoir to a pore of the inlet over that of the widest throat [-]: no obstacle, and
	/// well conditioned.
	constexpr Real inletConductance = 100;
	/// Negative amounts up to this share of a pore are round-off and go to the books [-].
	constexpr Real roundOff = 1e-9;

} // namespace

/// A pore that was closed and joined to its neighbour takes over that neighbour's phase.
void GasInvasionEngine::joinPhases()
{
	std::vector<Real> asGas(nPores, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		asGas[poreOfCell[c]] += contents.phase[c] == capfrac::Phase::gas ? thickness * voids[c] : 0;
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		contents.phase[c] = asGas[poreOfCell[c]] > 0.5 * poreVolume[poreOfCell[c]] ? capfrac::Phase::gas
		                                                                           : capfrac::Phase::water;
}

/// Where the menisci of the pores are the least curved: in the widest of their cells.
std::vector<Real> GasInvasionEngine::bodyPressures() const
{
	std::vector<Real> radius(nPores, 0), pressure(nPores, std::numeric_limits<Real>::max());
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		auto& widest = radius[poreOfCell[c]];
		widest = math::max(
		        widest, capfrac::poreBody(mesh, static_cast<int>(c), reader.grains, reader.box).radius);
	}
	for (int p = 0; p < nPores; ++p)
		if (radius[p] > 0) pressure[p] = capfrac::refillPressure(radius[p], interfacialTension, contactAngle);
	return pressure;
}

/// What the pores hold, and under what pressures it was at the end of the last step.
std::vector<capfrac::TwoFluidPore> GasInvasionEngine::twoFluidPores() const
{
	std::vector<capfrac::TwoFluidPore> pores(nPores);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		auto& pore = pores[poreOfCell[c]];
		pore.water += thickness * contents.water[c], pore.gas += thickness * contents.gas[c];
		pore.held += thickness * contents.gas[c] * cellHeld[c];
		pore.pressure += thickness * voids[c] * cellState[c];
		pore.isGas = contents.phase[c] == capfrac::Phase::gas;
	}
	for (int p = 0; p < nPores; ++p) {
		auto& pore = pores[p];
		pore.volume = poreVolume[p];
		pore.pressure /= poreVolume[p];
		pore.held = pore.isGas || !(pore.gas > 0) ? 0 : pore.held / pore.gas;
		pore.head = headsAt(poreCentre[p]);
	}
	return pores;
}

capfrac::TwoFluidNetwork GasInvasionEngine::twoFluidNetwork()
{
	capfrac::TwoFluidNetwork network;
	network.fluids = twoFluids();
	network.filmConductance = filmConductance, network.filmPressure = waterPressure;
	network.pores = twoFluidPores();
	const auto bodies = bodyPressures();
	capfrac::FlowNetwork boundaries;
	boundaries.pores.resize(nPores);
	addBoundaries(boundaries);
	for (int p = 0; p < nPores; ++p) {
		auto& pore = network.pores[p];
		// Cells of a torn sample may have a negative void, and share of what is there: sums that cancel leave
		// round-off.
		for (auto [amount, books] : { std::pair(&pore.gas, &gasIn), std::pair(&pore.water, &waterIn) })
			if (*amount < 0 && *amount > -roundOff * pore.volume) *books -= std::exchange(*amount, 0);
		pore.bodyPressure = bodies[p];
		if (pore.isGas) continue;
		pore.fixedPressure = boundaries.pores[p].fixedPressure, pore.source = boundaries.pores[p].source;
		if (pore.fixedPressure)
			*pore.fixedPressure += pore.head.water; // what is prescribed is the pressure at the datum
	}
	edgeOfThroat.clear();
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto flow = throatAt(static_cast<int>(e));
		if (!flow) continue;
		capfrac::TwoFluidThroat throat { flow->a, flow->b, flow->conductance * viscosity,
			throatEntryPressure(static_cast<int>(e)) };
		throat.advancing = edgeAdvancing[e] != 0;
		throat.head = headsAt(throatPlace(static_cast<int>(e)));
		network.throats.push_back(throat);
		edgeOfThroat.push_back(static_cast<int>(e));
	}
	addReservoir(network);
	return network;
}

void GasInvasionEngine::addReservoir(capfrac::TwoFluidNetwork& network) const
{
	Real widest = 0;
	for (const auto& throat : network.throats)
		widest = math::max(widest, throat.conductance);
	capfrac::TwoFluidPore reservoir; // at the datum: without heads
	reservoir.isGas = true;
	reservoir.volume = reservoirSize();
	reservoir.pressure = gasPressure;
	reservoir.gas = reservoirMass / densityAt(0);
	if (control == GasControl::pressure)
		reservoir.fixedPressure = gasPressure;
	else if (control == GasControl::rate)
		reservoir.source = gasRate / densityAt(0);
	network.pores.push_back(reservoir);
	std::vector<char> joined(nPores, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int p = poreOfCell[c];
		if (!contents.source[c] || !network.pores[p].isGas || std::exchange(joined[p], 1)) continue;
		network.throats.push_back({ nPores, p, inletConductance * widest });
	}
}

} // namespace yade
