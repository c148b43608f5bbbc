// SPDX-License-Identifier: GPL-2.0-or-later
/// invasion/Imbibition: event by event against an oracle that looks at everything again after every event.

#include "Networks.hpp"
#include "invasion/Imbibition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <limits>

namespace capfrac {

namespace {

	using samples::packingNetwork;
	using samples::Random;
	using samples::randomNetwork;

	constexpr double never = -std::numeric_limits<double>::infinity();

	/// Gas nearly everywhere, thresholds below the entry pressures, some throats without snap-off, some snapped off
	/// already.
	ImbibitionNetwork imbibitionNetwork(Random& random, const DrainageNetwork& drained, double gasShare)
	{
		ImbibitionNetwork network { drained, {}, {}, {}, {} };
		const int nDomains = static_cast<int>(network.gas.size());
		network.exit.assign(nDomains, 0);
		for (int d = 0; d < nDomains; ++d) {
			network.gas[d] = random.chance(gasShare);
			network.refill.push_back(10.0 * random.below(25));
			network.place.push_back({ random.uniform(0, 1), random.uniform(0, 1) });
		}
		for (int k = 0; k < 2; ++k) {
			const int d = random.below(nDomains);
			network.gas[d] = 1;
			network.exit[d] = 1;
		}
		for (Throat& t : network.throats) {
			t.snapped = network.gas[t.left] && network.gas[t.right] && random.chance(0.1);
			network.snapOff.push_back(random.chance(0.5) ? never : 10.0 * random.below(20));
		}
		return network;
	}

	std::vector<std::uint8_t> fedWater(const ImbibitionNetwork& network, bool films)
	{
		std::vector<std::uint8_t> fed(network.gas.size());
		for (std::size_t d = 0; d < fed.size(); ++d)
			fed[d] = !network.gas[d] && (films || network.outlet[d]);
		for (bool changed = true; changed;) {
			changed = false;
			for (const Throat& t : network.throats)
				if (!network.gas[t.left] && !network.gas[t.right] && fed[t.left] != fed[t.right])
					fed[t.left] = fed[t.right] = 1, changed = true;
		}
		return fed;
	}

	Imbibition imbibeByRescanning(
	        ImbibitionNetwork network, double pressure, bool films, std::size_t maxSteps = SIZE_MAX)
	{
		Imbibition found;
		for (;;) {
			const auto hangs = connectedGas(network, network.exit), fed = fedWater(network, films);
			// (threshold, -x, -y, is a domain): the largest is next.
			std::tuple<double, double, double, bool> best { pressure, 1e9, 1e9, false };
			ImbibitionStep next;
			for (int t = 0; t < static_cast<int>(network.throats.size()); ++t) {
				const Throat& throat = network.throats[t];
				if (throat.snapped || !hangs[throat.left] || !hangs[throat.right]) continue;
				const std::tuple<double, double, double, bool> rank { network.snapOff[t],
					-throat.position.x, -throat.position.y, false };
				if (std::get<0>(rank) > pressure && (next.throat + next.domain == -2 || rank > best))
					best = rank, next = { -1, t };
			}
			for (int d = 0; d < static_cast<int>(network.gas.size()); ++d) {
				if (!hangs[d] || network.exit[d]) continue;
				bool wet = network.outlet[d];
				for (const Throat& t : network.throats)
					if (t.left == d || t.right == d)
						wet |= fed[t.left == d ? t.right : t.left] || (films && t.snapped);
				const std::tuple<double, double, double, bool> rank { network.refill[d],
					-network.place[d].x, -network.place[d].y, true };
				if (wet && std::get<0>(rank) > pressure
				        && (next.throat + next.domain == -2 || rank > best))
					best = rank, next = { d, -1 };
			}
			if (next.throat + next.domain == -2 || found.steps.size() == maxSteps) {
				for (int d = 0; d < static_cast<int>(network.gas.size()); ++d)
					if (network.gas[d] && !hangs[d]) found.trapped.push_back(d);
				return found;
			}
			found.steps.push_back(next);
			if (next.domain >= 0)
				network.gas[next.domain] = 0;
			else
				network.throats[next.throat].snapped = true;
		}
	}

