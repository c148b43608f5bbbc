// SPDX-License-Identifier: GPL-2.0-or-later
#include "Contents.hpp"
#include "UnionFind.hpp"

#include <algorithm>
#include <map>

namespace capfrac {

namespace {

	/// A directed side of a cell that exists in only one of the two triangulations.
	struct LooseSide {
		int from, to;
		int member; ///< old cells first, then new ones
	};

	/// What one part of the changed region holds.
	struct Part {
		double gas = 0, water = 0, gasMass = 0, newVoid = 0;
		double asGas = 0, asWater = 0; ///< what decides the phase: amounts, or the voids of either phase
		int nNew = 0;
		bool source = false;
		double heldGas = 0, heldPressure = 0; ///< gas in held cells, and the sum of it times its pressure
		bool freeGas = false;
	};

	std::vector<int> matchCells(const Triangulation& before, const Triangulation& after)
	{
		std::vector<int> oldOf(after.cells.size(), -1);
		std::size_t o = 0;
		for (std::size_t n = 0; n < after.cells.size(); ++n) { // both are sorted by vertex
			while (o < before.cells.size() && before.cells[o].vertex < after.cells[n].vertex)
				++o;
			if (o < before.cells.size() && before.cells[o].vertex == after.cells[n].vertex)
				oldOf[n] = static_cast<int>(o++);
		}
		return oldOf;
	}

	void listSides(const Triangulation& mesh, const std::vector<int>& cells, int firstMember,
	        std::vector<LooseSide>& sides)
	{
		for (std::size_t m = 0; m < cells.size(); ++m) {
			const auto& v = mesh.cells[cells[m]].vertex;
			for (int k = 0; k < 3; ++k)
				sides.push_back({ v[k], v[(k + 1) % 3], firstMember + static_cast<int>(m) });
		}
	}

