// SPDX-License-Identifier: GPL-2.0-or-later
/// The pores of SinglePhaseFlowEngine as a problem of flow: volumes, throats, boundaries.

#include "SinglePhaseFlowEngine.hpp"
#include "Walls.hpp"

#include "../network/UnionFind.hpp"

#include <pkg/common/NormShearPhys.hpp>

#include <algorithm>
#include <map>

namespace yade {

/// Pores are the domains; one that grains have all but closed is joined to the neighbour across its widest throat,
/// because a pressure K_f (m/V - 1) means nothing where V goes to zero.
void SinglePhaseFlowEngine::groupPores(const std::vector<capfrac::VoidMoments>& moments)
{
	const auto volumes = capfrac::sumOverDomains(domains, voids);
	const Real smallest = smallestRadius(), least = closedPore * M_PI * smallest * smallest;
	capfrac::UnionFind joined(domains.count);
	std::vector<Real> size(volumes.begin(), volumes.end());
	for (bool changed = true; changed;) {
		changed = false;
		std::map<int, std::pair<Real, int>> widest; // closed pore -> gap and neighbour
		for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
			const auto& edge = mesh.edges[e];
			if (edge.left < 0 || edge.right < 0) continue;
			const int a = joined.find(domains.ofCell[edge.left]),
			          b = joined.find(domains.ofCell[edge.right]);
			if (a == b) continue;
			for (auto [closed, other] : { std::pair(a, b), std::pair(b, a) })
				if (size[closed] < least && (!widest.count(closed) || gaps[e] > widest[closed].first))
					widest[closed] = { gaps[e], other };
		}
		for (const auto& [closed, neighbour] : widest) {
			const int a = joined.find(closed), b = joined.find(neighbour.second);
			if (a == b) continue;
			const Real sum = size[a] + size[b];
			joined.join(a, b);
			size[joined.find(a)] = sum;
			changed = true;
		}
	}
	std::vector<int> number(domains.count, -1);
	nPores = 0;
	for (int d = 0; d < domains.count; ++d)
		if (joined.find(d) == d) number[d] = nPores++;
	poreOfCell.resize(mesh.cells.size());
	poreCentre.assign(nPores, {});
	poreVolume.assign(nPores, 0);
	std::vector<double> area(nPores, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const int p = poreOfCell[c] = number[joined.find(domains.ofCell[c])];
		poreVolume[p] += thickness * moments[c].area;
		poreCentre[p] += moments[c].first;
		area[p] += moments[c].area;
	}
	for (int p = 0; p < nPores; ++p)
		poreCentre[p] = capfrac::Vec2 { reader.box.left, reader.box.bottom } + (1 / area[p]) * poreCentre[p];
	findPoresAlongWalls();
}

void SinglePhaseFlowEngine::findPoresAlongWalls()
{
	for (int w = 0; w < capfrac::nWalls; ++w) {
		poresAlong[w].clear();
		if (math::isnan(prescribedPressure(w))) continue;
		for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
			const auto& v = mesh.cells[c].vertex;
			if (std::find(v.begin(), v.end(), mesh.nGrains + w) != v.end())
				poresAlong[w].push_back(poreOfCell[c]);
		}
		std::sort(poresAlong[w].begin(), poresAlong[w].end());
		poresAlong[w].erase(std::unique(poresAlong[w].begin(), poresAlong[w].end()), poresAlong[w].end());
	}
}

capfrac::FlowNetwork SinglePhaseFlowEngine::flowNetwork() const
{
	capfrac::FlowNetwork network;
	network.bulkModulus = bulkModulus;
	network.pores.resize(nPores);
	for (int p = 0; p < nPores; ++p)
		network.pores[p].volume = poreVolume[p];
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		network.pores[poreOfCell[c]].mass += thickness * contents.water[c];
	addBoundaries(network);
	addThroats(network);
	return network;
}