	std::vector<std::pair<int, int>> pairs(const std::vector<ImbibitionStep>& steps)
	{
		std::vector<std::pair<int, int>> result;
		for (const auto& step : steps)
			result.emplace_back(step.domain, step.throat);
		return result;
	}

	void apply(ImbibitionNetwork& network, const Imbibition& imbibition)
	{
		for (const auto& step : imbibition.steps)
			if (step.domain >= 0)
				network.gas[step.domain] = 0;
			else
				network.throats[step.throat].snapped = true;
	}

	struct Count {
		int refilled = 0, snapped = 0, trapped = 0;
	};

	void expectOracle(const ImbibitionNetwork& network, Count& count)
	{
		for (double pressure : { 200.0, 120.0, 60.0, 30.0, 0.0, -1.0 })
			for (bool films : { false, true }) {
				const auto found = imbibe(network, pressure, films),
				           expected = imbibeByRescanning(network, pressure, films);
				EXPECT_EQ(pairs(found.steps), pairs(expected.steps))
				        << "at " << pressure << " Pa, films " << films;
				EXPECT_EQ(found.trapped, expected.trapped)
				        << "at " << pressure << " Pa, films " << films;
				const auto few = imbibe(network, pressure, films, 3),
				           fewExpected = imbibeByRescanning(network, pressure, films, 3);
				EXPECT_EQ(pairs(few.steps), pairs(fewExpected.steps));
				EXPECT_EQ(few.trapped, fewExpected.trapped);
				for (const auto& step : found.steps)
					++(step.domain >= 0 ? count.refilled : count.snapped);
				count.trapped += static_cast<int>(found.trapped.size());
			}
	}

