// SPDX-License-Identifier: GPL-2.0-or-later
/// invasion/Drainage: event by event against an oracle that rescans everything after every invasion.

#include "Networks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace capfrac {

namespace {

	using samples::packingNetwork;
	using samples::Random;
	using samples::randomNetwork;

	bool operatesBefore(const Throat& a, const Throat& b)
	{
		if (a.entryPressure != b.entryPressure) return a.entryPressure < b.entryPressure;
		return a.position.x != b.position.x ? a.position.x < b.position.x : a.position.y < b.position.y;
	}

	/// Water with a way out, by passing the news along all throats until there is none.
	std::vector<std::uint8_t> waterWithOutlet(const DrainageNetwork& network)
	{
		std::vector<std::uint8_t> free(network.gas.size());
		for (std::size_t d = 0; d < free.size(); ++d)
			free[d] = network.outlet[d] && !network.gas[d];
		for (bool changed = true; changed;) {
			changed = false;
			for (const Throat& t : network.throats) {
				if (network.gas[t.left] || network.gas[t.right] || free[t.left] == free[t.right])
					continue;
				free[t.left] = free[t.right] = 1;
				changed = true;
			}
		}
		return free;
	}

	/// The domain that injected gas enters through the throat, -1 if there is none.
	int entered(const DrainageNetwork& network, const Throat& t)
	{
		if (network.injected[t.left] && !network.gas[t.right]) return t.right;
		if (network.injected[t.right] && !network.gas[t.left]) return t.left;
		return -1;
	}

	Drainage drainByRescanning(
	        DrainageNetwork network, double capillaryPressure, bool trapping, std::size_t maxSteps = SIZE_MAX)
	{
		Drainage drainage;
		for (;;) {
			const auto free = waterWithOutlet(network);
			int next = -1;
			for (int t = 0; t < static_cast<int>(network.throats.size()); ++t) {
				const Throat& throat = network.throats[t];
				const int domain = entered(network, throat);
				if (domain < 0 || throat.entryPressure > capillaryPressure
				        || (trapping && !free[domain]))
					continue;
				if (next < 0 || operatesBefore(throat, network.throats[next])) next = t;
			}
			if (next < 0 || drainage.steps.size() == maxSteps) {
				for (std::size_t d = 0; trapping && d < free.size(); ++d)
					if (!network.gas[d] && !free[d])
						drainage.trapped.push_back(static_cast<int>(d));
				return drainage;
			}
			const int domain = entered(network, network.throats[next]);
			drainage.steps.push_back({ next, domain });
			network.gas[domain] = network.injected[domain] = 1;
			if (!trapping)
				network.injected = connectedGas(network, network.injected); // gas that was met joins in
		}
	}

	std::vector<std::pair<int, int>> pairs(const std::vector<DrainageStep>& steps)
	{
		std::vector<std::pair<int, int>> result;
		for (const auto& step : steps)
			result.emplace_back(step.throat, step.domain);
		return result;
	}

	void fill(DrainageNetwork& network, const Drainage& drainage)
	{
		for (const auto& step : drainage.steps)
			network.gas[step.domain] = network.injected[step.domain] = 1;
	}

	void expectNoStepTooEarly(const DrainageNetwork& network, const Drainage& drainage, double capillaryPressure)
	{
		for (const auto& step : drainage.steps)
			EXPECT_LE(network.throats[step.throat].entryPressure, capillaryPressure);
	}

	/// Entry pressures from the lowest to the highest, every `stride`-th, one below all and one above.
	std::vector<double> levels(const DrainageNetwork& network, int stride)
	{
		std::vector<double> all { 0, 1e9 };
		for (std::size_t t = 0; t < network.throats.size(); t += stride)
			all.push_back(network.throats[t].entryPressure);
		std::sort(all.begin(), all.end());
		return all;
	}

	/// Returns how many domains were trapped in all.
	int expectOracle(const DrainageNetwork& network, int stride)
	{
		int nTrapped = 0;
		for (double pressure : levels(network, stride))
			for (bool trapping : { false, true }) {
				const auto found = drain(network, pressure, trapping),
				           expected = drainByRescanning(network, pressure, trapping);
				const auto few = drain(network, pressure, trapping, 3),
				           fewExpected = drainByRescanning(network, pressure, trapping, 3);
				EXPECT_EQ(pairs(found.steps), pairs(expected.steps))
				        << "at " << pressure << " Pa, trapping " << trapping;
				EXPECT_EQ(found.trapped, expected.trapped)
				        << "at " << pressure << " Pa, trapping " << trapping;
				EXPECT_EQ(pairs(few.steps), pairs(fewExpected.steps))
				        << "three steps at " << pressure << " Pa, trapping " << trapping;
				EXPECT_EQ(few.trapped, fewExpected.trapped)
				        << "three steps at " << pressure << " Pa, trapping " << trapping;
				expectNoStepTooEarly(network, found, pressure);
				nTrapped += static_cast<int>(found.trapped.size());
			}
		return nTrapped;
	}

