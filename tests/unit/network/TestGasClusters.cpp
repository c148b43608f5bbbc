// SPDX-License-Identifier: GPL-2.0-or-later
/// network/GasClusters: against a flood fill cell by cell, and what the inlets join.

#include "Samples.hpp"
#include "geometry/VoidGeometry.hpp"
#include "network/GasClusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	struct Sample {
		Triangulation mesh;
		Contents contents;
	};

	Sample randomSample(Random& random, double gasShare, double sourceShare)
	{
		const auto grains = samples::looseSample(random, 60, oblong, 2);
		Sample sample { triangulate(grains, oblong), {} };
		sample.contents.resize(sample.mesh.cells.size());
		for (std::size_t c = 0; c < sample.mesh.cells.size(); ++c) {
			if (random.chance(gasShare)) sample.contents.phase[c] = Phase::gas;
			sample.contents.source[c] =
			        sample.contents.phase[c] == Phase::gas && random.chance(sourceShare);
		}
		return sample;
	}

	/// The lowest cell that can be reached over edges between cells of gas, by walking until nothing is new.
	int lowestReached(const Sample& sample, int from)
	{
		std::set<int> reached { from };
		for (std::size_t before = 0; before != reached.size();) {
			before = reached.size();
			for (const Edge& edge : sample.mesh.edges) {
				if (edge.left < 0 || edge.right < 0) continue;
				if (sample.contents.phase[edge.left] != Phase::gas
				        || sample.contents.phase[edge.right] != Phase::gas)
					continue;
				if (reached.count(edge.left)) reached.insert(edge.right);
				if (reached.count(edge.right)) reached.insert(edge.left);
			}
		}
		return *reached.begin();
	}

} // namespace

TEST(GasClusters, AreThoseOfAFloodFill)
{
	int most = 0;
	for (unsigned seed = 1; seed <= 10; ++seed) {
		Random random(seed);
		const auto sample = randomSample(random, 0.4, 0.02);
		const auto clusters = gasClusters(sample.mesh, sample.contents);
		std::set<int> atInlet;
		std::map<int, int> numberOf; // by lowest cell
		for (std::size_t c = 0; c < clusters.ofCell.size(); ++c)
			if (sample.contents.source[c]) atInlet.insert(lowestReached(sample, static_cast<int>(c)));
		int next = 1;
		for (std::size_t c = 0; c < clusters.ofCell.size(); ++c) {
			if (sample.contents.phase[c] == Phase::water) {
				EXPECT_EQ(clusters.ofCell[c], -1);
				continue;
			}
			const int lowest = lowestReached(sample, static_cast<int>(c));
			if (atInlet.count(lowest))
				EXPECT_EQ(clusters.ofCell[c], 0);
			else {
				if (!numberOf.count(lowest)) numberOf[lowest] = next++;
				EXPECT_EQ(clusters.ofCell[c], numberOf[lowest]);
			}
		}
		EXPECT_EQ(clusters.count, next);
		most = std::max(most, clusters.count);
	}
	EXPECT_GT(most, 4) << "too few clusters to test anything";
}

TEST(GasClusters, WithoutGasThereIsTheEmptyOne)
{
	Random random(3);
	const auto sample = randomSample(random, 0, 0);
	const auto clusters = gasClusters(sample.mesh, sample.contents);
	EXPECT_EQ(clusters.count, 1);
	EXPECT_EQ(clusters.ofCell, std::vector<int>(sample.mesh.cells.size(), -1));
}

TEST(GasClusters, AllInletsAreOne)
{
	Random random(4);
	auto sample = randomSample(random, 0.3, 1);
	const auto clusters = gasClusters(sample.mesh, sample.contents);
	EXPECT_EQ(clusters.count, 1);
	for (std::size_t c = 0; c < clusters.ofCell.size(); ++c)
		EXPECT_EQ(clusters.ofCell[c], sample.contents.phase[c] == Phase::gas ? 0 : -1);
}

} // namespace capfrac
