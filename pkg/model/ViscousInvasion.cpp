// SPDX-License-Identifier: GPL-2.0-or-later
#include "ViscousInvasion.hpp"

#include "../geometry/FluidWeight.hpp"
#include "../network/GasClusters.hpp"

#include <algorithm>
#include <cmath>

namespace capfrac {

namespace {

	/// Least volume of the reservoir, in mean cells [-].
	constexpr double leastReservoir = 1e-3;
	/// Share of a pore that gas gains within a level's least duration and still counts as at rest [-].
	constexpr double restingGain = 0.01;

} // namespace

void checkOptions(const ViscousOptions& o)
{
	requirePositive("gasViscosity [Pa·s]", o.gasViscosity);
	requirePositive("maxFilling [-]", o.maxFilling);
}

void ViscousInvasion::checkStart() const
{
	const std::string with = " in ViscousInvasionEngine";
	if (!gas.supply.gasCounted())
		refuseAttribute("gasLaw", gas.supply.lawName,
		        "IdealGas, TabulatedGas" + with + ": the pressure of the gas follows from its mass");
	if (!std::isfinite(flow.options.bulkModulus))
		refuseAttribute(
		        "bulkModulus [Pa]", flow.options.bulkModulus, "finite" + with + " (that of water is 2.2e9)");
	checkTogether(gas.supply, gas.waterPressure, gasPressure);
	checkTogether(gas.levels, gas.supply, gas.waterPressure);
}

void ViscousInvasion::fields(CarryOver& carry)
{
	carry.cells(cellLoad, gas.waterPressure);
	carry.cells(cellState, gas.waterPressure);
	carry.cells(cellHeld, 0);
	carry.edges(edgeAdvancing, 0);
}

TwoFluids ViscousInvasion::fluids() const
{
	TwoFluids fluids;
	fluids.waterBulkModulus = flow.options.bulkModulus, fluids.waterViscosity = flow.options.viscosity;
	fluids.gasViscosity = options.gasViscosity;
	fluids.gas = gas.supply.gas, fluids.datum = gas.supply.pressureDatum;
	return fluids;
}

/// Its least size gives the pressure of the reservoir a meaning.
double ViscousInvasion::reservoirSize(const PoreNetwork& network) const
{
	return std::max(gas.supply.reservoirVolume,
	        leastReservoir * network.books.initialVoid / static_cast<double>(network.mesh.cells.size()));
}

/// Both fluids begin at rest. The inlet was filled by volume: its gas has the pressure of the reservoir.
void ViscousInvasion::startFluids(PoreNetwork& network)
{
	const double thickness = network.options.thickness, density = gas.supply.densityAt(0);
	auto& contents = network.contents;
	auto& volumes = network.books;
	flow.start(network, gas.waterPressure);
	cellState.assign(network.mesh.cells.size(), gas.waterPressure);
	const auto weights = columns(network);
	if (weights.heavy()) letWaterRest(network);
	volumes.waterIn = volumes.gasIn = 0, volumes.initialWater = thickness * contents.totalWater();
	const auto voids = network.voids();
	const auto both = fluids();
	for (std::size_t c = 0; c < voids.size(); ++c) {
		const int cell = static_cast<int>(c);
		if (!network.isGas(cell)) continue;
		cellState[c] = gasPressure + weights.headsAt(network.voidCentre(cell)).gas;
		contents.gas[c] = voids[c] * gasRatio(both, cellState[c]);
		contents.gasMass[c] = density * contents.gas[c];
		volumes.gasIn += thickness * contents.gas[c];
	}
	books.started = true; // from here on by mass
	books.reservoirFilled = gas.supply.reservoirVolume;
	books.reservoirMass = gas.supply.densityAt(gasPressure) * reservoirSize(network);
	books.initialMass = books.injectedMass = books.massIn(network);
	cellLoad = cellState;
	cellHeld.assign(network.mesh.cells.size(), 0);
	edgeAdvancing.assign(network.mesh.edges.size(), 0);
	double held = 0, all = 0;
	for (std::size_t c = 0; c < voids.size(); ++c)
		all += voids[c], held += network.isGas(static_cast<int>(c)) ? voids[c] : 0;
	gasSaturation = held / all;
}

/// Fills the cells of water under the pressure at rest. By their first moments, in which pressure and amount are
/// linear: so a pore of several cells, too, has exactly the pressure at its centroid.
void ViscousInvasion::letWaterRest(PoreNetwork& network)
{
	const auto weights = columns(network);
	const Vec2 toDatum = weights.datum - Vec2 { network.box.left, network.box.bottom };
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
		const int cell = static_cast<int>(c);
		if (network.isGas(cell)) continue;
		const auto moments = voidMoments(network.mesh, cell, network.grains, network.box);
		network.contents.water[c] +=
		        dot(weights.weight(false), moments.first - moments.area * toDatum) / flow.options.bulkModulus;
		cellState[c] = gas.waterPressure + weights.headsAt(network.voidCentre(cell)).water;
	}
}

