// SPDX-License-Identifier: GPL-2.0-or-later
/// network/Domains: cells join where gaps are open and the phase is one.

#include "Samples.hpp"
#include "geometry/VoidGeometry.hpp"
#include "network/Domains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	std::vector<std::uint8_t> openWhere(
	        const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box, double openGap)
	{
		std::vector<double> gaps;
		for (const Edge& e : mesh.edges)
			gaps.push_back(gap(mesh, e.a, e.b, grains, box));
		std::vector<std::uint8_t> open(gaps.size(), freshEdge);
		updateOpenEdges(open, gaps, openGap, openGap);
		return open;
	}

	/// Domains by repainting neighbours until nothing changes.
	std::vector<int> repainted(
	        const Triangulation& mesh, const std::vector<std::uint8_t>& open, const std::vector<Phase>& phase)
	{
		std::vector<int> colour(mesh.cells.size());
		std::iota(colour.begin(), colour.end(), 0);
		for (bool changed = true; changed;) {
			changed = false;
			for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
				int &left = colour[mesh.edges[e].left], &right = colour[mesh.edges[e].right];
				if (!open[e] || phase[mesh.edges[e].left] != phase[mesh.edges[e].right]
				        || left == right)
					continue;
				left = right = std::min(left, right);
				changed = true;
			}
		}
		return colour;
	}

	/// Numbers 0, 1, ... in the order in which the domains first come up.
	void expectNumbering(const Domains& domains)
	{
		ASSERT_EQ(static_cast<int>(domains.first.size()), domains.count);
		int seen = 0;
		for (int c = 0; c < static_cast<int>(domains.ofCell.size()); ++c) {
			ASSERT_LE(domains.ofCell[c], seen);
			if (domains.ofCell[c] < seen) continue;
			EXPECT_EQ(domains.first[seen], c);
			++seen;
		}
		EXPECT_EQ(seen, domains.count);
	}

	/// The network of contacts, walls included, divides the box: its faces by Euler's formula.
	int facesOfContactGraph(const Triangulation& mesh, const std::vector<std::uint8_t>& open)
	{
		std::vector<int> part(mesh.nGrains + nWalls);
		std::iota(part.begin(), part.end(), 0);
		std::fill(part.end() - nWalls, part.end(), mesh.nGrains); // the walls hang together at the corners
		int nClosed = 0;
		for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
			if (open[e]) continue;
			++nClosed;
			const int from = part[mesh.edges[e].a], to = part[mesh.edges[e].b];
			std::replace(part.begin(), part.end(), from, to);
		}
		std::sort(part.begin(), part.end());
		const int nParts = static_cast<int>(std::unique(part.begin(), part.end()) - part.begin());
		// V - E + F = 1 + parts, the face outside taken off again, and as many walls as sides of the box.
		return nClosed - mesh.nGrains + nParts;
	}

} // namespace

TEST(OpenEdges, GapsOpenAndCloseWithHysteresis)
{
	std::vector<std::uint8_t> open { freshEdge };
	auto after = [&](double gap) {
		updateOpenEdges(open, { gap }, 0.2, 0.1);
		return static_cast<int>(open[0]);
	};
	EXPECT_EQ(after(0.15), 0) << "a fresh edge follows openGap alone";
	EXPECT_EQ(after(0.2), 0) << "exceeds, not reaches";
	EXPECT_EQ(after(0.21), 1);
	EXPECT_EQ(after(0.15), 1) << "stays open between the two";
	EXPECT_EQ(after(0.11), 1);
	EXPECT_EQ(after(0.1), 0);
	EXPECT_EQ(after(0.15), 0) << "stays closed between the two";
	EXPECT_EQ(after(-0.5), 0);
	EXPECT_EQ(after(0.5), 1);
}

TEST(OpenEdges, ReportsAnyChange)
{
	std::vector<std::uint8_t> open { freshEdge, freshEdge, freshEdge };
	EXPECT_TRUE(updateOpenEdges(open, { 0.5, 0.15, -0.1 }, 0.2, 0.1));
	EXPECT_EQ(open, (std::vector<std::uint8_t> { 1, 0, 0 }));
	EXPECT_FALSE(updateOpenEdges(open, { 0.15, 0.15, 0.15 }, 0.2, 0.1));
	EXPECT_TRUE(updateOpenEdges(open, { 0.15, 0.3, 0.15 }, 0.2, 0.1));
	EXPECT_EQ(open, (std::vector<std::uint8_t> { 1, 1, 0 }));
	open[0] = freshEdge;
	EXPECT_TRUE(updateOpenEdges(open, { 0.15, 0.3, 0.15 }, 0.2, 0.1)) << "a fresh edge is news";
	EXPECT_EQ(open[0], 0);
}

