// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasClusters.hpp"
#include "UnionFind.hpp"

namespace capfrac {

GasClusters gasClusters(const Triangulation& mesh, const Contents& contents, const std::vector<std::uint8_t>& shut)
{
	const int nCells = static_cast<int>(mesh.cells.size());
	const int inlet = nCells; // one more member stands for what supplies the gas
	auto holdsGas = [&](int c) { return c >= 0 && contents.phase[c] == Phase::gas; };
	UnionFind sets(nCells + 1);
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const Edge& edge = mesh.edges[e];
		if (holdsGas(edge.left) && holdsGas(edge.right) && (shut.empty() || !shut[e]))
			sets.join(edge.left, edge.right);
	}
	for (int c = 0; c < nCells; ++c)
		if (holdsGas(c) && contents.source[c]) sets.join(c, inlet);

	GasClusters clusters;
	std::vector<int> numberOf(nCells + 1, -1);
	numberOf[sets.find(inlet)] = 0;
	for (int c = 0; c < nCells; ++c) {
		if (!holdsGas(c)) {
			clusters.ofCell.push_back(-1);
			continue;
		}
		int& number = numberOf[sets.find(c)];
		if (number < 0) number = clusters.count++;
		clusters.ofCell.push_back(number);
	}
	return clusters;
}

} // namespace capfrac
