// SPDX-License-Identifier: GPL-2.0-or-later
#include "GrainClusters.hpp"
#include "UnionFind.hpp"

#include <algorithm>

namespace capfrac {

std::vector<std::uint8_t> loadBearing(int nGrains, int nMembers, const std::vector<ContactPair>& contacts)
{
	std::vector<std::uint8_t> bears(nMembers, 1);
	for (bool changed = true; changed;) {
		std::vector<int> nContacts(nMembers, 0);
		for (const auto& [a, b] : contacts)
			if (bears[a] && bears[b]) ++nContacts[a], ++nContacts[b];
		changed = false;
		for (int i = 0; i < nGrains; ++i)
			if (bears[i] && nContacts[i] < 2) bears[i] = 0, changed = true;
	}
	return bears;
}

LooseClusters looseClusters(const std::vector<std::uint8_t>& held, const std::vector<ContactPair>& contacts)
{
	const int nMembers = static_cast<int>(held.size());
	UnionFind sets(nMembers);
	for (const auto& [a, b] : contacts)
		sets.join(a, b);
	std::vector<std::uint8_t> hangs(nMembers, 0); // of the set that a member represents
	for (int i = 0; i < nMembers; ++i)
		if (held[i]) hangs[sets.find(i)] = 1;
	LooseClusters loose;
	std::vector<int> numberOf(nMembers, -1);
	for (int i = 0; i < nMembers; ++i) {
		const int set = sets.find(i); // its smallest member, so that it was numbered before its others
		if (set == i && !hangs[set]) numberOf[set] = loose.count++;
		loose.ofMember.push_back(numberOf[set]);
	}
	return loose;
}

} // namespace capfrac