TEST(Domains, AllOpenAllClosedAndTriangleMode)
{
	Random random(1);
	const auto mesh = triangulate(samples::looseSample(random, 40, oblong, 2), oblong);
	const int nCells = static_cast<int>(mesh.cells.size());
	const std::vector<std::uint8_t> open(mesh.edges.size(), 1), closed(mesh.edges.size(), 0);
	const std::vector<Phase> water(nCells, Phase::water);
	EXPECT_EQ(findDomains(mesh, open, water, PoreMode::domain).count, 1);
	EXPECT_EQ(findDomains(mesh, closed, water, PoreMode::domain).count, nCells);
	const auto triangles = findDomains(mesh, open, water, PoreMode::triangle);
	EXPECT_EQ(triangles.count, nCells);
	expectNumbering(triangles);
}

TEST(Domains, OneEdgeMergesAndSplits)
{
	Random random(2);
	const auto mesh = triangulate(samples::looseSample(random, 30, oblong, 2), oblong);
	const int nCells = static_cast<int>(mesh.cells.size());
	const std::vector<Phase> water(nCells, Phase::water);
	std::vector<std::uint8_t> open(mesh.edges.size(), 0);
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		open[e] = 1;
		const auto merged = findDomains(mesh, open, water, PoreMode::domain);
		EXPECT_EQ(merged.count, nCells - 1);
		EXPECT_EQ(merged.ofCell[mesh.edges[e].left], merged.ofCell[mesh.edges[e].right]);
		expectNumbering(merged);
		auto phase = water;
		phase[mesh.edges[e].left] = Phase::gas;
		EXPECT_EQ(findDomains(mesh, open, phase, PoreMode::domain).count, nCells) << "gas and water stay apart";
		open[e] = 0;
		EXPECT_EQ(findDomains(mesh, open, water, PoreMode::domain).count, nCells);
	}
}

TEST(Domains, AgreeWithRepaintingAndNeverMixPhases)
{
	for (unsigned seed = 1; seed <= 20; ++seed) {
		Random random(seed);
		const auto grains = samples::packedSample(random, 60, oblong, 1.67);
		const auto mesh = triangulate(grains, oblong);
		const auto open = openWhere(mesh, grains, oblong, 0.01 * random.uniform(-1, 2));
		std::vector<Phase> phase(mesh.cells.size());
		for (Phase& p : phase)
			p = random.chance(0.4) ? Phase::gas : Phase::water;
		const auto domains = findDomains(mesh, open, phase, PoreMode::domain);
		const auto expected = repainted(mesh, open, phase);
		expectNumbering(domains);
		for (std::size_t c = 0; c < phase.size(); ++c) {
			EXPECT_EQ(domains.first[domains.ofCell[c]], expected[c]) << "seed " << seed;
			EXPECT_EQ(phase[domains.first[domains.ofCell[c]]], phase[c]) << "seed " << seed;
		}
	}
}

TEST(Domains, AreTheFacesOfTheContactGraph)
{
	for (unsigned seed = 1; seed <= 10; ++seed) {
		Random random(seed);
		const auto grains = samples::packedSample(random, 100, oblong, 1.67);
		const auto mesh = triangulate(grains, oblong);
		const auto open = openWhere(mesh, grains, oblong, 0);
		const auto domains =
		        findDomains(mesh, open, std::vector<Phase>(mesh.cells.size(), Phase::water), PoreMode::domain);
		EXPECT_EQ(domains.count, facesOfContactGraph(mesh, open)) << "seed " << seed;
		// The sample is a packing: about one pore a grain, as the notes on the physics have it.
		EXPECT_GT(domains.count, 50);
		EXPECT_LT(domains.count, 150);
	}
}

TEST(Domains, SumsKeepTheTotal)
{
	Random random(6);
	const auto grains = samples::packedSample(random, 80, oblong, 1.67);
	const auto mesh = triangulate(grains, oblong);
	const auto voids = voidAreas(mesh, grains, oblong);
	const auto domains = findDomains(mesh, openWhere(mesh, grains, oblong, 0),
	        std::vector<Phase>(voids.size(), Phase::water), PoreMode::domain);
	const auto sums = sumOverDomains(domains, voids);
	ASSERT_EQ(static_cast<int>(sums.size()), domains.count);
	const double total = std::accumulate(voids.begin(), voids.end(), 0.0);
	// Two ways to add 162 numbers: 162 eps at the very most.
	EXPECT_NEAR(std::accumulate(sums.begin(), sums.end(), 0.0), total, 4e-14 * total);
	for (int d = 0; d < domains.count; ++d) {
		double sum = 0;
		for (std::size_t c = 0; c < voids.size(); ++c)
			if (domains.ofCell[c] == d) sum += voids[c];
		EXPECT_EQ(sums[d], sum);
	}
}

} // namespace capfrac
