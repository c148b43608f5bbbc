// SPDX-License-Identifier: GPL-2.0-or-later
#include "ViscousInvasionEngine.hpp"
#include "../bindings/Tables.hpp"

namespace yade {

YADE_PLUGIN((ViscousInvasionEngine));
CREATE_LOGGER(ViscousInvasionEngine);

capfrac::FlowOptions ViscousInvasionEngine::flowOptions() const { return flowOptionsOf(*this); }

void ViscousInvasionEngine::checkAttributes() const
{
	GasEngine::checkAttributes();
	capfrac::checkOptions(flowOptions());
	capfrac::checkOptions(viscousOptions());
}

void ViscousInvasionEngine::guardAttributes()
{
	accepted.guard(std::tuple_cat(networkAttributes(), gasAttributes(), flowAttributesOf(*this),
	                       std::tie(gasViscosity, maxFilling)),
	        [this] { ViscousInvasionEngine::checkAttributes(); });
}

void ViscousInvasionEngine::tell()
{
	GasEngine::tell();
	viscous->options = viscousOptions();
	viscous->flow.options = flowOptions();
}

void ViscousInvasionEngine::finishStep()
{
	reader->grow(*scene, viscous->growth);
	GasEngine::finishStep();
}

boost::python::dict ViscousInvasionEngine::pyPores()
{
	pyPrepare();
	viscous->beforeReport(*network);
	return capfrac::poreTable(*network, viscous->flow, viscous->cellPressures(*network));
}

} // namespace yade
