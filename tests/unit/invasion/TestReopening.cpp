// SPDX-License-Identifier: GPL-2.0-or-later
/// invasion/Drainage with throats that are snapped off: gas passes them at their entry pressure, not before.

#include "Networks.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	using samples::Random;
	using samples::randomNetwork;

	std::vector<std::pair<int, int>> pairs(const std::vector<DrainageStep>& steps)
	{
		std::vector<std::pair<int, int>> result;
		for (const auto& step : steps)
			result.emplace_back(step.throat, step.domain);
		return result;
	}

	bool operatesBefore(const Throat& a, const Throat& b)
	{
		if (a.entryPressure != b.entryPressure) return a.entryPressure < b.entryPressure;
		return a.position.x != b.position.x ? a.position.x < b.position.x : a.position.y < b.position.y;
	}

	/// Without trapping: everything looked at again after each step.
	std::vector<std::pair<int, int>> byRescanning(DrainageNetwork network, double pressure)
	{
		std::vector<std::pair<int, int>> steps;
		for (;;) {
			network.injected = connectedGas(network, network.injected);
			int next = -1;
			for (int t = 0; t < static_cast<int>(network.throats.size()); ++t) {
				const Throat& throat = network.throats[t];
				const bool meets = network.injected[throat.left] || network.injected[throat.right];
				const bool closed =
				        !network.gas[throat.left] || !network.gas[throat.right] || throat.snapped;
				if (meets && closed && throat.entryPressure <= pressure
				        && (next < 0 || operatesBefore(throat, network.throats[next])))
					next = t;
			}
			if (next < 0) return steps;
			Throat& throat = network.throats[next];
			const int water = !network.gas[throat.left] ? throat.left
			        : !network.gas[throat.right]        ? throat.right
			                                            : -1;
			steps.emplace_back(next, water);
			if (water >= 0) network.gas[water] = network.injected[water] = 1;
			throat.snapped = false;
		}
	}

} // namespace

TEST(Reopening, AgreesWithRescanning)
{
	int nReopened = 0;
	for (unsigned seed = 1; seed <= 300; ++seed) {
		Random random(seed);
		auto network = randomNetwork(random);
		for (auto& gas : network.gas)
			gas |= random.chance(0.4);
		for (Throat& t : network.throats)
			t.snapped = network.gas[t.left] && network.gas[t.right] && random.chance(0.6);
		network.injected = connectedGas(network, network.injected);
		for (double pressure : { 60.0, 120.0, 180.0, 240.0, 400.0 }) {
			const auto steps = pairs(drain(network, pressure, false).steps);
			EXPECT_EQ(steps, byRescanning(network, pressure)) << "seed " << seed << " at " << pressure;
			for (auto [throat, domain] : steps)
				nReopened += domain < 0;
		}
	}
	EXPECT_GT(nReopened, 500) << "the networks test nothing";
}

/// Gas 0, snapped throat, gas 1, water 2 with the outlet.
TEST(Reopening, GasBehindASnappedThroatJoinsAtItsEntryPressure)
{
	DrainageNetwork network { { { 0, 0, 1, 50, {}, true }, { 1, 1, 2, 40, {}, false } }, { 1, 1, 0 }, { 1, 0, 0 },
		{ 0, 0, 1 } };
	EXPECT_EQ(connectedGas(network, { 1, 0, 0 }), (std::vector<std::uint8_t> { 1, 0, 0 }));
	EXPECT_EQ(nextEntryPressure(network), 50);
	EXPECT_TRUE(drain(network, 49, false).steps.empty());
	EXPECT_EQ(pairs(drain(network, 50, false).steps), (std::vector<std::pair<int, int>> { { 0, -1 }, { 1, 2 } }));
	EXPECT_EQ(pairs(drain(network, 50, true).steps), (std::vector<std::pair<int, int>> { { 0, -1 } }))
	        << "with trapping what was met waits for the next call";
}

} // namespace capfrac