void ViscousInvasion::describe(PoreNetwork& network)
{
	const auto walls = outlets();
	for (int w = 0; w < nWalls; ++w) {
		const double given = flow.options.wallPressures[w];
		const bool isOutlet = std::find(walls.begin(), walls.end(), w) != walls.end();
		const bool open = std::isnan(given) && flow.options.wallFluxes[w] == 0 && isOutlet;
		flow.prescribed[w] = open ? gas.waterPressure : given;
	}
	flow.describe(network);
	weightForce = weightOfFluids(network);
}

// --- the step -------------------------------------------------------------------------------------

DisplacementStep ViscousInvasion::step(
        const PoreNetwork& network, TwoFluidNetwork& pores, const GrainAnswer& grains, double dt)
{
	return flow.namingPores([&] {
		auto answer = flow.skeleton(network, grains, weightForce);
		auto found = displace(pores, &answer, dt, flow.solver, { options.maxFilling });
		flow.checkGrowth(network, found.growth);
		return found;
	});
}

void ViscousInvasion::advance(PoreNetwork& network, const GrainAnswer& grains, const Moment& now)
{
	if (levels.start < 0) levels.start = static_cast<int>(now.iteration);
	checkStart();
	if (gas.supply.reservoirVolume != books.reservoirFilled) books.attachReservoir(gas.supply, gasPressure);
	describe(network);
	joinPhases(network);
	auto pores = twoFluidNetwork(network, grains);
	const auto before = pores.pores.back().gas;
	const auto done = step(network, pores, grains, now.dt);
	const double density = gas.supply.densityAt(0);
	network.books.waterIn += done.water.in - done.water.out;
	network.books.gasIn += done.gas.in - done.gas.out - (pores.pores.back().gas - before);
	books.reservoirMass = density * pores.pores.back().gas;
	books.injectedMass += density * (done.gas.in - done.gas.out);
	gasPressure = pores.pores.back().pressure;
	waterExcess = capfrac::waterExcess(pores);
	growth = done.growth;
	flowRecord.massDefect += done.water.defect() + done.gas.defect();
	flowRecord.nFactorizations += done.factored;
	flowRecord.solverIterations = done.iterations;
	recordEntries(network, grains, now, done);
	writeBack(network, pores, done, now.iteration);
}

void ViscousInvasion::recordEntries(
        const PoreNetwork& network, const GrainAnswer& grains, const Moment& now, const DisplacementStep& done)
{
	for (const auto& entry : done.entries) {
		const int e = edgeOfThroat[entry.throat];
		const auto& edge = network.mesh.edges[e];
		const int cell = flow.poreOfCell[edge.left] == entry.pore ? edge.left : edge.right;
		record(network, grains, now, e, network.domains.ofCell[cell]);
		lastEvent = static_cast<int>(now.iteration);
	}
}

/// Share of the void that holds gas; and gas that is still on its way into a pore counts as an event.
void ViscousInvasion::measureSaturation(const PoreNetwork& network, const TwoFluidNetwork& pores, long iteration)
{
	std::vector<double> gasBefore(flow.nPores, 0);
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c)
		gasBefore[flow.poreOfCell[c]] += network.options.thickness * network.contents.gas[c];
	double volume = 0, held = 0;
	for (int p = 0; p < flow.nPores; ++p) {
		const auto& pore = pores.pores[p];
		const double now = gasVolume(pores.fluids, pore.gas, pore.pressure + pore.held);
		volume += pore.volume, held += now;
		const double gain = now - gasVolume(pores.fluids, gasBefore[p], pore.pressure + pore.held);
		if (!pore.isGas && gain * gas.levels.minSteps > restingGain * pore.volume)
			lastEvent = static_cast<int>(iteration);
	}
	gasSaturation = held / volume;
}

