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

} // namespace yade