	/// Domain d becomes domainOf[d]; throat throatFrom[t] becomes throat t, its sides swapped by chance.
	DrainageNetwork relabelled(const DrainageNetwork& network, const std::vector<int>& domainOf,
	        const std::vector<int>& throatFrom, Random& random)
	{
		DrainageNetwork result = network;
		for (std::size_t d = 0; d < domainOf.size(); ++d) {
			result.gas[domainOf[d]] = network.gas[d];
			result.injected[domainOf[d]] = network.injected[d];
			result.outlet[domainOf[d]] = network.outlet[d];
		}
		for (std::size_t t = 0; t < throatFrom.size(); ++t) {
			Throat throat = network.throats[throatFrom[t]];
			throat.left = domainOf[throat.left];
			throat.right = domainOf[throat.right];
			if (random.chance(0.5)) std::swap(throat.left, throat.right);
			result.throats[t] = throat;
		}
		return result;
	}

	void expectNumberingIrrelevant(const DrainageNetwork& network, double pressure, Random& random)
	{
		const auto domainOf = random.permutation(static_cast<int>(network.gas.size()));
		const auto throatFrom = random.permutation(static_cast<int>(network.throats.size()));
		const auto other = relabelled(network, domainOf, throatFrom, random);
		EXPECT_EQ(nextEntryPressure(network), nextEntryPressure(other));
		for (bool trapping : { false, true }) {
			const auto plain = drain(network, pressure, trapping), mixed = drain(other, pressure, trapping);
			std::vector<std::pair<int, int>> steps;
			for (const auto& step : mixed.steps)
				steps.emplace_back(throatFrom[step.throat],
				        static_cast<int>(std::find(domainOf.begin(), domainOf.end(), step.domain)
				                - domainOf.begin()));
			EXPECT_EQ(steps, pairs(plain.steps));
			EXPECT_EQ(mixed.trapped.size(), plain.trapped.size());
		}
	}

} // namespace

TEST(Drainage, AgreesWithRescanningOnRandomNetworks)
{
	int nTrapped = 0;
	for (unsigned seed = 1; seed <= 500; ++seed) {
		SCOPED_TRACE("seed " + std::to_string(seed));
		Random random(seed);
		nTrapped += expectOracle(randomNetwork(random), 8);
	}
	EXPECT_GT(nTrapped, 1000) << "the networks test nothing";
}

TEST(Drainage, AgreesWithRescanningOnPackings)
{
	int nTrapped = 0;
	for (unsigned seed = 1; seed <= 8; ++seed) {
		SCOPED_TRACE("seed " + std::to_string(seed));
		Random random(seed);
		nTrapped += expectOracle(packingNetwork(random, 80), 25);
	}
	EXPECT_GT(nTrapped, 100) << "the packings test nothing";
}

TEST(Drainage, NumberingDoesNotMatter)
{
	for (unsigned seed = 1; seed <= 200; ++seed) {
		Random random(seed);
		expectNumberingIrrelevant(randomNetwork(random), random.uniform(50, 300), random);
	}
	Random random(1);
	const auto network = packingNetwork(random, 80);
	for (double pressure : levels(network, 40))
		expectNumberingIrrelevant(network, pressure, random);
}

/// Raising the pressure in stages makes the same events in the same order as going there at once.
TEST(Drainage, PathOfPressureDoesNotMatter)
{
	for (unsigned seed = 1; seed <= 100; ++seed)
		for (bool trapping : { false, true }) {
			Random random(seed);
			const auto network = seed <= 95 ? randomNetwork(random) : packingNetwork(random, 60);
			auto staged = network;
			std::vector<std::pair<int, int>> steps;
			const auto stages = levels(network, 5);
			for (double pressure : stages) {
				const auto drainage = drain(staged, pressure, trapping);
				fill(staged, drainage);
				for (auto step : pairs(drainage.steps))
					steps.push_back(step);
			}
			EXPECT_EQ(steps, pairs(drain(network, stages.back(), trapping).steps)) << "seed " << seed;
		}
}

