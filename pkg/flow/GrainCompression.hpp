// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Grains that the fluid compresses, Eq. 10 of Jain & Juanes (2008):
///
///     r = r_0 (1 - (p - p_0)/(3 K_s)),      p = mean pressure round the grain
///
/// The mean is taken over the arcs that the pores wet, with their lengths as weights. A pore gains the
/// volume that the arcs on it give up, so the pores' compliance is the sum over grains of a a^T c/sum(a):
/// symmetric and positive semidefinite, whatever the arcs. Contacts do not enter the mean: their part of
/// the compression is the overlap of the contact law.

#include "../geometry/VolumeGradients.hpp"

#include <vector>

namespace capfrac {

/// The arc of a grain that a pore wets, times the thickness: -dV/dr [m^2].
struct WettedArc {
	int pore = -1, grain = -1;
	double area = 0;
};

/// Empty where grains are rigid.
struct GrainCompression {
	std::vector<WettedArc> arcs;    ///< sorted by grain, then pore, one for each pair
	std::vector<double> compliance; ///< c = r_0/(3 K_s) of every grain [m/Pa] >= 0
	std::vector<double> lag;        ///< r_0 + c p_0 - r: what the radius now would grow by at pressure zero [m]

	bool empty() const { return arcs.empty(); }
};

/// The arcs of all pores, merged from those of their cells; pore `poreOfCell[c]` holds cell c (-1: none).
std::vector<WettedArc> wettedArcs(
        const VolumeGradients& gradients, const std::vector<int>& poreOfCell, double thickness);

/// Growth of every grain's radius under the pore pressures `pressure` [Pa]: lag - c p_mean [m]. A grain that
/// no pore wets keeps its radius.
std::vector<double> radiusGrowth(const GrainCompression& compression, const std::vector<double>& pressure);

/// Adds to the volumes of the pores [m^3] what `growth` of the radii [m] takes from them, to first order.
void addGrowth(const GrainCompression& compression, const std::vector<double>& growth, std::vector<double>& volume);

/// Largest share of a change of pressure that the grains' answer to it, a step later, takes back [-]:
/// max (K_f/V) sum c a over the pores. A scheme in which grains follow the pressure of the step before is
/// stable below 1.
double laggedResponse(const GrainCompression& compression, const std::vector<double>& volume, double bulkModulus);

/// Calls `visit(from, to, around)` with the arcs [from, to) of each grain and their sum, where that is > 0.
template <class Visit> void forEachGrain(const GrainCompression& compression, Visit visit)
{
	const auto& arcs = compression.arcs;
	for (std::size_t from = 0, to = 0; from < arcs.size(); from = to) {
		double around = 0;
		for (; to < arcs.size() && arcs[to].grain == arcs[from].grain; ++to)
			around += arcs[to].area;
		if (around > 0) visit(from, to, around);
	}
}

} // namespace capfrac
