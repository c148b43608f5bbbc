// SPDX-License-Identifier: GPL-2.0-or-later
#include "Domains.hpp"
#include "UnionFind.hpp"

#include "../laws/Options.hpp"

#include <numeric>

namespace capfrac {

PoreMode poreModeFromName(const std::string& name)
{
	if (name == "domain") return PoreMode::domain;
	if (name == "triangle") return PoreMode::triangle;
	refuseAttribute("poreMode", "'" + name + "'", "'domain', 'triangle'");
}

bool updateOpenEdges(std::vector<std::uint8_t>& open, const std::vector<double>& gap, double openGap, double closeGap)
{
	bool changed = false;
	for (std::size_t e = 0; e < open.size(); ++e) {
		const std::uint8_t now = gap[e] > (open[e] == 1 ? closeGap : openGap) ? 1 : 0;
		changed |= now != open[e];
		open[e] = now;
	}
	return changed;
}

Domains findDomains(const Triangulation& mesh, const std::vector<std::uint8_t>& open, const std::vector<Phase>& phase,
        PoreMode mode)
{
	const int nCells = static_cast<int>(mesh.cells.size());
	UnionFind sets(nCells);
	if (mode == PoreMode::domain)
		for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
			const int left = mesh.edges[e].left, right = mesh.edges[e].right;
			if (open[e] && left >= 0 && right >= 0 && phase[left] == phase[right]) sets.join(left, right);
		}

	Domains domains;
	domains.ofCell.resize(nCells);
	for (int c = 0; c < nCells; ++c) {
		const int root = sets.find(c); // the smallest cell of the set, so it has its number already
		if (root == c) {
			domains.ofCell[c] = domains.count++;
			domains.first.push_back(c);
		} else
			domains.ofCell[c] = domains.ofCell[root];
	}
	domains.begin.assign(domains.count + 1, 0);
	for (int d : domains.ofCell)
		++domains.begin[d + 1];
	std::partial_sum(domains.begin.begin(), domains.begin.end(), domains.begin.begin());
	auto next = domains.begin;
	domains.cells.resize(nCells);
	for (int c = 0; c < nCells; ++c)
		domains.cells[next[domains.ofCell[c]]++] = c;
	return domains;
}

std::vector<double> sumOverDomains(const Domains& domains, const std::vector<double>& ofCell)
{
	std::vector<double> sum(domains.count, 0.0);
	for (std::size_t c = 0; c < ofCell.size(); ++c)
		sum[domains.ofCell[c]] += ofCell[c];
	return sum;
}

} // namespace capfrac