	/// A chain of n domains, the exit at 0, the outlet at its end, all gas.
	ImbibitionNetwork chain(const std::vector<double>& refill, const std::vector<double>& snapOff)
	{
		const int n = static_cast<int>(refill.size());
		ImbibitionNetwork network;
		network.refill = refill, network.snapOff = snapOff;
		network.gas.assign(n, 1);
		network.outlet.assign(n, 0), network.exit.assign(n, 0);
		network.exit[0] = network.outlet[n - 1] = 1;
		for (int d = 0; d < n; ++d)
			network.place.push_back({ 1.0 * d, 0 });
		for (int t = 0; t + 1 < n; ++t)
			network.throats.push_back({ t, t, t + 1, 100, { t + 0.5, 0 }, false });
		return network;
	}

} // namespace

TEST(Imbibition, AgreesWithRescanningOnRandomNetworks)
{
	Count count;
	for (unsigned seed = 1; seed <= 300; ++seed) {
		SCOPED_TRACE("seed " + std::to_string(seed));
		Random random(seed);
		const auto drained = randomNetwork(random);
		expectOracle(imbibitionNetwork(random, drained, seed % 3 ? 0.9 : 0.5), count);
	}
	EXPECT_GT(count.refilled, 1000) << "the networks test nothing";
	EXPECT_GT(count.snapped, 1000);
	EXPECT_GT(count.trapped, 1000);
}

TEST(Imbibition, AgreesWithRescanningOnPackings)
{
	Count count;
	for (unsigned seed = 1; seed <= 6; ++seed) {
		SCOPED_TRACE("seed " + std::to_string(seed));
		Random random(seed);
		const auto drained = packingNetwork(random, 80);
		expectOracle(imbibitionNetwork(random, drained, 0.95), count);
	}
	EXPECT_GT(std::min({ count.refilled, count.snapped, count.trapped }), 100);
}

TEST(Imbibition, PathOfPressureDoesNotMatter)
{
	for (unsigned seed = 1; seed <= 100; ++seed)
		for (bool films : { false, true }) {
			Random random(seed);
			const auto drained = randomNetwork(random);
			const auto network = imbibitionNetwork(random, drained, 0.9);
			auto staged = network;
			std::vector<std::pair<int, int>> steps;
			for (double pressure = 250; pressure >= 0; pressure -= 5) {
				const auto stage = imbibe(staged, pressure, films);
				apply(staged, stage);
				for (auto step : pairs(stage.steps))
					steps.push_back(step);
			}
			EXPECT_EQ(steps, pairs(imbibe(network, 0, films).steps)) << "seed " << seed;
		}
}

/// Water comes from the outlet; the exit stays gas; a domain whose refill pressure is not undercut stops it.
TEST(Imbibition, RecedesAlongAChain)
{
	auto network = chain({ 90, 60, 70, 50, 80 }, { never, never, never, never });
	EXPECT_EQ(pairs(imbibe(network, 80, false).steps), (std::vector<std::pair<int, int>> {})) << "strictly below";
	EXPECT_EQ(pairs(imbibe(network, 79, false).steps), (std::vector<std::pair<int, int>> { { 4, -1 } }));
	EXPECT_EQ(pairs(imbibe(network, 49, false).steps),
	        (std::vector<std::pair<int, int>> { { 4, -1 }, { 3, -1 }, { 2, -1 }, { 1, -1 } }));
	EXPECT_TRUE(imbibe(network, 0, false).trapped.empty());
}

/// A throat that snaps off in the middle traps what is beyond it; films then feed the near side of it.
TEST(Imbibition, SnapOffTraps)
{
	auto network = chain({ 90, 60, 70, 50, 40 }, { never, never, 65, never });
	const auto dry = imbibe(network, 0, false), wet = imbibe(network, 0, true);
	EXPECT_EQ(pairs(dry.steps), (std::vector<std::pair<int, int>> { { -1, 2 } }));
	EXPECT_EQ(dry.trapped, (std::vector<int> { 3, 4 }));
	EXPECT_EQ(pairs(wet.steps), (std::vector<std::pair<int, int>> { { -1, 2 }, { 2, -1 }, { 1, -1 } }));
	EXPECT_EQ(wet.trapped, (std::vector<int> { 3, 4 }));
}

/// A ring of many: refilling two domains cuts the far side off, however the pieces are searched.
TEST(Imbibition, CutsARingInTwo)
{
	const int n = 1000;
	ImbibitionNetwork ring = chain(std::vector<double>(n, 10), std::vector<double>(n - 1, never));
	ring.throats.push_back({ n - 1, n - 1, 0, 100, { -0.5, 0 }, false });
	ring.snapOff.push_back(never);
	ring.outlet.assign(n, 0);
	ring.outlet[300] = ring.outlet[700] = 1;
	ring.refill[300] = ring.refill[700] = 20;
	const auto found = imbibe(ring, 15, false);
	EXPECT_EQ(pairs(found.steps), (std::vector<std::pair<int, int>> { { 300, -1 }, { 700, -1 } }));
	ASSERT_EQ(found.trapped.size(), 399u);
	EXPECT_EQ(found.trapped.front(), 301);
	EXPECT_EQ(found.trapped.back(), 699);
}

/// A lattice with throats at random: the work grows in proportion. Processor time, the least of several: other programs
/// on the machine take none of it, and what they cost in passing cannot make 81 of 9, nor 9 of 81.
TEST(Imbibition, LargeLatticesTakeTheirTimeAndNoMore)
{
	auto work = [](int side) {
		Random random(side);
		ImbibitionNetwork network;
		const int n = side * side;
		network.gas.assign(n, 1), network.outlet.assign(n, 0), network.exit.assign(n, 0);
		for (int d = 0; d < n; ++d) {
			network.outlet[d] = d >= n - side, network.exit[d] = d < side;
			network.refill.push_back(random.uniform(0, 100));
			network.place.push_back({ 1.0 * (d % side), 1.0 * (d / side) });
			for (int other : { d % side + 1 < side ? d + 1 : -1, d + side < n ? d + side : -1 })
				if (other >= 0) {
					network.throats.push_back({ 0, d, other, 200,
					        { random.uniform(0, 1), random.uniform(0, 1) }, false });
					network.snapOff.push_back(random.uniform(-100, 80));
				}
		}
		std::clock_t least = std::numeric_limits<std::clock_t>::max();
		for (int k = 0; k < 3; ++k) {
			const auto start = std::clock();
			const auto found = imbibe(network, 0, true);
			least = std::min(least, std::clock() - start);
			EXPECT_GT(found.trapped.size(), n / 100u);
		}
		return double(least);
	};
	const double small = work(80), large = work(240);
	EXPECT_LT(large, 40 * small) << "9 for N, 81 for N^2";
}

} // namespace capfrac
