// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasBalance.hpp"

#include <algorithm>

namespace capfrac {

GasBalance balanceGas(
        const EquationOfState& gas, double mass, double reservoirVolume, double poreVolume, double lowestPressure)
{
	const double room = reservoirVolume + poreVolume;
	if (!(room > 0)) throw GasLawError("volume of the gas = " + std::to_string(room) + " m³, allowed: > 0");
	const double lowestDensity = gasDensity(gas, lowestPressure);
	if (mass >= lowestDensity * room) {
		const double density = mass / room;
		return { std::max(gasPressure(gas, density), lowestPressure), density,
			1 }; // not below it by round-off either
	}
	const double share = poreVolume > 0 ? (mass / lowestDensity - reservoirVolume) / poreVolume : 0;
	return { lowestPressure, lowestDensity, std::clamp(share, 0.0, 1.0) };
}

} // namespace capfrac
