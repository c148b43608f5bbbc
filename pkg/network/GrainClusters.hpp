// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Grains that hang together by contacts: which of them bear load, and which nothing holds.
///
/// Members are numbered as the vertices of the network: grains first, then walls.

#include <array>
#include <cstdint>
#include <vector>

namespace capfrac {

/// The two members of a contact.
using ContactPair = std::array<int, 2>;

/// Whether each of the members bears load: the first `nGrains` of them (grains) as long as two or more of `contacts`,
/// those that bear load, lead to others that do; the rest (walls) always. Taking a grain away may leave its neighbour
/// with one contact: so until nothing changes.
std::vector<std::uint8_t> loadBearing(int nGrains, int nMembers, const std::vector<ContactPair>& contacts);

/// Grains that hang together, and on nothing else.
struct LooseClusters {
	std::vector<int> ofMember; ///< number of each member's cluster, 0, 1, … in the order of first members; -1: held
	int count = 0;             ///< clusters
};

/// Clusters of members that `contacts` join, but for those in which one is `held` (a flag per member): a wall, or a
/// grain that somebody holds.
LooseClusters looseClusters(const std::vector<std::uint8_t>& held, const std::vector<ContactPair>& contacts);

} // namespace capfrac
