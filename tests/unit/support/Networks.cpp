// SPDX-License-Identifier: GPL-2.0-or-later
#include "Networks.hpp"

#include "laws/EntryPressure.hpp"
#include "geometry/VoidGeometry.hpp"

#include <algorithm>

namespace capfrac::samples {

DrainageNetwork randomNetwork(Random& random)
{
	const int nDomains = 2 + random.below(60);
	DrainageNetwork network;
	for (auto* flags : { &network.gas, &network.injected, &network.outlet })
		flags->assign(nDomains, 0);
	const int nThroats = nDomains + random.below(2 * nDomains);
	for (int t = 0; t < nThroats; ++t) {
		const int left = random.below(nDomains),
		          right = (left + 1 + random.below(std::min(4, nDomains - 1))) % nDomains;
		network.throats.push_back({ t, left, right, 10.0 * (1 + random.below(30)),
		        { random.uniform(0, 1), random.uniform(0, 1) } });
	}
	for (int d = 0; d < nDomains; ++d) {
		network.gas[d] = random.chance(0.15);
		network.outlet[d] = random.chance(0.1);
	}
	std::vector<std::uint8_t> seed(nDomains, 0);
	seed[random.below(nDomains)] = 1;
	network.gas[std::find(seed.begin(), seed.end(), 1) - seed.begin()] = 1;
	network.injected = connectedGas(network, seed);
	return network;
}

DrainageNetwork packingNetwork(Random& random, int nGrains)
{
	const auto grains = packedSample(random, nGrains, oblong, 1.67);
	const auto mesh = triangulate(grains, oblong);
	std::vector<double> gaps;
	for (const Edge& e : mesh.edges)
		gaps.push_back(gap(mesh, e.a, e.b, grains, oblong));
	std::vector<std::uint8_t> open(gaps.size(), freshEdge);
	updateOpenEdges(open, gaps, 0, 0);
	const auto domains =
	        findDomains(mesh, open, std::vector<Phase>(mesh.cells.size(), Phase::water), PoreMode::domain);

	DrainageNetwork network;
	for (auto* flags : { &network.gas, &network.injected, &network.outlet })
		flags->assign(domains.count, 0);
	for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
		const Edge& e = mesh.edges[i];
		const int left = domains.ofCell[e.left], right = domains.ofCell[e.right];
		if (mesh.isWall(e.b) && mesh.wallOf(e.b) == wallTop) network.outlet[left] = network.outlet[right] = 1;
		if (left == right) continue;
		// At a wall the grain meets its mirror image.
		const double r =
		        mesh.isWall(e.b) ? grains[e.a].radius : 0.5 * (grains[e.a].radius + grains[e.b].radius);
		const double d = mesh.isWall(e.b) ? 2 * gaps[i] : gaps[i];
		const Vec2 middle =
		        0.5 * (cellCentre(mesh, e.left, grains, oblong) + cellCentre(mesh, e.right, grains, oblong));
		network.throats.push_back({ static_cast<int>(i), left, right,
		        entryPressure(EntryLaw::inscribedSphere, d, r, 0.05, 0), middle });
	}
	const Vec2 inlet { 3, oblong.bottom };
	int nearest = 0;
	for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c)
		if (norm(cellCentre(mesh, c, grains, oblong) - inlet)
		        < norm(cellCentre(mesh, nearest, grains, oblong) - inlet))
			nearest = c;
	network.gas[domains.ofCell[nearest]] = network.injected[domains.ofCell[nearest]] = 1;
	return network;
}

} // namespace capfrac::samples
