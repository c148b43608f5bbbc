// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Quasi-static drainage: which domains does gas enter at a given capillary pressure, in which order?
///
/// Gas advances through the throat with the lowest entry pressure that it touches, domain by domain,
/// as long as there is one at or below the capillary pressure: invasion percolation (Wilkinson &
/// Willemsen 1983) with a lid, an avalanche (Haines jump) per pressure level. Grains stand still
/// meanwhile: the interface moves faster than the skeleton.

#include "../network/Domains.hpp"

#include <limits>

namespace capfrac {

/// A pair of domains and what gas needs to pass from one to the other.
struct Throat {
	int edge = -1;            ///< edge of the triangulation
	int left = -1;            ///< domain on its left
	int right = -1;           ///< domain on its right
	double entryPressure = 0; ///< [Pa]
	Vec2 position;            ///< [m]; decides between equal entry pressures, so that no numbering does
	bool snapped = false; ///< water has snapped it off: gas on both sides does not hang together through it until
	                      ///< it enters anew
};

/// The network as drainage sees it, one entry per domain.
struct DrainageNetwork {
	std::vector<Throat> throats;        ///< between different domains
	std::vector<std::uint8_t> gas;      ///< 1: holds gas
	std::vector<std::uint8_t> injected; ///< 1: holds gas that hangs on the inlet (only this gas advances)
	std::vector<std::uint8_t> outlet;   ///< 1: water leaves the sample here (used with trapping)
};

/// One domain entered through one throat.
struct DrainageStep {
	int throat = -1; ///< index into DrainageNetwork::throats
	int domain = -1; ///< the domain entered; -1 where a throat that was snapped off opened again between two
	                 ///< domains of gas
};

struct Drainage {
	std::vector<DrainageStep> steps; ///< in the order of invasion
	std::vector<int> trapped;        ///< domains of water that lost (or never had) the outlet; only with trapping
};

/// Domains of gas from which the inlet can be reached through gas and throats that are not snapped off. `seed` marks
/// the domains at the inlet.
std::vector<std::uint8_t> connectedGas(const DrainageNetwork& network, const std::vector<std::uint8_t>& seed);

/// Domains of water from which an outlet can be reached through water (any throat conducts water).
std::vector<std::uint8_t> connectedWater(const DrainageNetwork& network);

/// The avalanche at `capillaryPressure` [Pa], or its first `maxSteps` steps (> 0).
///
/// Gas that did not hang on the inlet and is met on the way advances from then on. With `trapping` it waits
/// for the next call, and water that is cut off from every outlet stays: neither the domains that were cut
/// off before nor those cut off on the way are entered. A throat that is snapped off between gas and gas is
/// entered like one before water; what is behind it is met then.
/// With `untilOutlet` the avalanche ends with the first domain entered that is an outlet (breakthrough); the steps up
/// to there are those of the whole avalanche.
///
/// O(n log n) in the number of throats that the gas meets; with trapping in that of all throats.
Drainage drain(const DrainageNetwork& network, double capillaryPressure, bool trapping,
        int maxSteps = std::numeric_limits<int>::max(), bool untilOutlet = false);

/// The lowest entry pressure that the injected gas meets [Pa]; infinity where it meets none.
double nextEntryPressure(const DrainageNetwork& network);

} // namespace capfrac
