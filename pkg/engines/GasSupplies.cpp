// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasSupplies.hpp"

namespace yade {

YADE_PLUGIN(CAPFRAC_GAS_SUPPLIES);

capfrac::SupplyOptions GasSupply::options() const
{
	capfrac::refuseAttribute("supply", getClassName(), "an object such as RateSupply()");
}

void GasSupply::check() const
{
	capfrac::checkOptions(options());
	for (Real p : turningPoints())
		capfrac::requireFinite("PressureSupply.program [Pa]", p);
}

capfrac::SupplyOptions PressureSupply::options() const
{
	capfrac::SupplyOptions options;
	options.control = capfrac::GasControl::pressure, options.reservoirVolume = reservoirVolume;
	return options;
}

capfrac::SupplyOptions RateSupply::options() const
{
	capfrac::SupplyOptions options;
	options.control = capfrac::GasControl::rate, options.rate = rate, options.reservoirVolume = reservoirVolume;
	return options;
}

capfrac::SupplyOptions ReservoirSupply::options() const
{
	capfrac::SupplyOptions options;
	options.control = capfrac::GasControl::reservoir, options.reservoirVolume = volume;
	return options;
}

} // namespace yade
