// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Attributes.hpp"
#include "SceneReader.hpp"
#include "StepOrder.hpp"

#include "../network/Domains.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

/// What every fluid engine shares: the network that follows the grains, and the forces of its pressures.
///
/// action() = gather -> follow the network -> advanceFluids() of the derived engine -> scatter forces.
class PoreNetworkEngine : public GlobalEngine {
public:
	virtual ~PoreNetworkEngine() = default;
	void action() override;
	void preSave(PoreNetworkEngine&);
	void postSave(PoreNetworkEngine&);
	void postLoad(PoreNetworkEngine&);

	/// Builds the network of the scene as it is now, once. Throws without having changed anything.
	void prepare();
	/// Brings the network up to the grains' present positions.
	void update();
	/// Pressure of each cell [Pa].
	virtual std::vector<double> cellPressures() const;
	/// Stiffness that the fluid adds to a wall [N/m]; a servo has to know it.
	virtual Real wallStiffness(int) const { return 0; }

	/// The network as the last step left it, for engines that look at the fluids without moving them.
	const capfrac::Triangulation& network() const { return mesh; }
	const capfrac::Contents& fluids() const { return contents; }
	const SceneReader& bodies() const { return reader; }

	boost::python::dict pyCells();
	boost::python::dict pyThroats();
	boost::python::dict pyForces();
	boost::python::dict pyVolumes();
	void pyPrepare();
	virtual void pySetCellPressures(const std::vector<Real>& pressures);

protected:
	/// Called once per step between the update of the network and the forces; the base has fixed pressures.
	virtual void advanceFluids() {}
	/// Forces of the fluids per thickness [N/m], under cellPressures().
	virtual capfrac::FluidForces forcesOfFluids() const
	{
		return capfrac::fluidForces(mesh, cellPressures(), reader.grains, reader.box);
	}
	/// Called before a report outside of a step, when the network is up to date: for what only steps compute.
	virtual void beforeReport() {}
	/// Called last in the step, when the forces of the fluids are on the grains.
	virtual void finishStep() {}
	/// Called before the triangulation changes, when the contents have followed the voids.
	virtual void beforeRemesh() {}
	/// Called when the triangulation has changed, with the one before; contents and flags have been carried over.
	virtual void followRemesh(const capfrac::Triangulation&) {}
	/// Called when the network has been built for the first time.
	virtual void startFluids() {}
	/// Entry pressure of an edge for the reports [Pa]; NaN where the engine has none.
	virtual Real reportedEntryPressure(int) const { return NaN; }

	/// Void areas of the cells now [m^2].
	std::vector<double> currentVoids() const { return capfrac::voidAreas(mesh, reader.grains, reader.box); }
	/// Lets the contents of the cells follow their voids and books what entered; where `drained()`, else nothing.
	void syncContents();
	/// Whether the water of a cell follows its void through a reservoir. Engines that solve for its flow keep its
	/// mass.
	virtual bool drained() const { return true; }
	/// Partition of the cells anew, after phases or open edges changed.
	void findDomains();
	/// Whether an integrator moves the grains; without one they stand still, whatever their forces and velocities.
	bool grainsMove() const { return integratorOf(*scene) != nullptr; }
	bool prepared() const { return !mesh.cells.empty(); }
	Real smallestRadius() const;

	SceneReader reader;
	capfrac::Triangulation mesh;
	capfrac::Contents contents;
	capfrac::Domains domains;
	std::vector<std::uint8_t> openEdges;
	std::vector<double> gaps;
	std::vector<double> fixedPressures;

	/// Refuses attributes out of their range; also at assignment.
	virtual void checkAttributes() const;
	/// Takes up the state that a saved scene brought along.
	void restore();
	/// Runs `work` on the grains of `from`; what it finds wrong is thrown again with the time and the body's id.
	template <class Work> auto namingBodies(const SceneReader& from, Work work) const
	{
		const std::string where = getClassName() + " " + whenInLoop(*scene);
		try {
			return work();
		} catch (const capfrac::GeometryError& e) {
			// The kernels number grains by vertex; people know them by body id.
			const std::string who =
			        e.grain < 0 ? "" : "body #" + std::to_string(from.grainIds[e.grain]) + ": ";
			throw std::runtime_error(where + who + e.finding);
		} catch (const std::runtime_error& e) {
			throw std::runtime_error(where + e.what());
		}
	}

