// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasInvasionEngine.hpp"

namespace yade {

YADE_PLUGIN((GasInvasionEngine));
CREATE_LOGGER(GasInvasionEngine);

void GasInvasionEngine::checkGas(const capfrac::GasOptions& gas) const
{
	capfrac::checkOptions({ trapping, imbibition, snapOff }, gas);
}

void GasInvasionEngine::guardAttributes()
{
	accepted.guard(std::tuple_cat(networkAttributes(), gasAttributes(),
	                       std::tie(invasionInterval, trapping, imbibition, snapOff)),
	        [this] { GasInvasionEngine::checkAttributes(); });
}

void GasInvasionEngine::tell()
{
	GasEngine::tell();
	drained->options = { trapping, imbibition, snapOff };
}

} // namespace yade
