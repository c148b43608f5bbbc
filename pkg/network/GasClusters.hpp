// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Gas that hangs together. Without viscosity it is at rest in itself: one cluster has one pressure.

#include "Contents.hpp"

namespace capfrac {

struct GasClusters {
	std::vector<int>
	        ofCell; ///< number of the cluster of each cell: -1 water, 0 connected to an inlet, 1, 2, … cut off
	int count = 1;  ///< clusters, the connected one (it may be empty) among them
};

/// Clusters of the cells of gas: two that share an edge hang together, as the gas passes an open throat, but for those
/// marked in `shut` (one flag per edge; empty: none). All that hang on a cell with `source` are one, joined by what
/// supplies them. `contents` belongs to `mesh`. Clusters that are cut off are numbered in the order of their first
/// cells.
GasClusters gasClusters(
        const Triangulation& mesh, const Contents& contents, const std::vector<std::uint8_t>& shut = {});

} // namespace capfrac
