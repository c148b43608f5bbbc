// SPDX-License-Identifier: GPL-2.0-or-later
#include "Assembly.hpp"

#include <cmath>
#include <sstream>

namespace capfrac {

namespace {

	void enter(FlowLedger& ledger, double mass) { (mass > 0 ? ledger.in : ledger.out) += std::abs(mass); }

} // namespace

void refuseStep(const std::string& what, double value, const std::string& allowed)
{
	std::ostringstream text;
	text.precision(10);
	text << what << " = " << value << ", allowed: " << allowed;
	throw FlowError(text.str());
}

void checkStep(double dt)
{
	if (!(dt > 0 && std::isfinite(dt))) refuseStep("time step of the flow [s]", dt, "> 0");
}

std::vector<double> volumesOf(const FlowNetwork& network)
{
	std::vector<double> volume;
	volume.reserve(network.pores.size());
	for (const FlowPore& pore : network.pores)
		volume.push_back(pore.volume);
	return volume;
}

std::vector<std::uint8_t> compressed(const FlowClusters& clusters, const GrainCompression& compression)
{
	std::vector<std::uint8_t> yields(clusters.count, 0);
	for (const WettedArc& arc : compression.arcs)
		if (arc.area > 0 && compression.compliance[arc.grain] > 0) yields[clusters.ofPore[arc.pore]] = 1;
	return yields;
}

Assembly::Assembly(const FlowNetwork& network_)
        : network(network_)
        , unknown(network_.pores.size(), -1)
{
	for (std::size_t i = 0; i < unknown.size(); ++i)
		if (!network.pores[i].fixedPressure) unknown[i] = count++;
	system.diagonal.assign(count, 0);
	right.assign(count, 0);
	for (const FlowThroat& t : network.throats) {
		add(t.a, t.a, t.conductance), add(t.b, t.b, t.conductance);
		add(t.a, t.b, -t.conductance);
	}
	for (const BoundaryLink& l : network.links)
		add(l.pore, l.pore, l.conductance), addRight(l.pore, l.conductance * l.pressure);
	for (std::size_t i = 0; i < unknown.size(); ++i)
		addRight(static_cast<int>(i), network.pores[i].source);
}

void Assembly::addStorage(const std::vector<double>& volume, double dt)
{
	for (std::size_t i = 0; i < unknown.size(); ++i) {
		add(static_cast<int>(i), static_cast<int>(i), volume[i] / network.bulkModulus / dt);
		addRight(static_cast<int>(i), (network.pores[i].mass - volume[i]) / dt);
	}
}

void Assembly::addCompression(const GrainCompression& compression, double dt)
{
	// Of the volume V - sum over grains of arc (lag - compliance p_mean), p_mean = sum arc p/sum arc, at the end.
	forEachGrain(compression, [&](std::size_t from, std::size_t to, double around) {
		const auto& arcs = compression.arcs;
		const int grain = arcs[from].grain;
		const double share = compression.compliance[grain] / around / dt;
		for (std::size_t k = from; k < to; ++k) {
			addRight(arcs[k].pore, arcs[k].area * compression.lag[grain] / dt);
			for (std::size_t l = from; l <= k; ++l)
				add(arcs[k].pore, arcs[l].pore, share * arcs[k].area * arcs[l].area);
		}
	});
}

void Assembly::solve(PressureSolver& solver, FlowStep& step) const
{
	const PressureSolution solution = solver.solve(system, right);
	for (std::size_t i = 0; i < unknown.size(); ++i)
		step.pressure.push_back(unknown[i] < 0 ? *network.pores[i].fixedPressure : solution.x[unknown[i]]);
	step.residual = solution.residual, step.iterations = solution.iterations, step.factored = solution.factored;
	findFlows(network, step);
}

void findFlows(const FlowNetwork& network, FlowStep& step)
{
	for (const FlowThroat& t : network.throats)
		step.throatFlow.push_back(t.conductance * (step.pressure[t.a] - step.pressure[t.b]));
	for (const BoundaryLink& l : network.links)
		step.linkFlow.push_back(l.conductance * (step.pressure[l.pore] - l.pressure));
}

void moveMass(FlowNetwork& network, double dt, FlowStep& step)
{
	const std::size_t n = network.pores.size();
	std::vector<double> inflow(n);
	for (std::size_t i = 0; i < n; ++i)
		inflow[i] = network.pores[i].source;
	for (std::size_t t = 0; t < network.throats.size(); ++t) {
		inflow[network.throats[t].a] -= step.throatFlow[t];
		inflow[network.throats[t].b] += step.throatFlow[t];
	}
	for (std::size_t l = 0; l < network.links.size(); ++l) {
		inflow[network.links[l].pore] -= step.linkFlow[l];
		enter(step.ledger, -dt * step.linkFlow[l]);
	}
	step.supply.assign(n, 0);
	for (std::size_t i = 0; i < n; ++i) {
		FlowPore& pore = network.pores[i];
		const double before = pore.mass;
		if (pore.fixedPressure) {
			pore.mass = massAt(*pore.fixedPressure, step.volume[i], network.bulkModulus);
			step.supply[i] = (pore.mass - before) / dt - inflow[i];
			enter(step.ledger, dt * step.supply[i]);
		} else
			pore.mass += dt * inflow[i];
		enter(step.ledger, dt * pore.source);
		step.ledger.stored += pore.mass - before;
		step.ledger.held += pore.mass;
	}
}

} // namespace capfrac
