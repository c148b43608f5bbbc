// SPDX-License-Identifier: GPL-2.0-or-later
/// Gas and water of GasInvasionEngine where both are solved for: what goes together, the start, the step.

#include "Attributes.hpp"
#include "GasInvasionEngine.hpp"
#include "Walls.hpp"

#include <algorithm>

namespace yade {

namespace {

	/// Least volume of the reservoir, in mean cells [-].
	constexpr Real leastReservoir = 1e-3;
	/// Share of a pore that gas gains within a level's least duration and still counts as at rest [-].
	constexpr Real restingGain = 0.01;

} // namespace

void GasInvasionEngine::checkWaterFlow() const
{
	using namespace capfrac;
	if (waterFlow != "drained" && waterFlow != "solved")
		refuseAttribute("waterFlow", "'" + waterFlow + "'", "'drained', 'solved'");
	requirePositive("gasViscosity [Pa·s]", gasViscosity);
	requirePositive("maxFilling [-]", maxFilling);
}

/// What only the whole of the attributes shows; at assignment, one would have to come before the other.
void GasInvasionEngine::checkDisplacementTogether() const
{
	using capfrac::refuseAttribute;
	const std::string with = " with waterFlow = 'solved'";
	if (gasState.law == capfrac::GasLaw::incompressible)
		refuseAttribute("gasLaw", "'" + gasLaw + "'",
		        "'ideal', 'tabulated'" + with + ": the pressure of the gas follows from its mass");
	if (!std::isfinite(bulkModulus))
		refuseAttribute("bulkModulus [Pa]", bulkModulus, "finite" + with + " (that of water is 2.2e9)");
	if (timeIntegration != "undrainedStable")
		refuseAttribute("timeIntegration", "'" + timeIntegration + "'", "'undrainedStable'" + with);
	if (imbibition) refuseAttribute("imbibition", imbibition, "false" + with + ": gas does not recede");
	checkSupplyTogether();
}

Real GasInvasionEngine::prescribedPressure(int wall) const
{
	const Real given = wallPressures[wall];
	if (drained() || !math::isnan(given) || wallFluxes[wall] != 0) return given;
	const auto outlets = wallsFromName("outletWall", outletWall);
	return std::find(outlets.begin(), outlets.end(), wall) != outlets.end() ? waterPressure : NaN;
}

void GasInvasionEngine::beforeReport()
{
	if (!drained()) SinglePhaseFlowEngine::beforeReport();
}

void GasInvasionEngine::followRemesh(const capfrac::Triangulation& before)
{
	if (!snapped.empty()) snapped = capfrac::carryOverEdges(before, snapped, mesh, 0);
	followCutOff();
	if (drained()) return;
	SinglePhaseFlowEngine::followRemesh(before);
	carryOverCells(cellState, before, waterPressure);
	carryOverCells(cellHeld, before, 0);
	const std::vector<std::uint8_t> flags(edgeAdvancing.begin(), edgeAdvancing.end());
	const auto carried = capfrac::carryOverEdges(before, flags, mesh, 0);
	edgeAdvancing.assign(carried.begin(), carried.end());
}

capfrac::TwoFluids GasInvasionEngine::twoFluids() const
{
	capfrac::TwoFluids fluids;
	fluids.waterBulkModulus = bulkModulus, fluids.waterViscosity = viscosity, fluids.gasViscosity = gasViscosity;
	fluids.gas = gasState, fluids.datum = pressureDatum;
	return fluids;
}

/// Its least size gives the pressure of the reservoir a meaning.
Real GasInvasionEngine::reservoirSize() const
{
	return math::max(reservoirVolume, leastReservoir * initialVoid / mesh.cells.size());
}

/// Both fluids begin at rest. The inlet was filled by volume: its gas has the pressure of the reservoir.
void GasInvasionEngine::startDisplacement()
{
	const auto fluids = twoFluids();
	const Real density = densityAt(0);
	cellState.assign(mesh.cells.size(), waterPressure);
	if (heavy()) letWaterRest();
	waterIn = 0, gasIn = 0, initialWater = thickness * contents.totalWater();
	const auto voidsNow = currentVoids();
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		if (contents.phase[c] != capfrac::Phase::gas) continue;
		cellState[c] = gasPressure + headsAt(voidCentre(static_cast<int>(c))).gas;
		contents.gas[c] = voidsNow[c] * capfrac::gasRatio(fluids, cellState[c]);
		contents.gasMass[c] = density * contents.gas[c];
		gasIn += thickness * contents.gas[c];
	}
	reservoirFilled = reservoirVolume, reservoirMass = densityAt(gasPressure) * reservoirSize();
	initialGasMass = injectedGasMass = gasMassIn();
	massStarted = true;
	cellPressure = cellState;
	cellHeld.assign(mesh.cells.size(), 0);
	edgeAdvancing.assign(mesh.edges.size(), 0);
}

