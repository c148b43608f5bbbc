// SPDX-License-Identifier: GPL-2.0-or-later
#include "FluidModel.hpp"

#include "../network/PoreNetwork.hpp"

#include <limits>

namespace capfrac {

FluidForces FluidModel::loads(const PoreNetwork& network) const
{
	return fluidForces(network.mesh, cellPressures(network), network.grains, network.box);
}

double FluidModel::entryPressureOf(const PoreNetwork&, int) const { return std::numeric_limits<double>::quiet_NaN(); }

std::vector<double> FixedPressures::cellPressures(const PoreNetwork& network) const
{
	return ofCells.empty() ? std::vector<double>(network.mesh.cells.size(), pressure) : ofCells;
}

} // namespace capfrac
