// SPDX-License-Identifier: GPL-2.0-or-later
/// network/PoreNetwork: it follows grains that move, with what is registered beside it.

#include "Samples.hpp"
#include "network/PoreNetwork.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

namespace capfrac {

namespace {

	using samples::oblong;

	/// What a model may have: its field of the cells is registered by one line.
	struct Marks : Follower {
		std::vector<double> marks;
		int before = 0, after = 0;
		void beforeRemesh(PoreNetwork&) override { ++before; }
		void fields(CarryOver& carry) override { carry.cells(marks, -1); }
		void afterRemesh(PoreNetwork&) override { ++after; }
	};

	PoreNetwork networkOf(const std::vector<Disk>& grains, PoreMode mode = PoreMode::domain)
	{
		PoreNetwork network;
		network.options.mode = mode;
		network.build(grains, oblong);
		return network;
	}

	/// A step of all grains, each its own way, that keeps them in the box.
	void wander(samples::Random& random, std::vector<Disk>& grains, double far)
	{
		for (auto& grain : grains)
			grain.centre += far * Vec2 { random.uniform(-1, 1), random.uniform(-1, 1) };
	}

} // namespace

TEST(PoreNetwork, FieldsFollowRemeshings)
{
	samples::Random random(5);
	auto grains = samples::looseSample(random, 60, oblong, 2);
	auto network = networkOf(grains);
	Marks model;
	model.marks.resize(network.mesh.cells.size());
	std::iota(model.marks.begin(), model.marks.end(), 0.0);
	std::map<std::array<int, 3>, double> known;
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c)
		known[network.mesh.cells[c].vertex] = model.marks[c];
	while (network.counts.remeshes == 0) {
		wander(random, grains, 2e-3);
		network.follow(grains, oblong, model);
	}
	EXPECT_EQ(model.before, 1);
	EXPECT_EQ(model.after, 1);
	ASSERT_EQ(model.marks.size(), network.mesh.cells.size());
	int kept = 0;
	for (std::size_t c = 0; c < network.mesh.cells.size(); ++c)
		if (const auto cell = known.find(network.mesh.cells[c].vertex); cell != known.end()) {
			EXPECT_EQ(model.marks[c], cell->second);
			++kept;
		} else // a new cell has the mark of a neighbour, or none
			EXPECT_TRUE(model.marks[c] == -1 || model.marks[c] < static_cast<double>(known.size()));
	EXPECT_LT(kept, static_cast<int>(known.size()));
	EXPECT_GT(kept, static_cast<int>(known.size()) / 2);
}

TEST(PoreNetwork, IsThatOfTheGrainsWhereverTheyWent)
{
	// The books are kept, and partition and voids are those of a network made anew.
	for (const auto mode : { PoreMode::domain, PoreMode::triangle }) {
		samples::Random random(11);
		auto grains = samples::packedSample(random, 80, oblong, 2);
		auto network = networkOf(grains, mode);
		Marks model;
		for (int step = 0; step < 200; ++step) {
			wander(random, grains, 1e-3);
			network.follow(grains, oblong, model);
			auto anew = networkOf(grains, mode);
			anew.openEdges = network.openEdges; // contacts have a past
			anew.regroup();
			ASSERT_EQ(anew.mesh.cells.size(), network.mesh.cells.size());
			EXPECT_EQ(anew.domains.count, network.domains.count);
			const auto voids = network.voids(), freshVoids = anew.voids();
			// Sums of a few hundred numbers of the order of the box.
			EXPECT_NEAR(std::accumulate(voids.begin(), voids.end(), 0.0),
			        std::accumulate(freshVoids.begin(), freshVoids.end(), 0.0), 1e-13 * oblong.area());
		}
		network.syncContents();
		const auto& books = network.books;
		EXPECT_NEAR(
		        network.contents.totalWater() - books.initialWater - books.waterIn, 0, 1e-12 * oblong.area());
		EXPECT_GT(network.counts.flips, 0);
	}
}

TEST(PoreNetwork, GrainsAtFaultAreNamedAndNothingIsLost)
{
	samples::Random random(2);
	auto grains = samples::looseSample(random, 20, oblong, 2);
	auto network = networkOf(grains);
	const auto cells = network.mesh.cells.size();
	Marks model;
	auto wrong = grains;
	wrong[7].centre.x = std::numeric_limits<double>::quiet_NaN();
	try {
		network.follow(wrong, oblong, model);
		FAIL() << "a place that is no number was followed";
	} catch (const GeometryError& error) {
		EXPECT_EQ(error.grain, 7);
	}
	network.follow(grains, oblong, model);
	EXPECT_EQ(network.mesh.cells.size(), cells);
	EXPECT_EQ(network.nameOf(7), "grain 7");
	network.ids.assign(grains.size() + nWalls, 42);
	EXPECT_EQ(network.nameOf(7), "body #42");
}

TEST(PoreNetwork, OptionsOutOfRangeAreNamed)
{
	NetworkOptions options;
	options.mergeHysteresis = 1.5;
	try {
		checkOptions(options);
		FAIL();
	} catch (const std::invalid_argument& error) {
		EXPECT_STREQ(error.what(), "mergeHysteresis [-] = 1.5, allowed: 0 … 1");
	}
}

} // namespace capfrac
