// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasLaws.hpp"
#include "../supply/Supply.hpp"

namespace yade {

YADE_PLUGIN(CAPFRAC_GAS_LAWS);

capfrac::EquationOfState GasLaw::equation() const
{
	capfrac::refuseAttribute("gasLaw", getClassName(), "an object such as IdealGas()");
}

void GasLaw::check() const { capfrac::checkOptions(equation()); }

} // namespace yade
