// SPDX-License-Identifier: GPL-2.0-or-later
#include "GrainCompression.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace capfrac {

std::vector<WettedArc> wettedArcs(
        const VolumeGradients& gradients, const std::vector<int>& poreOfCell, double thickness)
{
	std::vector<WettedArc> all;
	all.reserve(gradients.grains.size());
	for (const auto& g : gradients.grains)
		if (poreOfCell[g.cell] >= 0) all.push_back({ poreOfCell[g.cell], g.grain, -thickness * g.radius });
	std::stable_sort(all.begin(), all.end(), [](const WettedArc& s, const WettedArc& t) {
		return std::tie(s.grain, s.pore) < std::tie(t.grain, t.pore);
	});
	std::vector<WettedArc> merged;
	for (const WettedArc& arc : all)
		if (!merged.empty() && merged.back().grain == arc.grain && merged.back().pore == arc.pore)
			merged.back().area += arc.area;
		else
			merged.push_back(arc);
	return merged;
}

std::vector<double> radiusGrowth(const GrainCompression& compression, const std::vector<double>& pressure)
{
	std::vector<double> growth(compression.lag.size(), 0);
	forEachGrain(compression, [&](std::size_t from, std::size_t to, double around) {
		double load = 0;
		for (std::size_t k = from; k < to; ++k)
			load += compression.arcs[k].area * pressure[compression.arcs[k].pore];
		const int grain = compression.arcs[from].grain;
		growth[grain] = compression.lag[grain] - compression.compliance[grain] * load / around;
	});
	return growth;
}

void addGrowth(const GrainCompression& compression, const std::vector<double>& growth, std::vector<double>& volume)
{
	for (const WettedArc& arc : compression.arcs)
		volume[arc.pore] -= arc.area * growth[arc.grain];
}

double laggedResponse(const GrainCompression& compression, const std::vector<double>& volume, double bulkModulus)
{
	std::vector<double> response(volume.size(), 0);
	for (const WettedArc& arc : compression.arcs)
		response[arc.pore] +=
		        std::abs(arc.area) * compression.compliance[arc.grain] * bulkModulus / volume[arc.pore];
	return response.empty() ? 0 : *std::max_element(response.begin(), response.end());
}

} // namespace capfrac
