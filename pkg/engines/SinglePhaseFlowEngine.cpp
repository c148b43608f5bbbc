// SPDX-License-Identifier: GPL-2.0-or-later
#include "SinglePhaseFlowEngine.hpp"
#include "Walls.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace yade {

YADE_PLUGIN((SinglePhaseFlowEngine));
CREATE_LOGGER(SinglePhaseFlowEngine);

void SinglePhaseFlowEngine::checkAttributes() const
{
	using namespace capfrac;
	PoreNetworkEngine::checkAttributes();
	if (!(bulkModulus > 0)) refuseAttribute("bulkModulus [Pa]", bulkModulus, "> 0, or infinity");
	requirePositive("viscosity [Pa·s]", viscosity);
	conductanceLawFromName(conductanceLaw);
	requirePositive("conductanceFactor [-]", conductanceFactor);
	requireNotNegative("residualAperture [m]", residualAperture);
	requirePositive("halvingForce [N]", halvingForce);
	if (timeIntegration != "undrainedStable" && timeIntegration != "implicit" && timeIntegration != "explicit")
		refuseAttribute(
		        "timeIntegration", "'" + timeIntegration + "'", "'undrainedStable', 'implicit', 'explicit'");
	requireNotNegative("fluidDensity [kg/m³]", fluidDensity);
	requireFinite("gravity [m/s²]", gravity.squaredNorm());
	requirePositive("closedPore [-]", closedPore);
	if (!(grainBulkModulus > 0)) refuseAttribute("grainBulkModulus [Pa]", grainBulkModulus, "> 0, or infinity");
	if (wallPressures.size() != nWalls)
		refuseAttribute("wallPressures", wallPressures.size(), "four values: left, right, bottom, top");
	if (wallFluxes.size() != nWalls)
		refuseAttribute("wallFluxes", wallFluxes.size(), "four values: left, right, bottom, top");
	for (int w = 0; w < nWalls; ++w) {
		if (!math::isnan(wallPressures[w])) requireFinite("wallPressures [Pa]", wallPressures[w]);
		requireFinite("wallFluxes [m³/s]", wallFluxes[w]);
		if (!math::isnan(wallPressures[w]) && wallFluxes[w] != 0)
			refuseAttribute("wallFluxes [m³/s]", wallFluxes[w],
			        std::string("0 where wallPressures prescribes a pressure (the ") + wallName(w)
			                + " wall is named twice)");
	}
	for (const auto& p : pointPressures)
		requireFinite("pointPressures", p.squaredNorm());
	for (const auto& p : pointFluxes)
		requireFinite("pointFluxes", p.squaredNorm());
}

void SinglePhaseFlowEngine::guardAttributes()
{
	accepted.guard(std::tie(bulkModulus, viscosity, conductanceLaw, conductanceFactor, residualAperture,
	                       halvingForce, timeIntegration, wallPressures, wallFluxes, pointPressures, pointFluxes,
	                       fluidDensity, gravity, closedPore, grainBulkModulus),
	        [this] { SinglePhaseFlowEngine::checkAttributes(); });
	conductance = capfrac::conductanceLawFromName(conductanceLaw);
	scheme = timeIntegration == "explicit"  ? Scheme::explicitEuler
	        : timeIntegration == "implicit" ? Scheme::implicit
	                                        : Scheme::undrainedStable;
}

/// The old factor decides the last bits of the next pressures: a run goes on as if it had not been saved.
void SinglePhaseFlowEngine::preSave(SinglePhaseFlowEngine&)
{
	auto memory = solver.memory();
	savedSolverStart = std::move(memory.start), savedSolverRow = std::move(memory.row),
	savedSolverValue = std::move(memory.value);
}

/// Else the next assignment, at which YADE calls postLoad(), would take the solver back to where it was saved.
void SinglePhaseFlowEngine::postSave(SinglePhaseFlowEngine&)
{
	savedSolverStart.clear(), savedSolverRow.clear(), savedSolverValue.clear();
}

void SinglePhaseFlowEngine::postLoad(SinglePhaseFlowEngine&)
{
	guardAttributes();
	if (savedSolverStart.empty()) return;
	solver.recall({ std::exchange(savedSolverStart, {}), std::exchange(savedSolverRow, {}),
	        std::exchange(savedSolverValue, {}) });
}

void SinglePhaseFlowEngine::checkWeight() const
{
	if (!weightless() || gravity.squaredNorm() == 0) return;
	std::ostringstream value;
	value << "(" << gravity[0] << ", " << gravity[1] << ")";
	capfrac::refuseAttribute("gravity [m/s²]", value.str(),
	        "(0, 0) while no fluid has a density (fluidDensity), as it acts on fluids alone");
}

void SinglePhaseFlowEngine::startFluids()
{
	checkWeight();
	for (auto& water : contents.water)
		water = capfrac::massAt(waterPressure, water, bulkModulus);
	initialWater = thickness * contents.totalWater();
	cellPressure.clear();
	referencePressure = waterPressure;
	referenceRadii.clear();
	for (const auto& grain : reader.grains)
		referenceRadii.push_back(grain.radius);
}

