// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Columns of gas and of water at rest: what pressures at a place exceed those at the datum by.

#include "../flow/TwoFluids.hpp"
#include "../geometry/Shapes.hpp"

namespace capfrac {

struct Hydrostatics {
	double waterDensity = 0, gasDensity = 0; ///< [kg/m^3] >= 0; constant, whatever the equation of state says
	Vec2 gravity;                            ///< [m/s^2]
	Vec2 datum;                              ///< the place at which pressures are counted [m]

	bool weightless() const { return waterDensity == 0 && gasDensity == 0; }
	bool heavy() const { return !weightless() && (gravity.x != 0 || gravity.y != 0); }
	/// Heads of both fluids at a place [Pa].
	FluidHeads headsAt(Vec2 place) const
	{
		if (!heavy()) return {};
		const double fall = gravity.x * (place.x - datum.x) + gravity.y * (place.y - datum.y);
		return { waterDensity * fall, gasDensity * fall };
	}
	/// What the capillary pressure at a place exceeds that at the datum by [Pa].
	double head(Vec2 place) const
	{
		if (!heavy()) return 0;
		return (gasDensity - waterDensity)
		        * (gravity.x * (place.x - datum.x) + gravity.y * (place.y - datum.y));
	}
	/// Weight of a fluid per volume [N/m^3].
	Vec2 weight(bool gas) const
	{
		const double density = gas ? gasDensity : waterDensity;
		return { density * gravity.x, density * gravity.y };
	}
};

} // namespace capfrac
