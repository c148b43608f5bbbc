// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Domains (the paper's pores, its Figures 3 and 4): connected sets of cells of one phase, joined across
/// the edges whose grains do not touch. Between gas and water an edge is always a throat, however wide:
/// the entry pressure alone decides when the gas advances.

#include "Contents.hpp"

#include <string>

namespace capfrac {

enum class PoreMode { domain, triangle };

/// 'domain' or 'triangle'; throws std::invalid_argument naming `poreMode` otherwise.
PoreMode poreModeFromName(const std::string& name);

struct Domains {
	int count = 0;
	std::vector<int> ofCell; ///< cell -> domain, 0 … count-1, numbered by the first cell of each
	std::vector<int> first;  ///< domain -> its first cell
	std::vector<int> begin;  ///< domain -> where its cells begin in `cells`; count+1 entries
	std::vector<int> cells;  ///< cells sorted by domain

	/// The cells of one domain, in ascending order.
	struct Range {
		const int *from, *to;
		const int* begin() const { return from; }
		const int* end() const { return to; }
	};
	Range cellsOf(int domain) const { return { cells.data() + begin[domain], cells.data() + begin[domain + 1] }; }
};

/// Marks the edges that join cells. An edge opens when its gap [m] exceeds `openGap` and closes again
/// when it falls below `closeGap` (<= openGap: hysteresis, so that a contact that chatters does not make
/// and break domains every step). `fresh` edges have no past and follow `openGap` alone.
/// Returns whether any flag changed.
bool updateOpenEdges(std::vector<std::uint8_t>& open, const std::vector<double>& gap, double openGap, double closeGap);

/// Flag of an edge that has no past yet.
constexpr std::uint8_t freshEdge = 2;

/// Partition of the cells into domains; every cell by itself in `triangle` mode.
Domains findDomains(const Triangulation& mesh, const std::vector<std::uint8_t>& open, const std::vector<Phase>& phase,
        PoreMode mode);

/// Sums a quantity of the cells over the domains.
std::vector<double> sumOverDomains(const Domains& domains, const std::vector<double>& ofCell);

} // namespace capfrac