	/// Joins the loose cells into parts: two cells of one triangulation where they share an edge, and an
	/// old with a new one where both lie on the same side of an edge.
	void joinParts(std::vector<LooseSide> sides, int nOld, UnionFind& parts)
	{
		auto pairOf = [](const LooseSide& s) {
			return std::make_pair(std::min(s.from, s.to), std::max(s.from, s.to));
		};
		std::sort(sides.begin(), sides.end(), [&](const LooseSide& p, const LooseSide& q) {
			return pairOf(p) != pairOf(q) ? pairOf(p) < pairOf(q) : p.member < q.member;
		});
		for (std::size_t i = 0; i < sides.size(); ++i)
			for (std::size_t j = i + 1; j < sides.size() && pairOf(sides[i]) == pairOf(sides[j]); ++j) {
				const bool sameMesh = (sides[i].member < nOld) == (sides[j].member < nOld);
				const bool sameSide = sides[i].from == sides[j].from;
				if (sameMesh != sameSide) parts.join(sides[i].member, sides[j].member);
			}
	}

} // namespace

void Contents::resize(std::size_t n)
{
	phase.assign(n, Phase::water);
	gas.assign(n, 0);
	water.assign(n, 0);
	source.assign(n, 0);
	gasMass.assign(n, 0);
	held.assign(n, 0);
	heldPressure.assign(n, 0);
}

double Contents::totalGas() const { return std::accumulate(gas.begin(), gas.end(), 0.0); }

double Contents::totalWater() const { return std::accumulate(water.begin(), water.end(), 0.0); }

double Contents::totalGasMass() const { return std::accumulate(gasMass.begin(), gasMass.end(), 0.0); }

Contents waterFilled(const std::vector<double>& voidArea)
{
	Contents contents;
	contents.resize(voidArea.size());
	contents.water = voidArea;
	return contents;
}

std::array<double, 2> followVoids(Contents& contents, const std::vector<double>& voidArea)
{
	std::array<double, 2> entered {};
	for (std::size_t c = 0; c < voidArea.size(); ++c) {
		const bool isGas = contents.phase[c] == Phase::gas && !contents.held[c];
		const double change = voidArea[c] - (contents.gas[c] + contents.water[c]);
		(isGas ? contents.gas[c] : contents.water[c]) += change;
		entered[isGas ? 0 : 1] += change;
	}
	return entered;
}

Contents carryOver(const Triangulation& before, const Contents& contents, const Triangulation& after,
        const std::vector<double>& newVoid, const std::vector<double>& oldVoid)
{
	Contents carried;
	carried.resize(after.cells.size());
	std::vector<char> kept(before.cells.size(), 0);
	std::vector<int> lost, made;
	const auto oldOf = matchCells(before, after);
	for (std::size_t n = 0; n < oldOf.size(); ++n) {
		const int o = oldOf[n];
		if (o < 0) {
			made.push_back(static_cast<int>(n));
			continue;
		}
		kept[o] = 1;
		carried.phase[n] = contents.phase[o];
		carried.gas[n] = contents.gas[o];
		carried.water[n] = contents.water[o];
		carried.source[n] = contents.source[o];
		carried.gasMass[n] = contents.gasMass[o];
		carried.held[n] = contents.held[o];
		carried.heldPressure[n] = contents.heldPressure[o];
	}
	for (std::size_t o = 0; o < kept.size(); ++o)
		if (!kept[o]) lost.push_back(static_cast<int>(o));
	if (made.empty()) return carried;

	const int nOld = static_cast<int>(lost.size());
	UnionFind parts(nOld + static_cast<int>(made.size()));
	std::vector<LooseSide> sides;
	listSides(before, lost, 0, sides);
	listSides(after, made, nOld, sides);
	joinParts(std::move(sides), nOld, parts);

	std::map<int, Part> sums;
	for (int m = 0; m < nOld; ++m) {
		Part& part = sums[parts.find(m)];
		part.gas += contents.gas[lost[m]];
		part.water += contents.water[lost[m]];
		part.gasMass += contents.gasMass[lost[m]];
		if (!oldVoid.empty())
			(contents.phase[lost[m]] == Phase::gas ? part.asGas : part.asWater) +=
			        std::max(0.0, oldVoid[lost[m]]);
		else
			part.asGas += contents.gas[lost[m]], part.asWater += contents.water[lost[m]];
		part.source |= contents.source[lost[m]] && contents.phase[lost[m]] == Phase::gas;
		part.freeGas |= contents.phase[lost[m]] == Phase::gas && !contents.held[lost[m]];
		if (contents.held[lost[m]]) {
			part.heldGas += contents.gas[lost[m]];
			part.heldPressure += contents.gas[lost[m]] * contents.heldPressure[lost[m]];
		}
	}
	for (std::size_t m = 0; m < made.size(); ++m) {
		Part& part = sums[parts.find(nOld + static_cast<int>(m))];
		part.newVoid += std::max(0.0, newVoid[made[m]]);
		part.nNew += 1;
	}
	for (std::size_t m = 0; m < made.size(); ++m) {
		const Part& part = sums[parts.find(nOld + static_cast<int>(m))];
		const int c = made[m];
		const double share = part.newVoid > 0 ? std::max(0.0, newVoid[c]) / part.newVoid : 1.0 / part.nNew;
		carried.gas[c] = share * part.gas;
		carried.water[c] = share * part.water;
		carried.gasMass[c] = share * part.gasMass;
		carried.phase[c] = part.asGas > 0 && part.asGas >= part.asWater ? Phase::gas : Phase::water;
		carried.source[c] = part.source && carried.phase[c] == Phase::gas;
		if (carried.phase[c] == Phase::gas && part.heldGas > 0 && !part.freeGas) {
			carried.held[c] = 1;
			carried.heldPressure[c] = part.heldPressure / part.heldGas;
		}
	}
	return carried;
}

std::vector<std::uint8_t> carryOverEdges(const Triangulation& before, const std::vector<std::uint8_t>& flags,
        const Triangulation& after, std::uint8_t fresh)
{
	auto pairOf = [](const Edge& e) { return std::make_pair(e.a, e.b); };
	std::vector<std::uint8_t> carried(after.edges.size(), fresh);
	std::size_t o = 0;
	for (std::size_t n = 0; n < after.edges.size(); ++n) { // both are sorted by (a, b)
		while (o < before.edges.size() && pairOf(before.edges[o]) < pairOf(after.edges[n]))
			++o;
		if (o < before.edges.size() && pairOf(before.edges[o]) == pairOf(after.edges[n]))
			carried[n] = flags[o++];
	}
	return carried;
}

} // namespace capfrac