std::optional<capfrac::FlowThroat> SinglePhaseFlowEngine::throatAt(int e) const
{
	const auto& edge = mesh.edges[e];
	if (edge.left < 0 || edge.right < 0 || poreOfCell[edge.left] == poreOfCell[edge.right]) return {};
	const int a = poreOfCell[edge.left], b = poreOfCell[edge.right];
	const bool wall = mesh.isWall(edge.b);
	// A wall mirrors: the throat there is half of that between the grain and its image.
	const Real ra = reader.grains[edge.a].radius, rb = wall ? ra : reader.grains[edge.b].radius,
	           gap = wall ? 2 * gaps[e] : gaps[e];
	capfrac::ThroatDetails details;
	details.length = math::max(capfrac::norm(poreCentre[a] - poreCentre[b]),
	        1e-6 * (ra + rb)); // centres of a nested pair may coincide
	Real r = 0.5 * (ra + rb);
	if (conductance == capfrac::ConductanceLaw::lubrication) r = 2 * ra * rb / (ra + rb);
	if (conductance == capfrac::ConductanceLaw::parallelPlates) {
		details.plates = { residualAperture, halvingForce, 1.0 };
		const auto contact = scene->interactions->find(reader.bodyOf(edge.a), reader.bodyOf(edge.b));
		const auto* phys =
		        contact && contact->isReal() ? dynamic_cast<const NormPhys*>(contact->phys.get()) : nullptr;
		details.normalForce = phys ? phys->normalForce.norm() : 0;
	}
	const Real c = (wall ? 0.5 : 1.0)
	        * capfrac::conductance(conductance, gap, r, viscosity, thickness, details, conductanceFactor);
	return capfrac::FlowThroat { a, b, c / details.length };
}

void SinglePhaseFlowEngine::addThroats(capfrac::FlowNetwork& network) const
{
	const capfrac::Vec2 weight { fluidDensity * gravity[0], fluidDensity * gravity[1] };
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto throat = throatAt(static_cast<int>(e));
		if (!throat) continue;
		network.throats.push_back(*throat);
		// Flow from a to b under the fluid's weight.
		const Real drive =
		        throat->conductance * capfrac::dot(weight, poreCentre[throat->b] - poreCentre[throat->a]);
		network.pores[throat->a].source -= drive;
		network.pores[throat->b].source += drive;
	}
}

void SinglePhaseFlowEngine::fixPressure(
        capfrac::FlowNetwork& network, int pore, double pressure, const std::string& owner) const
{
	auto& fixed = network.pores[pore].fixedPressure;
	if (fixed && *fixed != pressure) {
		std::ostringstream text;
		text << getClassName() << " " << whenInLoop(*scene) << "the pore at (" << poreCentre[pore].x << ", "
		     << poreCentre[pore].y << ") m has the pressure " << *fixed << " Pa from another boundary and "
		     << pressure << " Pa from " << owner << "; allowed: one pressure for a pore";
		throw std::runtime_error(text.str());
	}
	fixed = pressure;
}

void SinglePhaseFlowEngine::addBoundaries(capfrac::FlowNetwork& network) const
{
	for (int w = 0; w < capfrac::nWalls; ++w) {
		for (int pore : poresAlong[w])
			fixPressure(network, pore, prescribedPressure(w), std::string("the ") + wallName(w) + " wall");
		if (wallFluxes[w] == 0) continue;
		const auto stretches = wallStretches(mesh, domains, reader, w);
		Real length = 0;
		for (const auto& s : stretches)
			length += s.to - s.from;
		for (const auto& s : stretches)
			network.pores[poreOfCell[domains.first[s.domain]]].source +=
			        wallFluxes[w] * (s.to - s.from) / length;
	}
	for (const auto& p : pointPressures)
		fixPressure(network, poreOfCell[cellAt(mesh, reader, { p[0], p[1] })], p[2], "pointPressures");
	for (const auto& p : pointFluxes)
		network.pores[poreOfCell[cellAt(mesh, reader, { p[0], p[1] })]].source += p[2];
}

} // namespace yade
