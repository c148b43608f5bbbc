// SPDX-License-Identifier: GPL-2.0-or-later
/// What the throats let pass, of DisplacementPart: which of them gas is at, which are open, the flows.

#include "Assembly.hpp"
#include "DisplacementPart.hpp"

#include <algorithm>
#include <cmath>

namespace capfrac {

void DisplacementPart::findBeyond()
{
	for (const auto& t : network.throats) {
		const bool a = network.pores[t.a].isGas, b = network.pores[t.b].isGas;
		beyond.push_back(a == b ? -1 : a ? t.b : t.a);
	}
}

double DisplacementPart::heldBehind(int throat) const
{
	const auto& t = network.throats[throat];
	const auto& pore = network.pores[beyond[throat]];
	const double loss = (pore.head.water - t.head.water)
	        - (pore.head.gas - t.head.gas); // of the capillary pressure, from the throat to the body
	return std::min(std::max(0.0, t.entryPressure - loss), pore.bodyPressure);
}

double DisplacementPart::excessInThroat(const DisplacementTrial& trial, int throat) const
{
	const auto& t = network.throats[throat];
	const int water = beyond[throat], gas = water == t.b ? t.a : t.b;
	return (trial.pressure[gas] - network.pores[gas].head.gas + t.head.gas)
	        - (trial.pressure[water] - network.pores[water].head.water + t.head.water);
}

double DisplacementPart::excessBehind(const DisplacementTrial& trial, int throat) const
{
	const auto& t = network.throats[throat];
	const int water = beyond[throat], gas = water == t.b ? t.a : t.b;
	return (trial.pressure[gas] - network.pores[gas].head.gas + network.pores[water].head.gas)
	        - trial.pressure[water];
}

double DisplacementPart::excessOverFilms(const DisplacementTrial& trial, int pore) const
{
	return trial.pressure[pore] - network.pores[pore].head.water - network.filmPressure;
}

double DisplacementPart::viscosityIn(int throat) const
{
	const auto& fluids = network.fluids;
	if (const int pore = beyond[throat]; pore >= 0)
		return share[pore] * fluids.gasViscosity + (1 - share[pore]) * fluids.waterViscosity;
	return network.pores[network.throats[throat].a].isGas ? fluids.gasViscosity : fluids.waterViscosity;
}

void DisplacementPart::findFlows(DisplacementTrial& trial) const
{
	trial.throatFlow.resize(network.throats.size());
	for (std::size_t t = 0; t < network.throats.size(); ++t) {
		const int number = static_cast<int>(t);
		const auto& throat = network.throats[t];
		const auto &a = network.pores[throat.a], &b = network.pores[throat.b];
		const double g = throat.conductance / viscosity[t];
		if (beyond[t] < 0) {
			const double headA = a.isGas ? a.head.gas : a.head.water,
			             headB = b.isGas ? b.head.gas : b.head.water;
			trial.throatFlow[t] =
			        g * ((trial.pressure[throat.a] - headA) - (trial.pressure[throat.b] - headB));
		} else if (!trial.open[t])
			trial.throatFlow[t] = 0;
		else // backwards only on the way to the solution: gas never comes back
			trial.throatFlow[t] =
			        (beyond[t] == throat.b ? g : -g) * (excessBehind(trial, number) - heldBehind(number));
	}
}

/// Once the pressures are those of the open throats: shuts what gas would come back through, all of it, else opens the
/// throat that gas exceeds most. One at a time, for what passes there may keep it out of the others; and never for
/// pressures on the way to the solution, since a throat that has once been passed stays open at less. One that has shut
/// again needs more each time: where stiff water is locked, pressures are known to no more than the rounding of its
/// volume, and gas at rest there would open and shut its throat for ever.
bool DisplacementPart::openAndShut(DisplacementTrial& trial, double margin) const
{
	bool changed = false;
	int next = -1;
	double most = margin;
	for (std::size_t t = 0; t < beyond.size(); ++t) {
		if (beyond[t] < 0) continue;
		const int number = static_cast<int>(t);
		const double behind = excessBehind(trial, number) - heldBehind(number);
		if (trial.open[t]) {
			if (behind < 0) trial.open[t] = 0, changed = true;
			continue;
		}
		// Gas has to stand in the body, too: where that lies far below the throat it may not, though it would
		// pass there.
		const auto& throat = network.throats[t];
		const double excess = throat.advancing
		        ? behind
		        : std::min(behind, excessInThroat(trial, number) - throat.entryPressure);
		if (excess > most && excess > margin * std::pow(4, trial.openings[t])) next = number, most = excess;
	}
	if (changed || next < 0) return changed;
	trial.open[next] = 1;
	++trial.openings[next];
	return true;
}

double DisplacementPart::conductance(const DisplacementTrial& trial, std::size_t t) const
{
	return beyond[t] < 0 || trial.open[t] ? network.throats[t].conductance / viscosity[t] : 0;
}

} // namespace capfrac
