// SPDX-License-Identifier: GPL-2.0-or-later
#include "Assembly.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace capfrac {

namespace {

	std::vector<double> endVolumes(const FlowNetwork& network, const std::vector<double>& newVolume)
	{
		if (newVolume.empty()) return volumesOf(network);
		if (newVolume.size() != network.pores.size())
			refuseStep("number of new volumes", static_cast<double>(newVolume.size()),
			        std::to_string(network.pores.size()) + ", one per pore");
		for (std::size_t i = 0; i < newVolume.size(); ++i)
			if (!(newVolume[i] > 0 && std::isfinite(newVolume[i])))
				refuseStep("pore " + std::to_string(i) + ": new volume [m^3]", newVolume[i], "> 0");
		return newVolume;
	}

	void setVolumes(FlowNetwork& network, const std::vector<double>& volume)
	{
		for (std::size_t i = 0; i < volume.size(); ++i)
			network.pores[i].volume = volume[i];
	}

} // namespace

double explicitTimeStepLimit(const FlowNetwork& network)
{
	checkNetwork(network);
	if (network.incompressible())
		throw FlowError("no explicit step is short enough for an incompressible fluid; take an implicit one");
	std::vector<double> conductance(network.pores.size(), 0);
	for (const FlowThroat& t : network.throats)
		conductance[t.a] += t.conductance, conductance[t.b] += t.conductance;
	for (const BoundaryLink& l : network.links)
		conductance[l.pore] += l.conductance;
	double limit = std::numeric_limits<double>::infinity();
	for (std::size_t i = 0; i < conductance.size(); ++i)
		if (conductance[i] > 0 && !network.pores[i].fixedPressure)
			limit = std::min(limit, network.pores[i].volume / (network.bulkModulus * conductance[i]));
	return limit;
}

FlowStep explicitStep(
        FlowNetwork& network, const std::vector<double>& newVolume, double dt, const GrainCompression& compression)
{
	checkStep(dt);
	const double limit = explicitTimeStepLimit(network);
	if (dt > limit) {
		std::ostringstream allowed;
		allowed.precision(10);
		allowed << "<= " << limit << " (V/(K_f sum G) of the stiffest pore)";
		refuseStep("explicit time step of the flow [s]", dt, allowed.str());
	}
	FlowStep step;
	step.volume = endVolumes(network, newVolume);
	const double response = laggedResponse(compression, step.volume, network.bulkModulus);
	if (!(response < 1))
		refuseStep("share of its change of pressure that a pore loses to grains which the fluid compresses [-]",
		        response, "< 1 in the explicit scheme (stiffer grains, or an implicit scheme)");
	step.pressure = pressuresOf(network);
	findFlows(network, step);
	moveMass(network, dt, step);
	setVolumes(network, step.volume);
	step.pressure = pressuresOf(network);
	step.growth = radiusGrowth(compression, step.pressure);
	return step;
}

FlowStep implicitStep(FlowNetwork& network, const std::vector<double>& newVolume, double dt, PressureSolver& solver,
        const GrainCompression& compression)
{
	checkStep(dt);
	checkNetwork(network);
	if (network.incompressible()) {
		const auto clusters = findClusters(network);
		checkGrounded(network, clusters, compressed(clusters, compression));
	}
	FlowStep step;
	step.volume = endVolumes(network, newVolume);
	Assembly assembly(network);
	assembly.addStorage(step.volume, dt);
	assembly.addCompression(compression, dt);
	assembly.solve(solver, step);
	step.growth = radiusGrowth(compression, step.pressure);
	addGrowth(compression, step.growth, step.volume);
	moveMass(network, dt, step);
	setVolumes(network, step.volume);
	return step;
}

} // namespace capfrac