/// For reports until the next step finds pressures anew: cells that are new have that of a neighbour that is not.
void SinglePhaseFlowEngine::followRemesh(const capfrac::Triangulation& before)
{
	carryOverCells(cellPressure, before, waterPressure);
}

void SinglePhaseFlowEngine::carryOverCells(
        std::vector<Real>& values, const capfrac::Triangulation& before, Real fallback) const
{
	if (values.size() != before.cells.size()) return;
	std::vector<Real> kept(mesh.cells.size(), NaN);
	for (std::size_t n = 0, o = 0; n < mesh.cells.size(); ++n) { // both are sorted by vertex
		while (o < before.cells.size() && before.cells[o].vertex < mesh.cells[n].vertex)
			++o;
		if (o < before.cells.size() && before.cells[o].vertex == mesh.cells[n].vertex) kept[n] = values[o++];
	}
	values = kept;
	for (std::size_t n = 0; n < mesh.cells.size(); ++n)
		for (int k = 0; k < 3 && math::isnan(values[n]); ++k)
			if (const int next = mesh.cells[n].neighbour[k]; next >= 0) values[n] = kept[next];
	for (auto& value : values)
		if (math::isnan(value)) value = fallback;
}

// --- the step -------------------------------------------------------------------------------------

capfrac::FlowStep SinglePhaseFlowEngine::step(capfrac::FlowNetwork& network)
{
	switch (scheme) {
	case Scheme::explicitEuler:
		return capfrac::explicitStep(network, {}, scene->dt, compression());
	case Scheme::implicit:
		return capfrac::implicitStep(network, {}, scene->dt, solver, compression());
	default:
		break;
	}
	if (!grainsMove()) return capfrac::implicitStep(network, {}, scene->dt, solver, compression());
	return capfrac::coupledStep(network, skeleton(), scene->dt, solver);
}

void SinglePhaseFlowEngine::describePores()
{
	std::vector<capfrac::VoidMoments> moments(mesh.cells.size());
	voids.resize(moments.size());
	for (std::size_t c = 0; c < moments.size(); ++c) {
		moments[c] = capfrac::voidMoments(mesh, static_cast<int>(c), reader.grains, reader.box);
		voids[c] = moments[c].area;
	}
	groupPores(moments);
	gradients = capfrac::volumeGradients(mesh, reader.grains, reader.box,
	        std::isfinite(grainBulkModulus) ? capfrac::Radii::vary : capfrac::Radii::fixed);
	weightForce = weightOfFluid();
}

void SinglePhaseFlowEngine::advanceFluids()
{
	describePores();
	auto network = flowNetwork();
	const auto done = namingPores([&] {
		auto found = step(network);
		compressGrains(found.growth);
		return found;
	});
	// A pore has one pressure: its cells share its mass by their voids.
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int p = poreOfCell[c];
		contents.water[c] = network.pores[p].mass / poreVolume[p] * voids[c];
	}
	cellPressure.resize(mesh.cells.size());
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		cellPressure[c] = done.pressure[poreOfCell[c]];
	waterIn += done.ledger.in - done.ledger.out;
	massDefect += done.ledger.defect();
	solverIterations = done.iterations;
	nFactorizations += done.factored;
	bookInflow(done);
}

void SinglePhaseFlowEngine::bookInflow(const capfrac::FlowStep& done)
{
	for (int w = 0; w < capfrac::nWalls; ++w) {
		wallInflow[w] = math::isnan(prescribedPressure(w)) ? wallFluxes[w] : 0;
		for (int pore : poresAlong[w])
			wallInflow[w] += done.supply[pore];
	}
}

std::string SinglePhaseFlowEngine::placeOf(int pore) const
{
	if (pore < 0 || pore >= nPores) return "";
	std::ostringstream text;
	text << " (pore " << pore << " lies at (" << poreCentre[pore].x << ", " << poreCentre[pore].y << ") m)";
	return text.str();
}

std::vector<double> SinglePhaseFlowEngine::cellPressures() const
{
	if (cellPressure.size() == mesh.cells.size()) return cellPressure;
	return std::vector<double>(mesh.cells.size(), waterPressure);
}

Real SinglePhaseFlowEngine::wallStiffness(int wall) const
{
	// The pores at a wall as closed springs, dF/dx = (dV/dx)^2 K_f/V; an incompressible fluid counts as water. A
	// step that foresees the wall's motion is no spring to it.
	if (scheme == Scheme::undrainedStable || !prepared() || poreVolume.empty() || gradients.walls.empty()
	        || !math::isnan(prescribedPressure(wall)))
		return 0;
	const Real modulus = std::isfinite(bulkModulus) ? bulkModulus : 2.2e9;
	Real sum = 0;
	std::map<int, Real> response;
	for (const auto& g : gradients.walls)
		if (g.wall == wall) response[poreOfCell[g.cell]] += thickness * g.outward;
	for (const auto& [pore, gradient] : response)
		sum += gradient * gradient * modulus / poreVolume[pore];
	return sum;
}

} // namespace yade
