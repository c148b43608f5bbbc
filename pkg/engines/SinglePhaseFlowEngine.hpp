// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PoreNetworkEngine.hpp"

#include "../flow/Coupling.hpp"
#include "../laws/Conductance.hpp"

#include <optional>

namespace yade {

/// Water that flows through the pores of moving grains, presses on them, and keeps its mass.
///
/// The mass of the cells (Contents::water, as volume at pressure zero) is the state; a pore's pressure
/// follows from the masses and the voids of its cells. See TimeIntegration.hpp for the three schemes.
class SinglePhaseFlowEngine : public PoreNetworkEngine {
public:
	virtual ~SinglePhaseFlowEngine() = default;
	void preSave(SinglePhaseFlowEngine&);
	void postSave(SinglePhaseFlowEngine&);
	void postLoad(SinglePhaseFlowEngine&);
	std::vector<double> cellPressures() const override;
	Real wallStiffness(int wall) const override;

	boost::python::dict pyPores();
	boost::python::dict pyInflow();
	Real pyTimeStepLimit();
	void pySetCellPressures(const std::vector<Real>& pressures) override;

protected:
	void advanceFluids() override;
	void startFluids() override;
	void beforeReport() override { describePores(); }
	void followRemesh(const capfrac::Triangulation& before) override;
	void checkAttributes() const override;
	bool drained() const override { return false; }
	/// Of the very matrix that the step foresaw the volumes with: what the grains gain in work the fluid loses, to
	/// round-off.
	capfrac::FluidForces forcesOfFluids() const override;

	/// Lets values of the cells follow a remeshing: a new cell has that of a neighbour that is not new, or
	/// `fallback`.
	void carryOverCells(std::vector<Real>& values, const capfrac::Triangulation& before, Real fallback) const;
	/// Refuses gravity that would be ignored, as no fluid has a density.
	void checkWeight() const;
	virtual bool weightless() const { return fluidDensity == 0; }
	/// Pressure held in the pores along a wall [Pa]; NaN: none.
	virtual Real prescribedPressure(int wall) const { return wallPressures[wall]; }

	void guardAttributes();
	/// Pores, their volumes and centroids, how they answer to the grains, and the fluid's weight, as they are now.
	void describePores();
	void groupPores(const std::vector<capfrac::VoidMoments>& moments);
	void findPoresAlongWalls();
	capfrac::FlowNetwork flowNetwork() const;
	void addThroats(capfrac::FlowNetwork& network) const;
	/// The throat at an edge between two pores; nothing where there is none.
	std::optional<capfrac::FlowThroat> throatAt(int edge) const;
	void addBoundaries(capfrac::FlowNetwork& network) const;
	void fixPressure(capfrac::FlowNetwork& network, int pore, double pressure, const std::string& owner) const;
	capfrac::Skeleton skeleton() const;
	void addWalls(capfrac::Skeleton& skeleton) const;
	/// Forces of the fluid's weight per thickness [N/m], to be added to those of the pores' pressures; no grains:
	/// it has none.
	virtual capfrac::FluidForces weightOfFluid() const;
	std::string placeOf(int pore) const;
	/// Runs `work` on the pores; what it finds wrong is thrown again with the time and the pore's place.
	template <class Work> auto namingPores(Work work) const
	{
		const auto where = [this] {
			return getClassName() + " " + whenInLoop(*scene);
		}; // put together only when something is wrong
		try {
			return work();
		} catch (const capfrac::FlowError& e) {
			throw std::runtime_error(where() + e.what() + placeOf(e.pore));
		} catch (const std::exception& e) {
			throw std::runtime_error(where() + e.what());
		}
	}
	void checkMotion(const Body& body) const;
	capfrac::GrainCompression compression() const;
	void compressGrains(const std::vector<double>& growth);
	capfrac::FlowStep step(capfrac::FlowNetwork& network);
	void bookInflow(const capfrac::FlowStep& done);

	capfrac::ConductanceLaw conductance = capfrac::ConductanceLaw::fourSpheres;
	capfrac::PressureSolver solver;
	int nPores = 0;
	std::vector<int> poreOfCell;
	std::vector<capfrac::Vec2> poreCentre;
	std::vector<double> poreVolume;
	std::vector<double> voids;                                ///< of the cells [m^2]
	std::array<std::vector<int>, capfrac::nWalls> poresAlong; ///< those at a prescribed pressure along each wall
	capfrac::VolumeGradients gradients;                       ///< of the cells
	capfrac::FluidForces weightForce;                         ///< weightOfFluid(); no grains: it has none

private:
	enum class Scheme { undrainedStable, implicit, explicitEuler };

