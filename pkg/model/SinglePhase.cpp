// SPDX-License-Identifier: GPL-2.0-or-later
#include "SinglePhase.hpp"

#include "../geometry/FluidWeight.hpp"

#include <cmath>

namespace capfrac {

void checkWeight(Vec2 gravity, bool weightless)
{
	if (!weightless || dot(gravity, gravity) == 0) return;
	std::ostringstream value;
	value << "(" << gravity.x << ", " << gravity.y << ")";
	refuseAttribute("gravity [m/s²]", value.str(),
	        "(0, 0) while no fluid has a density (fluidDensity), as it acts on fluids alone");
}

void SinglePhase::start(PoreNetwork& network, const Moment&)
{
	checkWeight(flow.options.gravity, flow.options.density == 0);
	flow.start(network, initialPressure);
	network.books.initialWater = network.options.thickness * network.contents.totalWater();
	cellPressure.clear();
}

void SinglePhase::describe(const PoreNetwork& network)
{
	for (int w = 0; w < nWalls; ++w)
		flow.prescribed[w] = flow.options.wallPressures[w];
	flow.describe(network);
	weightForce = weightOfFluid(network);
}

FlowStep SinglePhase::step(const PoreNetwork& network, FlowNetwork& pores, const GrainAnswer& grains, double dt)
{
	if (flow.options.scheme == FlowScheme::explicitEuler)
		return explicitStep(pores, {}, dt, flow.compression(network));
	if (flow.options.scheme == FlowScheme::implicit || !grains.move())
		return implicitStep(pores, {}, dt, flow.solver, flow.compression(network));
	return coupledStep(pores, flow.skeleton(network, grains, weightForce), dt, flow.solver);
}

void SinglePhase::advance(PoreNetwork& network, const GrainAnswer& grains, const Moment& now)
{
	describe(network);
	auto pores = flow.flowNetwork(network, grains);
	const auto done = flow.namingPores([&] {
		auto found = step(network, pores, grains, now.dt);
		flow.checkGrowth(network, found.growth);
		return found;
	});
	growth = done.growth;
	// A pore has one pressure: its cells share its mass by their voids.
	cellPressure.resize(network.mesh.cells.size());
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
		const int p = flow.poreOfCell[c];
		network.contents.water[c] = pores.pores[p].mass / flow.poreVolume[p] * flow.voids[c];
		cellPressure[c] = done.pressure[p];
	}
	network.books.waterIn += done.ledger.in - done.ledger.out;
	record.massDefect += done.ledger.defect();
	record.solverIterations = done.iterations;
	record.nFactorizations += done.factored;
	record.inflow = flow.wallInflow(done.supply);
}

std::vector<double> SinglePhase::cellPressures(const PoreNetwork& network) const
{
	if (cellPressure.size() == network.mesh.cells.size()) return cellPressure;
	return std::vector<double>(network.mesh.cells.size(), initialPressure);
}

FluidForces SinglePhase::loads(const PoreNetwork& network) const
{
	return flow.loads(network, cellPressures(network), weightForce);
}

FluidForces SinglePhase::weightOfFluid(const PoreNetwork& network) const
{
	const Vec2 weight = flow.options.density * flow.options.gravity,
	           corner { network.box.left, network.box.bottom };
	if (weight.x == 0 && weight.y == 0) return {};
	// The excess pressures p - w x_p: p is added by loads().
	std::vector<double> atCentroid(network.mesh.cells.size());
	for (std::size_t c = 0; c < atCentroid.size(); ++c)
		atCentroid[c] = -dot(weight, flow.poreCentre[flow.poreOfCell[c]] - corner);
	auto forces = fluidForces(flow.gradients, atCentroid, network.grains.size());
	forces += weightForces(network.mesh, network.grains, network.box, weight);
	return forces;
}

double SinglePhase::timeStepLimit(PoreNetwork& network, const GrainAnswer& grains)
{
	describe(network);
	return explicitTimeStepLimit(flow.flowNetwork(network, grains));
}

void SinglePhase::setPressures(PoreNetwork& network, const std::vector<double>& pressures)
{
	if (!std::isfinite(flow.options.bulkModulus))
		throw std::invalid_argument(
		        "setCellPressures: an incompressible fluid has no pressures of its own; prescribe "
		        "them at boundaries");
	const auto voids = network.voids();
	for (std::size_t c = 0; c < voids.size(); ++c)
		network.contents.water[c] = massAt(pressures[c], voids[c], flow.options.bulkModulus);
	auto& books = network.books;
	books.initialWater =
	        network.options.thickness * network.contents.totalWater() - books.waterIn; // a new beginning
	cellPressure = pressures;
}

} // namespace capfrac
