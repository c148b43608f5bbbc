// SPDX-License-Identifier: GPL-2.0-or-later
#include "PoreFlow.hpp"

#include "../network/UnionFind.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace capfrac {

FlowScheme flowSchemeFromName(const std::string& name)
{
	if (name == "undrainedStable") return FlowScheme::undrainedStable;
	if (name == "implicit") return FlowScheme::implicit;
	if (name == "explicit") return FlowScheme::explicitEuler;
	refuseAttribute("timeIntegration", "'" + name + "'", "'undrainedStable', 'implicit', 'explicit'");
}

namespace {

	void checkWalls(const FlowOptions& o)
	{
		const std::string four = "four values: left, right, bottom, top";
		if (o.wallPressures.size() != nWalls) refuseAttribute("wallPressures", o.wallPressures.size(), four);
		if (o.wallFluxes.size() != nWalls) refuseAttribute("wallFluxes", o.wallFluxes.size(), four);
		for (int w = 0; w < nWalls; ++w) {
			if (!std::isnan(o.wallPressures[w])) requireFinite("wallPressures [Pa]", o.wallPressures[w]);
			requireFinite("wallFluxes [m³/s]", o.wallFluxes[w]);
			if (!std::isnan(o.wallPressures[w]) && o.wallFluxes[w] != 0)
				refuseAttribute("wallFluxes [m³/s]", o.wallFluxes[w],
				        "0 where wallPressures prescribes a pressure (the " + wallName(w)
				                + " wall is named twice)");
		}
	}

} // namespace

void checkOptions(const FlowOptions& o)
{
	if (!(o.bulkModulus > 0)) refuseAttribute("bulkModulus [Pa]", o.bulkModulus, "> 0, or infinity");
	requirePositive("viscosity [Pa·s]", o.viscosity);
	requirePositive("conductanceFactor [-]", o.conductanceFactor);
	requireNotNegative("residualAperture [m]", o.residualAperture);
	requirePositive("halvingForce [N]", o.halvingForce);
	requireNotNegative("fluidDensity [kg/m³]", o.density);
	requireFinite("gravity [m/s²]", dot(o.gravity, o.gravity));
	requirePositive("closedPore [-]", o.closedPore);
	if (!(o.grainBulkModulus > 0)) refuseAttribute("grainBulkModulus [Pa]", o.grainBulkModulus, "> 0, or infinity");
	checkWalls(o);
	for (const auto& p : o.pointPressures)
		requireFinite("pointPressures", dot(p.point, p.point) + p.value * p.value);
	for (const auto& p : o.pointFluxes)
		requireFinite("pointFluxes", dot(p.point, p.point) + p.value * p.value);
}

void PoreFlow::start(PoreNetwork& network, double pressure)
{
	for (auto& water : network.contents.water)
		water = massAt(pressure, water, options.bulkModulus);
	referencePressure = pressure;
	referenceRadii.clear();
	for (const auto& grain : network.grains)
		referenceRadii.push_back(grain.radius);
}

void PoreFlow::describe(const PoreNetwork& network)
{
	std::vector<VoidMoments> moments(network.mesh.cells.size());
	voids.resize(moments.size());
	for (std::size_t c = 0; c < moments.size(); ++c) {
		moments[c] = voidMoments(network.mesh, static_cast<int>(c), network.grains, network.box);
		voids[c] = moments[c].area;
	}
	group(network, moments);
	gradients = volumeGradients(network.mesh, network.grains, network.box,
	        std::isfinite(options.grainBulkModulus) ? Radii::vary : Radii::fixed);
}

void PoreFlow::group(const PoreNetwork& network, const std::vector<VoidMoments>& moments)
{
	const auto& domains = network.domains;
	const auto volumes = sumOverDomains(domains, voids);
	const double smallest = network.smallestRadius(), least = options.closedPore * M_PI * smallest * smallest;
	UnionFind joined(domains.count);
	std::vector<double> size(volumes.begin(), volumes.end());
	for (bool changed = true; changed;) {
		changed = false;
		std::map<int, std::pair<double, int>> widest; // closed pore -> gap and neighbour
		for (std::size_t e = 0; e < network.mesh.edges.size(); ++e) {
			const auto& edge = network.mesh.edges[e];
			if (edge.left < 0 || edge.right < 0) continue;
			const int a = joined.find(domains.ofCell[edge.left]),
			          b = joined.find(domains.ofCell[edge.right]);
			if (a == b) continue;
			for (auto [closed, other] : { std::pair(a, b), std::pair(b, a) })
				if (size[closed] < least
				        && (!widest.count(closed) || network.gaps[e] > widest[closed].first))
					widest[closed] = { network.gaps[e], other };
		}
		for (const auto& [closed, neighbour] : widest) {
			const int a = joined.find(closed), b = joined.find(neighbour.second);
			if (a == b) continue;
			const double sum = size[a] + size[b];
			joined.join(a, b);
			size[joined.find(a)] = sum;
			changed = true;
		}
	}
	std::vector<int> number(domains.count, -1);
	nPores = 0;
	for (int d = 0; d < domains.count; ++d)
		if (joined.find(d) == d) number[d] = nPores++;
	poreOfCell.resize(network.mesh.cells.size());
	poreCentre.assign(nPores, {});
	poreVolume.assign(nPores, 0);
	std::vector<double> area(nPores, 0);
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
		const int p = poreOfCell[c] = number[joined.find(domains.ofCell[c])];
		poreVolume[p] += network.options.thickness * moments[c].area;
		poreCentre[p] += moments[c].first;
		area[p] += moments[c].area;
	}
	for (int p = 0; p < nPores; ++p)
		poreCentre[p] = Vec2 { network.box.left, network.box.bottom } + (1 / area[p]) * poreCentre[p];
	findPoresAlongWalls(network);
}

