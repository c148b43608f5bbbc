// SPDX-License-Identifier: GPL-2.0-or-later
#include "FlowNetworks.hpp"

#include <gtest/gtest.h>

namespace capfrac::samples {

FlowNetwork randomFlowNetwork(Random& random, int n, double bulkModulus)
{
	FlowNetwork network;
	network.bulkModulus = bulkModulus;
	for (int i = 0; i < n; ++i) {
		network.pores.push_back(pore(random.uniform(0.1, 2), random.uniform(-1, 1), bulkModulus));
		network.pores.back().source = random.chance(0.2) ? random.uniform(-1, 1) : 0;
		if (random.chance(0.05)) network.pores.back().fixedPressure = random.uniform(-1, 1);
		if (random.chance(0.1)) network.links.push_back({ i, random.uniform(-1, 1), random.uniform(0, 2) });
		if (i > 0) network.throats.push_back({ random.below(i), i, random.uniform(0.1, 2) });
		if (i > 1) network.throats.push_back({ i - 1, i, random.uniform(0.1, 2) });
	}
	network.links.push_back({ 0, 0.5, 1 });
	return network;
}

/// Each mass is rounded once, and the sums of n of them n times at worst: far below 1e-12 of what there is.
void expectClosed(const FlowLedger& ledger)
{
	EXPECT_NEAR(ledger.defect(), 0, 1e-12 * (ledger.held + ledger.in + ledger.out));
}

} // namespace capfrac::samples
