// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PoreNetworkEngine.hpp"
#include "WaterFlowAttributes.hpp"

namespace yade {

/// One fluid that flows through the pores: capfrac::SinglePhase.
class SinglePhaseFlowEngine : public PoreNetworkEngine {
public:
	virtual ~SinglePhaseFlowEngine() = default;
	void postLoad(SinglePhaseFlowEngine&) { followAs<SinglePhaseFlowEngine>(); }
	Real wallStiffness(int wall) const override;

	boost::python::dict pyPores();
	boost::python::dict pyInflow();
	Real pyTimeStepLimit();
	void pySetCellPressures(const std::vector<Real>& pressures) override;
	std::vector<Real> wallInflow() const { return { flow->record.inflow.begin(), flow->record.inflow.end() }; }

protected:
	capfrac::FluidModel& model() override { return *flow; }
	void tell() override;
	void checkAttributes() const override;
	void guardAttributes() override;
	void finishStep() override { reader->grow(*scene, flow->growth); }

private:
	capfrac::FlowOptions flowOptions() const;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(SinglePhaseFlowEngine,PoreNetworkEngine,
	R"""(One viscous, compressible or incompressible fluid between grains that move (Eqs. 8 to 14
of
[Jain2008]_).

Every step the network follows the grains (:yref:`PoreNetworkEngine`), and fluid flows through every throat with the
conductance of Eq. 9; the pressure of a pore answers to what flows in and to its change of volume, Eq. 11; grains and
walls feel $\sum p\,\partial V/\partial x$. Fluid never leaves but through the boundaries: its mass is kept to
round-off through contacts that open and close and through remeshing. Walls are tight unless
:yref:`wallPressures<SinglePhaseFlowEngine.wallPressures>` or :yref:`wallFluxes<SinglePhaseFlowEngine.wallFluxes>` say
otherwise. Place it after :yref:`InteractionLoop` and before :yref:`NewtonIntegrator`, and before a
:yref:`WallServoEngine`. Attributes may change at any time, and boundary values with them.)""",
		CAPFRAC_WATER_FLOW_ATTRIBUTES
		((std::string,timeIntegration,"undrainedStable",Attr::triggerPostLoad,
			"Scheme in time: ``'undrainedStable'`` (implicit, foresees how the grains give way: stable at "
			"the time step of the dry grains for any $K_f$), ``'implicit'`` (backward Euler), "
			"``'explicit'`` (the paper's; its limit, Eqs. 12-14, is enforced) [-]."))
		((Real,fluidDensity,0,Attr::triggerPostLoad,
			"Density of the fluid [kg/m³], >= 0; with :yref:`gravity<SinglePhaseFlowEngine.gravity>` the "
			"fluid has weight: hydrostatic pressure, and buoyancy of the grains."))
		((Vector2r,gravity,Vector2r::Zero(),Attr::triggerPostLoad,"Gravity on the fluid [m/s²]."))
		((capfrac::Saved<capfrac::SinglePhase>,flow,,(Attr::hidden|Attr::readonly),"State of the fluid."))
		,
		guardAttributes();
		,
		.add_property("massDefect",+[](SinglePhaseFlowEngine& e) { return e.flow->record.massDefect; },
			"Sum of in - out - stored over all steps [m³]; round-off.")
		.add_property("wallInflow",
			+[](SinglePhaseFlowEngine& e) { return e.wallInflow(); },
			"Flow into the sample through the left, right, bottom and top wall in the last step [m³/s] "
			"|yupdate|.")
		.add_property("solverIterations",
			+[](SinglePhaseFlowEngine& e) { return e.flow->record.solverIterations; },
			"Iterations of the linear solver in the last step [-].")
		.add_property("nFactorizations",
			+[](SinglePhaseFlowEngine& e) { return e.flow->record.nFactorizations; },
			"Factorizations of the linear solver so far [-].")
		.def("pores",&SinglePhaseFlowEngine::pyPores,
			"The pores as a dict of lists: ``x``, ``y`` (centroid of the void [m]), ``pressure`` [Pa], "
			"``volume`` [m³], ``water`` (mass as volume at pressure zero [m³]), ``cells`` (number).")
		.def("inflow",&SinglePhaseFlowEngine::pyInflow,
			"Flow into the sample in the last step through each wall, by name [m³/s].")
		.def("explicitTimeStepLimit",&SinglePhaseFlowEngine::pyTimeStepLimit,
			"The longest step of the explicit scheme now [s], Eqs. 12-14.")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(SinglePhaseFlowEngine);

} // namespace yade
