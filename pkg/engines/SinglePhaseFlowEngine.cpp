// SPDX-License-Identifier: GPL-2.0-or-later
#include "SinglePhaseFlowEngine.hpp"
#include "../bindings/Tables.hpp"

namespace yade {

YADE_PLUGIN((SinglePhaseFlowEngine));
CREATE_LOGGER(SinglePhaseFlowEngine);

namespace py = boost::python;

capfrac::FlowOptions SinglePhaseFlowEngine::flowOptions() const
{
	auto options = flowOptionsOf(*this);
	options.scheme = capfrac::flowSchemeFromName(timeIntegration);
	return options;
}

void SinglePhaseFlowEngine::checkAttributes() const
{
	PoreNetworkEngine::checkAttributes();
	capfrac::checkOptions(flowOptions());
}

void SinglePhaseFlowEngine::guardAttributes()
{
	accepted.guard(std::tuple_cat(networkAttributes(), flowAttributesOf(*this),
	                       std::tie(timeIntegration, fluidDensity, gravity)),
	        [this] { SinglePhaseFlowEngine::checkAttributes(); });
}

void SinglePhaseFlowEngine::tell()
{
	PoreNetworkEngine::tell();
	flow->flow.options = flowOptions();
	flow->initialPressure = waterPressure;
}

Real SinglePhaseFlowEngine::wallStiffness(int wall) const
{
	return prepared() ? flow->flow.wallStiffness(*network, wall) : 0;
}

py::dict SinglePhaseFlowEngine::pyPores()
{
	pyPrepare();
	flow->beforeReport(*network);
	return capfrac::poreTable(*network, flow->flow, flow->cellPressures(*network));
}

py::dict SinglePhaseFlowEngine::pyInflow()
{
	py::dict d;
	for (int w = 0; w < capfrac::nWalls; ++w)
		d[capfrac::wallName(w)] = flow->record.inflow[w];
	return d;
}

Real SinglePhaseFlowEngine::pyTimeStepLimit()
{
	pyPrepare();
	return flow->timeStepLimit(*network, grains());
}

void SinglePhaseFlowEngine::pySetCellPressures(const std::vector<Real>& pressures)
{
	pyPrepare();
	checkCellPressures(pressures);
	flow->setPressures(*network, pressures);
}

} // namespace yade