// --- the step -------------------------------------------------------------------------------------

void GasInvasionEngine::displaceWater()
{
	checkDisplacementTogether();
	if (cellState.size() != mesh.cells.size())
		capfrac::refuseAttribute("waterFlow", "'" + waterFlow + "'",
		        "'drained' once the gas is in drained water: what the pores hold is not known by mass");
	if (reservoirVolume != reservoirFilled) attachReservoir();
	describePores();
	joinPhases();
	auto network = twoFluidNetwork();
	const auto before = network.pores.back().gas;
	const auto done = namingPores([&] {
		capfrac::Skeleton grains;
		if (grainsMove())
			grains = skeleton();
		else
			grains.compression = compression(); // they do not move, but may be compressed
		auto found = capfrac::displace(network, &grains, scene->dt, solver, { maxFilling });
		compressGrains(found.growth);
		return found;
	});
	waterIn += done.water.in - done.water.out;
	gasIn += done.gas.in - done.gas.out - (network.pores.back().gas - before);
	const Real density = densityAt(0); // and the books of GasInvasionSupply.cpp
	reservoirMass = density * network.pores.back().gas;
	injectedGasMass += density * (done.gas.in - done.gas.out);
	gasPressure = network.pores.back().pressure;
	waterExcess = capfrac::waterExcess(network);
	massDefect += done.water.defect() + done.gas.defect();
	nFactorizations += done.factored;
	solverIterations = done.iterations;
	recordEntries(done);
	writeBack(network, done);
}

void GasInvasionEngine::recordEntries(const capfrac::DisplacementStep& done)
{
	for (const auto& entry : done.entries) {
		const int e = edgeOfThroat[entry.throat];
		const auto edge = mesh.edges[e];
		const int cell = poreOfCell[edge.left] == entry.pore ? edge.left : edge.right;
		record(e, domains.ofCell[cell]);
		lastEventIter = static_cast<int>(scene->iter);
	}
}

void GasInvasionEngine::writeBack(const capfrac::TwoFluidNetwork& network, const capfrac::DisplacementStep& done)
{
	std::vector<Real> gasBefore(nPores, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		gasBefore[poreOfCell[c]] += thickness * contents.gas[c];
	Real volume = 0, gas = 0;
	for (int p = 0; p < nPores; ++p) {
		const auto& pore = network.pores[p];
		const Real now = capfrac::gasVolume(network.fluids, pore.gas, pore.pressure + pore.held);
		volume += pore.volume, gas += now;
		const Real gain = now - capfrac::gasVolume(network.fluids, gasBefore[p], pore.pressure + pore.held);
		if (!pore.isGas && gain * minLevelSteps > restingGain * pore.volume)
			lastEventIter = static_cast<int>(scene->iter); // gas is on its way
	}
	gasSaturation = gas / volume;
	const Real density = densityAt(0);
	std::vector<Real> sum(nPores, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		sum[poreOfCell[c]] += math::max(Real(0), voids[c]);
	cellPressure.resize(mesh.cells.size());
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int p = poreOfCell[c];
		const auto& pore = network.pores[p];
		// A pore has one pressure: its cells share what it holds by their voids; one with a negative void (in a
		// torn sample) may be a pore of its own in the next step, and must not owe anything then.
		const Real share = math::max(Real(0), voids[c]) / (thickness * sum[p]);
		contents.water[c] = share * pore.water, contents.gas[c] = share * pore.gas;
		contents.gasMass[c] = density * contents.gas[c];
		contents.phase[c] = pore.isGas ? capfrac::Phase::gas : capfrac::Phase::water;
		cellPressure[c] = done.load[p];
		cellState[c] = pore.pressure, cellHeld[c] = pore.held;
	}
	std::fill(edgeAdvancing.begin(), edgeAdvancing.end(), 0);
	for (std::size_t t = 0; t < edgeOfThroat.size(); ++t)
		edgeAdvancing[edgeOfThroat[t]] = network.throats[t].advancing;
	if (done.filled.empty() && done.lost.empty()) return;
	findDomains();
	noteBreakthrough();
}

} // namespace yade
