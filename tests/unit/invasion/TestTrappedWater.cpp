// SPDX-License-Identifier: GPL-2.0-or-later
/// invasion/TrappedWater: clusters without an outlet, and the throat through which gas empties them.

#include "Networks.hpp"
#include "invasion/TrappedWater.hpp"

#include <gtest/gtest.h>

namespace capfrac {

using samples::Random;
using samples::randomNetwork;

TEST(TrappedWater, EveryTrappedDomainIsInOneCluster)
{
	int nClusters = 0;
	for (unsigned seed = 1; seed <= 300; ++seed) {
		Random random(seed);
		auto network = randomNetwork(random);
		for (auto& gas : network.gas)
			gas |= random.chance(0.4);
		network.injected = connectedGas(network, network.injected);
		const auto free = connectedWater(network), none = std::vector<std::uint8_t>(network.gas.size(), 0);
		std::vector<int> clusterOf(network.gas.size(), -1);
		const auto clusters = trappedClusters(network);
		for (std::size_t k = 0; k < clusters.size(); ++k)
			for (int d : clusters[k].domains) {
				EXPECT_EQ(clusterOf[d], -1);
				clusterOf[d] = static_cast<int>(k);
			}
		for (std::size_t d = 0; d < network.gas.size(); ++d)
			EXPECT_EQ(clusterOf[d] >= 0, !network.gas[d] && !free[d]);
		// One cluster is what hangs together, no more and no less.
		for (const auto& cluster : clusters) {
			auto flood = network;
			flood.outlet = none;
			flood.outlet[cluster.domains.front()] = 1;
			const auto reached = connectedWater(flood);
			for (std::size_t d = 0; d < network.gas.size(); ++d)
				EXPECT_EQ(reached[d] != 0, clusterOf[d] == clusterOf[cluster.domains.front()]);
			double lowest = std::numeric_limits<double>::infinity();
			for (const Throat& t : network.throats)
				for (auto [from, to] :
				        { std::make_pair(t.left, t.right), std::make_pair(t.right, t.left) })
					if (network.injected[from] && reached[to])
						lowest = std::min(lowest, t.entryPressure);
			if (cluster.throat < 0) {
				EXPECT_EQ(lowest, std::numeric_limits<double>::infinity());
			} else {
				EXPECT_EQ(network.throats[cluster.throat].entryPressure, lowest);
				EXPECT_TRUE(reached[cluster.behind]);
			}
		}
		nClusters += static_cast<int>(clusters.size());
	}
	EXPECT_GT(nClusters, 500) << "the networks test nothing";
}

TEST(TrappedWater, NothingFlowsBelowTheEntryPressure)
{
	EXPECT_EQ(filmOutflow(2e-12, 99, 100), 0);
	EXPECT_EQ(filmOutflow(0, 200, 100), 0);
	EXPECT_DOUBLE_EQ(filmOutflow(2e-12, 150, 100), 1e-10);
}

} // namespace capfrac