/// What is cut off at the breakthrough is what the whole avalanche did up to there.
TEST(Drainage, UntilOutletIsTheBeginningOfTheWholeAvalanche)
{
	int nCut = 0;
	for (unsigned seed = 1; seed <= 300; ++seed)
		for (bool trapping : { false, true }) {
			Random random(seed);
			const auto network = seed <= 290 ? randomNetwork(random) : packingNetwork(random, 60);
			auto whole = pairs(drain(network, 1e9, trapping).steps);
			const auto outlet = std::find_if(
			        whole.begin(), whole.end(), [&](auto step) { return network.outlet[step.second]; });
			nCut += outlet != whole.end() && outlet + 1 != whole.end();
			if (outlet != whole.end()) whole.erase(outlet + 1, whole.end());
			const auto found = drain(network, 1e9, trapping, std::numeric_limits<int>::max(), true);
			EXPECT_EQ(pairs(found.steps), whole) << "seed " << seed;
			// The water that is trapped then is what stopping after so many steps finds, too.
			if (!whole.empty()) {
				EXPECT_EQ(found.trapped,
				        drain(network, 1e9, trapping, static_cast<int>(whole.size())).trapped);
			}
		}
	EXPECT_GT(nCut, 300) << "the networks test nothing";
}

TEST(Drainage, NextEntryPressureIsWhereTheNextStepComes)
{
	for (unsigned seed = 1; seed <= 200; ++seed) {
		Random random(seed);
		auto network = randomNetwork(random);
		fill(network, drain(network, random.uniform(0, 200), false));
		network.injected = connectedGas(network, network.injected); // gas that was met hangs on the inlet, too
		double lowest = std::numeric_limits<double>::infinity();
		for (const Throat& t : network.throats)
			if (entered(network, t) >= 0) lowest = std::min(lowest, t.entryPressure);
		const double next = nextEntryPressure(network);
		EXPECT_EQ(next, lowest);
		EXPECT_TRUE(drain(network, std::nextafter(next, 0.0), false).steps.empty());
		if (std::isfinite(next)) {
			EXPECT_FALSE(drain(network, next, false).steps.empty());
		}
	}
	EXPECT_EQ(nextEntryPressure({ {}, { 1, 0 }, { 1, 0 }, { 0, 0 } }), std::numeric_limits<double>::infinity());
}

/// A ring 0-1-2-3 with gas in 0 and the outlet at 1: once 1 is full, 2 and 3 are cut off.
TEST(Drainage, TrapsWhatLosesTheOutlet)
{
	const DrainageNetwork ring { { { 0, 0, 1, 10, {} }, { 1, 1, 2, 20, {} }, { 2, 2, 3, 20, {} },
		                             { 3, 3, 0, 15, {} } },
		{ 1, 0, 0, 0 }, { 1, 0, 0, 0 }, { 0, 1, 0, 0 } };
	const auto trapping = drain(ring, 100, true);
	EXPECT_EQ(pairs(trapping.steps), (std::vector<std::pair<int, int>> { { 0, 1 } }));
	EXPECT_EQ(trapping.trapped, (std::vector<int> { 2, 3 }));
	EXPECT_EQ(pairs(drain(ring, 100, false).steps),
	        (std::vector<std::pair<int, int>> { { 0, 1 }, { 3, 3 }, { 1, 2 } }));
	EXPECT_TRUE(drain(ring, 100, false).trapped.empty());
	EXPECT_TRUE(drain(ring, 9.9, true).steps.empty());
	EXPECT_EQ(drain(ring, 10, true).steps.size(), 1u) << "at the entry pressure, not above it";
}

TEST(ConnectedGas, EndsAtWater)
{
	const DrainageNetwork chain { { { 0, 0, 1, 1, {} }, { 1, 1, 2, 1, {} }, { 2, 2, 3, 1, {} },
		                              { 3, 3, 4, 1, {} } },
		{ 1, 1, 0, 1, 0 }, {}, { 0, 0, 1, 0, 0 } };
	EXPECT_EQ(connectedGas(chain, { 1, 0, 0, 0, 0 }), (std::vector<std::uint8_t> { 1, 1, 0, 0, 0 }));
	EXPECT_EQ(connectedGas(chain, { 0, 0, 1, 0, 0 }), (std::vector<std::uint8_t> { 0, 0, 0, 0, 0 }))
	        << "the inlet lies in water";
	EXPECT_EQ(connectedWater(chain), (std::vector<std::uint8_t> { 0, 0, 1, 0, 0 }));
}

} // namespace capfrac
