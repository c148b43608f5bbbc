// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where gas enters the sample.

#include "../network/PoreNetwork.hpp"

namespace capfrac {

struct InletOptions {
	std::string wall = "bottom"; ///< 'left', 'right', 'bottom' or 'top'
	double from = 0, to = 0;     ///< stretch of the wall [m]; infinite: to its ends
	std::vector<Vec2> points;    ///< in place of a stretch: the pores that hold them [m]
};

/// Puts the ends of the wall in the place of infinite ones of the inlet.
void reachWallEnds(const PoreNetwork& network, InletOptions& inlet);
/// Throws std::invalid_argument where the inlet is none, or is not where it was meant to be.
void checkInlet(const PoreNetwork& network, const InletOptions& inlet);
/// The domains of the inlet, ascending: those whose stretch of wall has its middle in it, or that hold a point.
std::vector<int> inletDomains(const PoreNetwork& network, const InletOptions& inlet);
/// Width of wall that those domains cover [m]; 0 for points.
double inletWidth(const PoreNetwork& network, const InletOptions& inlet, const std::vector<int>& domains);
/// The middle of the inlet [m], where the pressures of fluids with weight are counted from.
Vec2 middleOf(const PoreNetwork& network, const InletOptions& inlet);
/// The stretch of the inlet's wall that `nPores` neighbouring pores cover, as near to the coordinate `centre` [m] as
/// there are. Throws std::invalid_argument when the wall has fewer.
std::pair<double, double> inletStretch(
        const PoreNetwork& network, const InletOptions& inlet, int nPores, double centre);

} // namespace capfrac
