// SPDX-License-Identifier: GPL-2.0-or-later
/// network/GrainClusters: against a walk grain by grain, and cases by hand.

#include "Samples.hpp"
#include "network/GrainClusters.hpp"

#include <gtest/gtest.h>

#include <set>

namespace capfrac {

namespace {

	using samples::Random;

	std::vector<ContactPair> randomContacts(Random& random, int nMembers, int nContacts)
	{
		std::vector<ContactPair> contacts;
		while (static_cast<int>(contacts.size()) < nContacts) {
			const int a = random.below(nMembers), b = random.below(nMembers);
			if (a != b) contacts.push_back({ a, b });
		}
		return contacts;
	}

	std::set<int> reachedFrom(int start, const std::vector<ContactPair>& contacts)
	{
		std::set<int> reached { start };
		for (std::size_t before = 0; before != reached.size();) {
			before = reached.size();
			for (const auto& [a, b] : contacts)
				if (reached.count(a) || reached.count(b)) reached.insert({ a, b });
		}
		return reached;
	}

} // namespace

TEST(LooseClusters, AreThoseOfAWalk)
{
	Random random(11);
	for (int sample = 0; sample < 200; ++sample) {
		const int nMembers = 12;
		const auto contacts = randomContacts(random, nMembers, sample % 14);
		std::vector<std::uint8_t> held(nMembers, 0);
		for (auto& flag : held)
			flag = random.chance(0.15);
		const auto loose = looseClusters(held, contacts);
		std::set<int> numbers;
		for (int i = 0; i < nMembers; ++i) {
			const auto together = reachedFrom(i, contacts);
			bool hangs = false;
			for (int j : together)
				hangs |= held[j] != 0;
			ASSERT_EQ(loose.ofMember[i] < 0, hangs);
			if (hangs) continue;
			numbers.insert(loose.ofMember[i]);
			for (int j = 0; j < nMembers; ++j)
				ASSERT_EQ(loose.ofMember[i] == loose.ofMember[j], together.count(j) == 1);
		}
		ASSERT_EQ(static_cast<int>(numbers.size()), loose.count);
	}
}

TEST(LooseClusters, WithoutContactsEachGrainIsOne)
{
	const auto loose = looseClusters({ 0, 1, 0 }, {});
	EXPECT_EQ(loose.ofMember, (std::vector<int> { 0, -1, 1 }));
	EXPECT_EQ(loose.count, 2);
}

TEST(LoadBearing, AChainThatEndsBearsNothing)
{
	// Grains 0-1-2 between the walls 4 and 5; grain 3 hangs on 1 alone.
	EXPECT_EQ(loadBearing(4, 6, { { 4, 0 }, { 0, 1 }, { 1, 2 }, { 2, 5 }, { 1, 3 } }),
	        (std::vector<std::uint8_t> { 1, 1, 1, 0, 1, 1 }));
	// Without the contact to wall 5 the whole chain lets go, one after the other.
	EXPECT_EQ(loadBearing(4, 6, { { 4, 0 }, { 0, 1 }, { 1, 2 }, { 1, 3 } }),
	        (std::vector<std::uint8_t> { 0, 0, 0, 0, 1, 1 }));
}

} // namespace capfrac
