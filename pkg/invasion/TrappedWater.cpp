// SPDX-License-Identifier: GPL-2.0-or-later
#include "TrappedWater.hpp"

#include "../network/UnionFind.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace capfrac {

std::vector<TrappedCluster> trappedClusters(const DrainageNetwork& network)
{
	const int nDomains = static_cast<int>(network.gas.size());
	const auto free = connectedWater(network);
	auto trapped = [&](int d) { return !network.gas[d] && !free[d]; };
	UnionFind sets(nDomains);
	for (const Throat& t : network.throats)
		if (trapped(t.left) && trapped(t.right)) sets.join(t.left, t.right);

	std::map<int, TrappedCluster> clusters; // by the first domain, which represents the set
	for (int d = 0; d < nDomains; ++d)
		if (trapped(d)) clusters[sets.find(d)].domains.push_back(d);
	auto rank = [&](int t) {
		const Throat& throat = network.throats[t];
		return std::make_tuple(throat.entryPressure, throat.position.x, throat.position.y);
	};
	for (int t = 0; t < static_cast<int>(network.throats.size()); ++t)
		for (bool forward : { true, false }) {
			const Throat& throat = network.throats[t];
			const int from = forward ? throat.left : throat.right,
			          to = forward ? throat.right : throat.left;
			if (!network.gas[from] || !network.injected[from] || !trapped(to)) continue;
			auto& cluster = clusters[sets.find(to)];
			if (cluster.throat < 0 || rank(t) < rank(cluster.throat))
				cluster.throat = t, cluster.behind = to;
		}

	std::vector<TrappedCluster> found;
	for (auto& [first, cluster] : clusters)
		found.push_back(std::move(cluster));
	return found;
}

double filmOutflow(double conductance, double capillaryPressure, double entryPressure)
{
	return conductance * std::max(0.0, capillaryPressure - entryPressure);
}

} // namespace capfrac
