// SPDX-License-Identifier: GPL-2.0-or-later
/// PoreFlow and the grains: how they give way, and what the fluid does to them.

#include "PoreFlow.hpp"

#include <cmath>
#include <map>

namespace capfrac {

Skeleton PoreFlow::skeleton(const PoreNetwork& network, const GrainAnswer& grains, const FluidForces& weight) const
{
	Skeleton skeleton;
	if (grains.move()) {
		skeleton = grains.motion(network, weight);
		skeleton.gradient =
		        poreGradient(gradients, poreOfCell, network.mesh.nGrains, network.options.thickness);
	}
	skeleton.compression = compression(network); // grains that stand still may be compressed, too
	return skeleton;
}

FluidForces PoreFlow::loads(
        const PoreNetwork& network, const std::vector<double>& pressures, const FluidForces& weight) const
{
	auto forces = fluidForces(gradients, pressures, network.grains.size());
	if (!weight.grains.empty()) forces += weight;
	return forces;
}

GrainCompression PoreFlow::compression(const PoreNetwork& network) const
{
	GrainCompression compression;
	if (!std::isfinite(options.grainBulkModulus)) return compression;
	compression.arcs = wettedArcs(gradients, poreOfCell, network.options.thickness);
	for (std::size_t i = 0; i < network.grains.size(); ++i) {
		const double compliance = referenceRadii[i] / (3 * options.grainBulkModulus);
		compression.compliance.push_back(compliance);
		compression.lag.push_back(
		        referenceRadii[i] + compliance * referencePressure - network.grains[i].radius);
	}
	return compression;
}

void PoreFlow::checkGrowth(const PoreNetwork& network, const std::vector<double>& growth) const
{
	const double modulus = options.grainBulkModulus;
	for (std::size_t i = 0; i < growth.size(); ++i) {
		const double radius = network.grains[i].radius + growth[i];
		if (radius > 0.5 * referenceRadii[i]) continue; // Eq. 10 is linear: it means nothing elsewhere
		std::ostringstream text;
		text << network.nameOf(static_cast<int>(i)) << ": the pressure round it, "
		     << referencePressure + 3 * modulus * (1 - radius / referenceRadii[i])
		     << " Pa, would compress it to less than half of its radius; allowed: pressures far below "
		        "grainBulkModulus = "
		     << modulus << " Pa";
		throw std::runtime_error(text.str());
	}
}

std::array<double, nWalls> PoreFlow::wallInflow(const std::vector<double>& supply) const
{
	std::array<double, nWalls> inflow {};
	for (int w = 0; w < nWalls; ++w) {
		inflow[w] = std::isnan(prescribed[w]) ? options.wallFluxes[w] : 0;
		for (int pore : poresAlong[w])
			inflow[w] += supply[pore];
	}
	return inflow;
}

double PoreFlow::wallStiffness(const PoreNetwork& network, int wall) const
{
	// The pores at a wall as closed springs, dF/dx = (dV/dx)^2 K_f/V; an incompressible fluid counts as water. A
	// step that foresees the wall's motion is no spring to it.
	if (options.scheme == FlowScheme::undrainedStable || poreVolume.empty() || gradients.walls.empty()
	        || !std::isnan(prescribed[wall]))
		return 0;
	const double modulus = std::isfinite(options.bulkModulus) ? options.bulkModulus : 2.2e9;
	double sum = 0;
	std::map<int, double> response;
	for (const auto& g : gradients.walls)
		if (g.wall == wall) response[poreOfCell[g.cell]] += network.options.thickness * g.outward;
	for (const auto& [pore, gradient] : response)
		sum += gradient * gradient * modulus / poreVolume[pore];
	return sum;
}

std::string PoreFlow::placeOf(int pore) const
{
	if (pore < 0 || pore >= nPores) return "";
	std::ostringstream text;
	text << " (pore " << pore << " lies at (" << poreCentre[pore].x << ", " << poreCentre[pore].y << ") m)";
	return text.str();
}

} // namespace capfrac
