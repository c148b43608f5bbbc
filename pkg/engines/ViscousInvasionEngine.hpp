// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "GasEngine.hpp"
#include "WaterFlowAttributes.hpp"

namespace yade {

/// Gas that invades viscous water, both solved for: capfrac::ViscousInvasion.
class ViscousInvasionEngine : public GasEngine {
public:
	virtual ~ViscousInvasionEngine() = default;
	void postLoad(ViscousInvasionEngine&) { followAs<ViscousInvasionEngine>(); }
	capfrac::GasModel& invasion() override { return *viscous; }
	boost::python::dict pyPores();

protected:
	void tell() override;
	void checkAttributes() const override;
	void guardAttributes() override;
	void finishStep() override;

private:
	capfrac::FlowOptions flowOptions() const;
	capfrac::ViscousOptions viscousOptions() const { return { gasViscosity, maxFilling }; }

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ViscousInvasionEngine,GasEngine,R"""(Gas enters a deformable sediment whose
water is viscous and compressible, and
so is the gas: both are solved for, and both load the grains.

Water has to flow to the outlet, which is held at :yref:`waterPressure<PoreNetworkEngine.waterPressure>` (or what
:yref:`wallPressures<ViscousInvasionEngine.wallPressures>` says). From a pore of gas to a neighbour of water a throat is
shut until the difference of their pressures exceeds the entry pressure; then gas flows in and the water gives way. The
step foresees how the grains give way: it is stable at the time step of the dry grains. Gas does not recede. Place it
as :yref:`GasInvasionEngine`, whose water is drained: it is the limit of slow injection.)""",
		CAPFRAC_WATER_FLOW_ATTRIBUTES
		((Real,gasViscosity,1.1e-5,Attr::triggerPostLoad,
			"Viscosity of the gas [Pa·s], > 0; methane."))
		((Real,maxFilling,0.5,Attr::triggerPostLoad,
			"Share of a pore that gas may fill in one part of a time step [-], > 0: a long step is "
			"divided."))
		((capfrac::Saved<capfrac::ViscousInvasion>,viscous,,(Attr::hidden|Attr::readonly),
			"State of both fluids."))
		,
		guardAttributes();
		,
		.add_property("waterExcess",+[](ViscousInvasionEngine& e) { return e.viscous->waterExcess; },
			"How far the water that is not cut off is from rest [Pa], a "
			"mean over its volume. A level lasts until that is at most an increment, or a "
			"hundredth of the capillary pressure where that is more: the ramp waits for the water, too. "
			"Not with wallFluxes or pointFluxes, nor below a pressure that is prescribed elsewhere.")
		.add_property("massDefect",+[](ViscousInvasionEngine& e) { return e.viscous->flowRecord.massDefect; },
			"Sum of in - out - stored over all steps [m³]; round-off.")
		.add_property("solverIterations",
			+[](ViscousInvasionEngine& e) { return e.viscous->flowRecord.solverIterations; },
			"Iterations of the linear solver in the last step [-].")
		.add_property("nFactorizations",
			+[](ViscousInvasionEngine& e) { return e.viscous->flowRecord.nFactorizations; },
			"Factorizations of the linear solver so far [-].")
		.def("pores",&ViscousInvasionEngine::pyPores,
			"The pores as a dict of lists: ``x``, ``y`` (centroid of the void [m]), ``pressure`` [Pa], "
			"``volume`` [m³], ``water`` (mass as volume at pressure zero [m³]), ``cells`` (number).")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(ViscousInvasionEngine);

} // namespace yade