	Scheme scheme = Scheme::undrainedStable;
	capfrac::Accepted accepted;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(SinglePhaseFlowEngine,PoreNetworkEngine,
	R"""(One viscous, compressible or incompressible fluid between grains that move (Eqs. 8 to 14 of
[Jain2008]_).

Every step the network follows the grains (:yref:`PoreNetworkEngine`), and fluid flows through every throat with the
conductance of Eq. 9; the pressure of a pore answers to what flows in and to its change of volume, Eq. 11; grains and
walls feel $\sum p\,\partial V/\partial x$. Fluid never leaves but through the boundaries: its mass is kept to
round-off through contacts that open and close and through remeshing. Walls are tight unless
:yref:`wallPressures<SinglePhaseFlowEngine.wallPressures>` or :yref:`wallFluxes<SinglePhaseFlowEngine.wallFluxes>` say
otherwise. Place it after :yref:`InteractionLoop` and before :yref:`NewtonIntegrator`, and before a
:yref:`WallServoEngine`. Attributes may change at any time, and boundary values with them.)""",
		((Real,bulkModulus,2.2e9,Attr::triggerPostLoad,
			"Bulk modulus of the fluid $K_f$ [Pa], > 0; infinity for an incompressible fluid. That of "
			"water is 2.2e9 Pa."))
		((Real,viscosity,1e-3,Attr::triggerPostLoad,"Viscosity $\\mu$ [Pa·s], > 0."))
		((std::string,conductanceLaw,"fourSpheres",Attr::triggerPostLoad,
			"Conductance of a throat: ``'fourSpheres'`` (Eq. 9 with the shape factor of the duct between "
			"four spheres), ``'constantShape'``, ``'inscribedCircle'``, ``'parallelPlates'``, "
			"``'lubrication'`` [-]."))
		((Real,conductanceFactor,1,Attr::triggerPostLoad,
			"Factor of all conductances [-], > 0. 0.32 reproduces the permeability of [Jain2008]_, a fit "
			"of one number."))
		((Real,residualAperture,0,Attr::triggerPostLoad,
			"Law ``'parallelPlates'``: aperture of a contact that bears no force [m], >= 0."))
		((Real,halvingForce,1,Attr::triggerPostLoad,
			"Law ``'parallelPlates'``: contact force that halves the aperture [N], > 0."))
		((std::string,timeIntegration,"undrainedStable",Attr::triggerPostLoad,
			"Scheme in time: ``'undrainedStable'`` (implicit, foresees how the grains give way: stable at "
			"the time step of the dry grains for any $K_f$), ``'implicit'`` (backward Euler), "
			"``'explicit'`` (the paper's; its limit, Eqs. 12-14, is enforced) [-]."))
		((std::vector<Real>,wallPressures,std::vector<Real>(4,NaN),Attr::triggerPostLoad,
			"Pressure prescribed in the pores along the left, right, bottom and top wall [Pa]; NaN: none."))
		((std::vector<Real>,wallFluxes,std::vector<Real>(4,0),Attr::triggerPostLoad,
			"Inflow prescribed through the left, right, bottom and top wall [m³/s], shared by the length "
			"of wall of each pore; not where a pressure is prescribed."))
		((std::vector<Vector3r>,pointPressures,,Attr::triggerPostLoad,
			"Pressures prescribed in the pores that hold points: (x [m], y [m], pressure [Pa])."))
		((std::vector<Vector3r>,pointFluxes,,Attr::triggerPostLoad,
			"Inflow into the pores that hold points: (x [m], y [m], inflow [m³/s])."))
		((Real,fluidDensity,0,Attr::triggerPostLoad,
			"Density of the fluid [kg/m³], >= 0; with :yref:`gravity<SinglePhaseFlowEngine.gravity>` the "
			"fluid has weight: hydrostatic pressure, and buoyancy of the grains."))
		((Vector2r,gravity,Vector2r::Zero(),Attr::triggerPostLoad,"Gravity on the fluid [m/s²]."))
		((Real,grainBulkModulus,std::numeric_limits<Real>::infinity(),Attr::triggerPostLoad,
			"Bulk modulus of the grains $K_s$ [Pa], > 0; infinity for rigid grains. The pressure round a "
			"grain changes its radius, $r=r_0\\,(1-p/(3K_s))$ (Eq. 10), $r_0$ being its radius at the "
			"initial :yref:`waterPressure<PoreNetworkEngine.waterPressure>` and p counted from that."))
		((Real,closedPore,1e-3,Attr::triggerPostLoad,
			"A pore smaller than this share of the smallest grain's area is joined to its neighbour across "
			"the widest throat: a pore that grains close pushes its fluid there [-], > 0."))
		((std::vector<Real>,referenceRadii,,(Attr::hidden|Attr::readonly),"Radii at the start [m]."))
		((Real,referencePressure,0,(Attr::hidden|Attr::readonly),"Pressure at the start [Pa]."))
		((std::vector<Real>,cellPressure,,(Attr::hidden|Attr::readonly),
			"Pressures of the cells after the last step [Pa]; an incompressible fluid has no others."))
		((std::vector<int>,savedSolverStart,,(Attr::hidden|Attr::readonly),
			"Matrix that the linear solver has a factor of: PressureSolverMemory::start."))
		((std::vector<int>,savedSolverRow,,(Attr::hidden|Attr::readonly),"PressureSolverMemory::row."))
		((std::vector<Real>,savedSolverValue,,(Attr::hidden|Attr::readonly),"PressureSolverMemory::value."))
		((Real,massDefect,0,Attr::readonly,
			"Sum of in - out - stored over all steps [m³] |yupdate|; round-off."))
		((std::vector<Real>,wallInflow,std::vector<Real>(4,0),Attr::readonly,
			"Flow into the sample through the left, right, bottom and top wall in the last step [m³/s] "
			"|yupdate|."))
		((int,solverIterations,0,Attr::readonly,
			"Iterations of the linear solver in the last step [-] |yupdate|."))
		((int,nFactorizations,0,Attr::readonly,"Factorizations of the linear solver so far [-] |yupdate|."))
		,
		guardAttributes();
		,
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