void ViscousInvasion::writeBack(
        PoreNetwork& network, const TwoFluidNetwork& pores, const DisplacementStep& done, long iteration)
{
	measureSaturation(network, pores, iteration);
	auto& contents = network.contents;
	const std::size_t nCells = network.mesh.cells.size();
	const double density = gas.supply.densityAt(0);
	std::vector<double> sum(flow.nPores, 0);
	for (std::size_t c = 0; c < nCells; ++c)
		sum[flow.poreOfCell[c]] += std::max(0.0, flow.voids[c]);
	cellLoad.resize(nCells);
	for (std::size_t c = 0; c < nCells; ++c) {
		const int p = flow.poreOfCell[c];
		const auto& pore = pores.pores[p];
		// A pore has one pressure: its cells share what it holds by their voids; one with a negative void (in a
		// torn sample) may be a pore of its own in the next step, and must not owe anything then.
		const double share = std::max(0.0, flow.voids[c]) / (network.options.thickness * sum[p]);
		contents.water[c] = share * pore.water, contents.gas[c] = share * pore.gas;
		contents.gasMass[c] = density * contents.gas[c];
		contents.phase[c] = pore.isGas ? Phase::gas : Phase::water;
		cellLoad[c] = done.load[p];
		cellState[c] = pore.pressure, cellHeld[c] = pore.held;
	}
	std::fill(edgeAdvancing.begin(), edgeAdvancing.end(), 0);
	for (std::size_t t = 0; t < edgeOfThroat.size(); ++t)
		edgeAdvancing[edgeOfThroat[t]] = pores.throats[t].advancing;
	if (done.filled.empty() && done.lost.empty()) return;
	network.regroup();
	noteBreakthrough(network, iteration);
}

// --- what is asked --------------------------------------------------------------------------------

std::vector<double> ViscousInvasion::cellPressures(const PoreNetwork& network) const
{
	if (cellLoad.size() == network.mesh.cells.size()) return cellLoad;
	return std::vector<double>(network.mesh.cells.size(), gas.waterPressure);
}

FluidForces ViscousInvasion::loads(const PoreNetwork& network) const
{
	return flow.loads(network, cellPressures(network), weightForce);
}

/// As SinglePhase has it, with a weight per pore: where both fluids are in one, by their shares.
FluidForces ViscousInvasion::weightOfFluids(const PoreNetwork& network) const
{
	const std::size_t nCells = network.mesh.cells.size();
	if (!columns(network).heavy() || cellState.size() != nCells) return {};
	const auto both = fluids();
	const auto pores = twoFluidPores(network);
	const Vec2 corner { network.box.left, network.box.bottom };
	std::vector<double> atCentroid(nCells);
	std::vector<Vec2> weight(nCells);
	for (std::size_t c = 0; c < nCells; ++c) {
		const auto& pore = pores[flow.poreOfCell[c]];
		// From the fluid that does not flow through the pore: the other takes what room the grains leave it.
		const double water =
		        std::min(1.0, std::max(0.0, waterVolume(both, pore.water, pore.pressure) / pore.volume));
		const double share = pore.isGas ? 1 - water : gasShare(both, pore);
		const double density = share * gas.gasDensity + (1 - share) * gas.waterDensity;
		weight[c] = { density * gas.gravity.x, density * gas.gravity.y };
		atCentroid[c] = -dot(weight[c], flow.poreCentre[flow.poreOfCell[c]] - corner);
	}
	auto forces = fluidForces(flow.gradients, atCentroid, network.grains.size());
	forces += weightForces(network.mesh, network.grains, network.box, weight);
	return forces;
}

double ViscousInvasion::nextEntryPressure(const PoreNetwork& network) const
{
	const auto weights = columns(network);
	double lowest = std::numeric_limits<double>::infinity();
	const auto hanging = clusters(network);
	for (std::size_t e = 0; e < network.mesh.edges.size(); ++e) {
		const auto& edge = network.mesh.edges[e];
		if (edge.left < 0 || edge.right < 0 || network.isGas(edge.left) == network.isGas(edge.right)) continue;
		if (hanging.ofCell[network.isGas(edge.left) ? edge.left : edge.right] != 0) continue;
		lowest = std::min(lowest, entryPressureAtDatum(network, weights, static_cast<int>(e)));
	}
	return lowest;
}

} // namespace capfrac
