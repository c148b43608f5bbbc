// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Quasi-static imbibition: which pores does water refill when the capillary pressure falls, which throats does it snap
/// off, and which gas is left behind?
///
/// The event with the highest threshold comes first, as on a path of slowly falling pressure: a throat in gas snaps off
/// below its snap-off pressure, a domain of gas that touches water is refilled below its refill pressure. Its gas has
/// to go somewhere: only gas that hangs on an exit (the inlet) through throats that are not snapped off recedes. What
/// loses its exit is trapped: it keeps its gas and its pressure, and nothing happens in it any more.

#include "Drainage.hpp"

namespace capfrac {

/// The network as imbibition sees it. `injected` need not be given.
struct ImbibitionNetwork : DrainageNetwork {
	std::vector<std::uint8_t>
	        exit; ///< per domain, 1: a gas reservoir; gas leaves here, and the domain itself stays gas
	std::vector<double> refill;  ///< per domain: below this capillary pressure water refills it [Pa]
	std::vector<Vec2> place;     ///< per domain [m]; decides between equal thresholds, so that no numbering does
	std::vector<double> snapOff; ///< per throat: below this capillary pressure it snaps off [Pa]; -infinity: never
};

/// One event: a domain refilled, or a throat snapped off; the other of the two is -1.
struct ImbibitionStep {
	int domain = -1;
	int throat = -1; ///< index into DrainageNetwork::throats
};

struct Imbibition {
	std::vector<ImbibitionStep> steps; ///< in their order
	std::vector<int> trapped;          ///< domains of gas without an exit afterwards, ascending
};

/// The cascade below `capillaryPressure` [Pa], or its first `maxSteps` steps (> 0).
///
/// Water comes from where the sample ends (`outlet`: a domain of gas there touches the reservoir) and from every domain
/// of water that hangs together with it. With `films` water films on the grains feed all other water, and throats that
/// are snapped off, as well. Events at equal thresholds are ordered by place; an event needs a capillary pressure
/// strictly below its threshold, so that drainage (at or above) and imbibition never undo each other at one pressure.
///
/// O(N log N) but for the search whether gas still hangs together: pieces are searched side by side until they meet or
/// the smaller one ends.
Imbibition imbibe(const ImbibitionNetwork& network, double capillaryPressure, bool films,
        int maxSteps = std::numeric_limits<int>::max());

} // namespace capfrac