	/// Finds and checks the grains of the scene and triangulates them, aside from the engine's own network.
	capfrac::Triangulation readScene(SceneReader& fresh) const;

private:
	void build();
	void guardAttributes();
	void remesh();
	void updateGaps();
	void checkSizes(const SceneReader& from) const;
	void checkTimeStep() const;
	bool movedFar() const;

	std::vector<capfrac::Disk> checkedGrains; ///< where the triangulation was last found regular
	capfrac::Box checkedBox;
	capfrac::Accepted accepted;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PoreNetworkEngine,GlobalEngine,R"""(The pores between the grains as a network
that follows them, and the forces of fixed pore pressures on grains and walls.

The void space of a box of four walls (:yref:`Wall`, axes 0 and 1) filled with disks (:yref:`Sphere` bodies confined to
the plane) is partitioned into the cells of the power triangulation; cells of one phase that are joined by an open edge
form a *domain*, the pore of [Jain2008]_. Each step the network is brought up to the grains: contacts open and close,
edges flip, and what the cells hold is kept to round-off. The fluids load grains and walls with $\sum p\,\partial
V/\partial x$.

Place it after :yref:`InteractionLoop` and all engines that add forces, before a :yref:`WallServoEngine` and
:yref:`NewtonIntegrator`; elsewhere, or with a second fluid engine, the first step is refused. By itself it holds every
cell at :yref:`waterPressure<PoreNetworkEngine.waterPressure>` or at pressures set by
:yref:`setCellPressures<PoreNetworkEngine.setCellPressures>`; derived engines move fluids. Pressures are positive in
compression.)""",
		((std::string,poreMode,"domain",Attr::triggerPostLoad,
			"What a pore is: ``'domain'`` (cells joined across open edges) or ``'triangle'`` (every cell "
			"by itself) [-]."))
		((Real,mergeTolerance,1e-3,Attr::triggerPostLoad,
			"Gap beyond which a contact is open and joins the cells on its sides, in units of the smallest "
			"radius [-], >= 0."))
		((Real,mergeHysteresis,0.5,Attr::triggerPostLoad,
			"An open contact closes again below this fraction of "
			":yref:`mergeTolerance<PoreNetworkEngine.mergeTolerance>` [-], in [0, 1]."))
		((Real,remeshDisplacement,1e-3,Attr::triggerPostLoad,
			"The triangulation is checked, and mended where needed, when a grain or wall has moved this "
			"far since the last check, in units of the smallest radius [-], >= 0. Volumes and forces are "
			"exact for any value; only which grains count as neighbours may lag."))
		((bool,localFlips,true,Attr::triggerPostLoad,
			"Mend the triangulation by flips of the edges that are wrong; else, and where flips do not get "
			"there, it is made anew, with the same result [-]."))
		((Real,maxSizeRatio,10,Attr::triggerPostLoad,
			"Largest ratio of grain radii that is accepted [-], >= 1. The domains and entry pressures of "
			"this model are meant for narrow distributions."))
		((Real,thickness,1,Attr::triggerPostLoad,
			"Thickness $w$ of the assembly in the third dimension [m], > 0."))
		((Real,waterPressure,0,Attr::triggerPostLoad,
			"Pressure of the (drained) water [Pa]. Stresses on the walls are total stresses; with 0 they "
			"are effective stresses of the water-filled sample."))
		((int,nCells,0,Attr::readonly,"Number of cells |yupdate| [-]."))
		((int,nDomains,0,Attr::readonly,"Number of domains |yupdate| [-]."))
		((int,nRemeshes,0,Attr::readonly,"How often the triangulation had to change |yupdate| [-]."))
		((int,nFlips,0,Attr::readonly,"Edges flipped so far |yupdate| [-]."))
		((int,nRebuilds,0,Attr::readonly,
			"How often the triangulation was made anew since the first time |yupdate| [-]."))
		((Real,gasIn,0,Attr::readonly,
			"Gas that entered the sample through the inlet, less what left, since the start [m³] "
			"|yupdate|."))
		((Real,waterIn,0,Attr::readonly,
			"Water that entered the sample, less what left, since the start (negative in drainage) [m³] "
			"|yupdate|."))
		((Real,initialVoid,0,Attr::readonly,"Void volume at the start, all water [m³] |yupdate|."))
		((Real,initialWater,0,Attr::readonly,
			"Water at the start [m³] |yupdate|; counted at pressure zero where it is compressible."))
		((std::vector<int>,savedIds,,(Attr::hidden|Attr::readonly),"Grain and wall ids, for saving."))
		((int,savedBodies,0,(Attr::hidden|Attr::readonly),"Number of bodies in the scene, for saving."))
		((std::vector<int>,savedCells,,(Attr::hidden|Attr::readonly),"Vertices of the cells, for saving."))
		((std::vector<int>,savedPhase,,(Attr::hidden|Attr::readonly),"Phases of the cells, for saving."))
		((std::vector<int>,savedSource,,(Attr::hidden|Attr::readonly),"Inlet flags of the cells, for saving."))
		((std::vector<Real>,savedGas,,(Attr::hidden|Attr::readonly),"Gas in the cells [m²], for saving."))
		((std::vector<Real>,savedGasMass,,(Attr::hidden|Attr::readonly),
			"Mass of the gas in the cells [kg/m], for saving."))
		((std::vector<Real>,savedWater,,(Attr::hidden|Attr::readonly),"Water in the cells [m²], for saving."))
		((std::vector<int>,savedHeld,,(Attr::hidden|Attr::readonly),
			"Cells of gas that is cut off, for saving."))
		((std::vector<Real>,savedHeldPressure,,(Attr::hidden|Attr::readonly),
			"Pressures of the gas that is cut off [Pa], for saving."))
		((std::vector<int>,savedOpen,,(Attr::hidden|Attr::readonly),"Flags of the edges, for saving."))
		((std::vector<Real>,savedChecked,,(Attr::hidden|Attr::readonly),
			"Positions at the last check of the triangulation [m], for saving."))
		((std::vector<Real>,savedPressures,,(Attr::hidden|Attr::readonly),
			"Fixed pressures of the cells [Pa], for saving."))
		,
		guardAttributes();
		,
		.def("prepare",&PoreNetworkEngine::pyPrepare,
			"Build the network of the scene as it is, without a step; done by the first step otherwise. "
			"Every problem of the scene is reported here, and the scene is not changed. :raises "
			"RuntimeError: naming the body and what is wrong with it")
		.def("cells",&PoreNetworkEngine::pyCells,
			"The cells as a dict of lists: ``vertices`` (body ids, three each), ``polygon`` (corners [m]), "
			"``phase`` (0 water, 1 gas), ``pressure`` [Pa], ``void`` [m³], ``gas`` [m³], ``water`` [m³], "
			"``domain`` [-], ``inlet``, ``cutOff`` (bool: gas without a way to the inlet, which keeps its "
			"amount; with :yref:`imbibition<GasInvasionEngine.imbibition>`). The sum of the voids is "
			"exact; a single one may be negative where a grain of a torn sample reaches through its cell "
			"into the next.")
		.def("throats",&PoreNetworkEngine::pyThroats,
			"The edges of the network as a dict of lists: ``ids`` (two bodies), ``gap`` [m], ``open`` "
			"(joins the cells on its sides), ``cells`` (left and right, -1 outside), ``entryPressure`` "
			"[Pa] (NaN where the engine has none).")
		.def("fluidForces",&PoreNetworkEngine::pyForces,
			"The forces of the fluids now, as a dict: body id -> (fx, fy) [N].")
		.def("volumes",&PoreNetworkEngine::pyVolumes,
			"The ledger as a dict [m³]: ``void``, ``gas``, ``water``, ``gasIn``, ``waterIn``, "
			"``initialVoid``, ``initialWater``, and ``error``, the relative difference between what is "
			"there and what came in.")
		.def("setCellPressures",&PoreNetworkEngine::pySetCellPressures,(boost::python::arg("pressures")),
			"Hold each cell at a pressure of its own [Pa], in the order of "
			":yref:`cells<PoreNetworkEngine.cells>`; until the next remeshing, which sets them back to "
			":yref:`waterPressure<PoreNetworkEngine.waterPressure>`.")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(PoreNetworkEngine);

} // namespace yade
