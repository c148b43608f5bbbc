// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The pressure of a given mass of gas in a given room, water giving way.

#include "../laws/EquationOfState.hpp"

namespace capfrac {

struct GasBalance {
	double pressure = 0; ///< absolute [Pa]
	double density = 0;  ///< [kg/m^3]
	double share = 1;    ///< share of the pores that the gas takes [-], in [0, 1]; the rest is water
};

/// `mass` [kg] > 0 of gas in a reservoir of `reservoirVolume` [m^3] >= 0 and in pores of `poreVolume` [m^3], together >
/// 0.
///
/// The gas fills both and has the pressure of its density there, M = rho(p) (V_r + V_p). Where that would be less than
/// `lowestPressure` (absolute [Pa] > 0), the pressure of the water, the gas takes only so much of the pores that it has
/// that pressure, M = rho(p_w) (V_r + s V_p), and water stays in, or comes back into, the rest. Throws GasLawError
/// where the law of the gas does not reach, or there is no room.
GasBalance balanceGas(
        const EquationOfState& gas, double mass, double reservoirVolume, double poreVolume, double lowestPressure);

} // namespace capfrac
