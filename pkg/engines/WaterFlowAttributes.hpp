// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The attributes of water that flows, which SinglePhaseFlowEngine and ViscousInvasionEngine have both.

#include "../model/PoreFlow.hpp"

// clang-format off
#define CAPFRAC_WATER_FLOW_ATTRIBUTES \
		((Real,bulkModulus,2.2e9,Attr::triggerPostLoad, \
			"Bulk modulus of the fluid $K_f$ [Pa], > 0; infinity for an incompressible fluid. That of " \
			"water is 2.2e9 Pa.")) \
		((Real,viscosity,1e-3,Attr::triggerPostLoad,"Viscosity $\\mu$ [Pa·s], > 0.")) \
		((std::string,conductanceLaw,"fourSpheres",Attr::triggerPostLoad, \
			"Law of the conductance of a throat, by its name [-]; " \
			"``capfrac._kernels.laws()['conductanceLaw']`` lists them.")) \
		((Real,conductanceFactor,1,Attr::triggerPostLoad, \
			"Factor of all conductances [-], > 0. 0.32 reproduces the permeability of [Jain2008]_, a fit " \
			"of one number.")) \
		((Real,residualAperture,0,Attr::triggerPostLoad, \
			"Law ``'parallelPlates'``: aperture of a contact that bears no force [m], >= 0.")) \
		((Real,halvingForce,1,Attr::triggerPostLoad, \
			"Law ``'parallelPlates'``: contact force that halves the aperture [N], > 0.")) \
		((std::vector<Real>,wallPressures,std::vector<Real>(4,NaN),Attr::triggerPostLoad, \
			"Pressure prescribed in the pores along the left, right, bottom and top wall [Pa]; NaN: "\
			"none.")) \
		((std::vector<Real>,wallFluxes,std::vector<Real>(4,0),Attr::triggerPostLoad, \
			"Inflow prescribed through the left, right, bottom and top wall [m³/s], shared by the length " \
			"of wall of each pore; not where a pressure is prescribed.")) \
		((std::vector<Vector3r>,pointPressures,,Attr::triggerPostLoad, \
			"Pressures prescribed in the pores that hold points: (x [m], y [m], pressure [Pa]).")) \
		((std::vector<Vector3r>,pointFluxes,,Attr::triggerPostLoad, \
			"Inflow into the pores that hold points: (x [m], y [m], inflow [m³/s]).")) \
		((Real,grainBulkModulus,std::numeric_limits<Real>::infinity(),Attr::triggerPostLoad, \
			"Bulk modulus of the grains $K_s$ [Pa], > 0; infinity for rigid grains. The pressure round a " \
			"grain changes its radius, $r=r_0\\,(1-p/(3K_s))$ (Eq. 10), $r_0$ being its radius at the " \
			"initial :yref:`waterPressure<PoreNetworkEngine.waterPressure>` and p counted from that.")) \
		((Real,closedPore,1e-3,Attr::triggerPostLoad, \
			"A pore smaller than this share of the smallest grain's area is joined to its neighbour " \
			"across the widest throat: a pore that grains close pushes its fluid there [-], > 0.")) \
// clang-format on

namespace yade {

/// The options of the flow, from an engine with these attributes. Throws std::invalid_argument for a name that is none.
template <class Engine> capfrac::FlowOptions flowOptionsOf(const Engine& engine)
{
	capfrac::FlowOptions options;
	options.bulkModulus = engine.bulkModulus, options.viscosity = engine.viscosity;
	options.law = capfrac::conductanceLawFromName(engine.conductanceLaw);
	options.conductanceFactor = engine.conductanceFactor;
	options.residualAperture = engine.residualAperture, options.halvingForce = engine.halvingForce;
	options.wallPressures = engine.wallPressures, options.wallFluxes = engine.wallFluxes;
	for (const auto& p : engine.pointPressures)
		options.pointPressures.push_back({ { p[0], p[1] }, p[2] });
	for (const auto& p : engine.pointFluxes)
		options.pointFluxes.push_back({ { p[0], p[1] }, p[2] });
	options.density = engine.fluidDensity;
	options.gravity = { engine.gravity[0], engine.gravity[1] };
	options.grainBulkModulus = engine.grainBulkModulus, options.closedPore = engine.closedPore;
	return options;
}

template <class Engine> auto flowAttributesOf(Engine& engine)
{
	return std::tie(engine.bulkModulus, engine.viscosity, engine.conductanceLaw, engine.conductanceFactor,
	        engine.residualAperture, engine.halvingForce, engine.wallPressures, engine.wallFluxes,
	        engine.pointPressures, engine.pointFluxes, engine.grainBulkModulus, engine.closedPore);
}

} // namespace yade
