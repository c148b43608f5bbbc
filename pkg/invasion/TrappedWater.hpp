// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Water that is cut off from every outlet, cluster by cluster, and how it leaves through films on the grains.
///
/// Gas presses on a cluster until its widest throat to gas holds no more: the water there has the pressure p_g - P_e,
/// P_e the lowest entry pressure on its border. Above the water's own pressure p_w outside it is pressed out along the
/// films,
///
///     q = K (p_g - P_e - p_w) = K (P_c - P_e),
///
/// and the pore behind that throat empties. P_c < P_e: nothing moves.

#include "Drainage.hpp"

namespace capfrac {

struct TrappedCluster {
	std::vector<int> domains; ///< ascending
	int throat = -1; ///< the throat with the lowest entry pressure to injected gas; -1 where it touches none
	int behind = -1; ///< the domain of the cluster at that throat
};

/// The clusters, in the order of their first domains. Throats of equal entry pressure are ordered by place, as in
/// drain().
std::vector<TrappedCluster> trappedClusters(const DrainageNetwork& network);

/// What a cluster loses [m^3/s], >= 0: `conductance` K [m^3/(Pa s)] >= 0 times what `capillaryPressure` exceeds
/// `entryPressure` by [Pa].
double filmOutflow(double conductance, double capillaryPressure, double entryPressure);

} // namespace capfrac
