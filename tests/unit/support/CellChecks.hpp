// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Comparison of cells by their vertices, for the tests of what remeshing does to the contents.

#include "network/Contents.hpp"

#include <gtest/gtest.h>

#include <map>

namespace capfrac {

/// Index of every cell under its vertices.
inline std::map<std::array<int, 3>, int> byVertices(const Triangulation& mesh)
{
	std::map<std::array<int, 3>, int> cells;
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		cells[mesh.cells[c].vertex] = static_cast<int>(c);
	return cells;
}

/// Checks the cells that are in both; returns how many are new.
inline int expectUntouched(
        const Triangulation& before, const Contents& old, const Triangulation& after, const Contents& now)
{
	const auto oldCells = byVertices(before);
	int nNew = 0;
	for (std::size_t c = 0; c < after.cells.size(); ++c) {
		const auto same = oldCells.find(after.cells[c].vertex);
		if (same == oldCells.end()) {
			++nNew;
			continue;
		}
		EXPECT_EQ(now.phase[c], old.phase[same->second]);
		EXPECT_EQ(now.gas[c], old.gas[same->second]);
		EXPECT_EQ(now.water[c], old.water[same->second]);
		EXPECT_EQ(now.source[c], old.source[same->second]);
	}
	return nNew;
}

} // namespace capfrac