void PoreFlow::findPoresAlongWalls(const PoreNetwork& network)
{
	for (int w = 0; w < nWalls; ++w) {
		auto& along = poresAlong[w];
		along.clear();
		if (std::isnan(prescribed[w])) continue;
		for (std::size_t c = 0; c < network.mesh.cells.size(); ++c) {
			const auto& v = network.mesh.cells[c].vertex;
			if (std::find(v.begin(), v.end(), network.mesh.nGrains + w) != v.end())
				along.push_back(poreOfCell[c]);
		}
		std::sort(along.begin(), along.end());
		along.erase(std::unique(along.begin(), along.end()), along.end());
	}
}

std::optional<FlowThroat> PoreFlow::throatAt(const PoreNetwork& network, int e, const GrainAnswer& grains) const
{
	const auto& edge = network.mesh.edges[e];
	if (edge.left < 0 || edge.right < 0 || poreOfCell[edge.left] == poreOfCell[edge.right]) return {};
	const int a = poreOfCell[edge.left], b = poreOfCell[edge.right];
	const bool wall = network.mesh.isWall(edge.b);
	// A wall mirrors: the throat there is half of that between the grain and its image.
	const double ra = network.grains[edge.a].radius, rb = wall ? ra : network.grains[edge.b].radius;
	const double gap = wall ? 2 * network.gaps[e] : network.gaps[e];
	ThroatDetails details;
	details.length =
	        std::max(norm(poreCentre[a] - poreCentre[b]), 1e-6 * (ra + rb)); // those of a nested pair may coincide
	details.plates = { options.residualAperture, options.halvingForce, 1.0 };
	const auto& law = conductanceLaws()[options.law];
	if (law.contactForce) details.normalForce = grains.contactForce(edge.a, edge.b);
	const double c = (wall ? 0.5 : 1.0)
	        * conductance(law, gap, law.radius(ra, rb), options.viscosity, network.options.thickness, details,
	                options.conductanceFactor);
	return FlowThroat { a, b, c / details.length };
}

FlowNetwork PoreFlow::flowNetwork(const PoreNetwork& network, const GrainAnswer& grains) const
{
	FlowNetwork flow;
	flow.bulkModulus = options.bulkModulus;
	flow.pores.resize(nPores);
	for (int p = 0; p < nPores; ++p)
		flow.pores[p].volume = poreVolume[p];
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c)
		flow.pores[poreOfCell[c]].mass += network.options.thickness * network.contents.water[c];
	addBoundaries(network, flow);
	const Vec2 weight = options.density * options.gravity;
	for (std::size_t e = 0; e < network.mesh.edges.size(); ++e) {
		const auto throat = throatAt(network, static_cast<int>(e), grains);
		if (!throat) continue;
		flow.throats.push_back(*throat);
		// Flow from a to b under the fluid's weight.
		const double drive = throat->conductance * dot(weight, poreCentre[throat->b] - poreCentre[throat->a]);
		flow.pores[throat->a].source -= drive;
		flow.pores[throat->b].source += drive;
	}
	return flow;
}

void PoreFlow::fix(FlowNetwork& flow, int pore, double pressure, const std::string& owner) const
{
	auto& fixed = flow.pores[pore].fixedPressure;
	if (fixed && *fixed != pressure) {
		std::ostringstream text;
		text << "the pore at (" << poreCentre[pore].x << ", " << poreCentre[pore].y << ") m has the pressure "
		     << *fixed << " Pa from another boundary and " << pressure << " Pa from " << owner
		     << "; allowed: one pressure for a pore";
		throw std::runtime_error(text.str());
	}
	fixed = pressure;
}

void PoreFlow::addBoundaries(const PoreNetwork& network, FlowNetwork& flow) const
{
	for (int w = 0; w < nWalls; ++w) {
		for (int pore : poresAlong[w])
			fix(flow, pore, prescribed[w], "the " + wallName(w) + " wall");
		if (options.wallFluxes[w] == 0) continue;
		const auto stretches = network.stretches(w);
		double length = 0;
		for (const auto& s : stretches)
			length += s.to - s.from;
		for (const auto& s : stretches)
			flow.pores[poreOfCell[network.domains.first[s.domain]]].source +=
			        options.wallFluxes[w] * (s.to - s.from) / length;
	}
	const auto poreAt = [&](Vec2 point) {
		return poreOfCell[cellAt(network.mesh, network.grains, network.box, point)];
	};
	for (const auto& p : options.pointPressures)
		fix(flow, poreAt(p.point), p.value, "pointPressures");
	for (const auto& p : options.pointFluxes)
		flow.pores[poreAt(p.point)].source += p.value;
}

} // namespace capfrac
