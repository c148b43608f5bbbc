// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Attributes.hpp"
#include "DemGrains.hpp"
#include "Serialize.hpp"

#include <core/GlobalEngine.hpp>

#include <typeinfo>

namespace yade {

/// What every fluid engine does: gather the grains, let the network and the model of the fluids follow, scatter the
/// forces. The engine has the attributes and nothing of the physics; the state is the network's and the model's.
class PoreNetworkEngine : public GlobalEngine {
public:
	virtual ~PoreNetworkEngine() = default;
	void action() override;
	void postLoad(PoreNetworkEngine&) { followAs<PoreNetworkEngine>(); }

	/// Builds the network of the scene as it is now, once. Throws without having changed anything.
	void prepare();
	/// Brings the network up to the grains' present positions.
	void update();
	/// Stiffness that the fluid adds to a wall [N/m]; a servo has to know it.
	virtual Real wallStiffness(int) const { return 0; }
	/// The network as the last step left it, for engines that look at the fluids without moving them.
	const capfrac::PoreNetwork& pores() const { return *network; }
	const SceneReader& bodies() const { return *reader; }

	boost::python::dict pyCells();
	boost::python::dict pyThroats();
	boost::python::dict pyForces();
	boost::python::dict pyVolumes();
	void pyPrepare();
	virtual void pySetCellPressures(const std::vector<Real>& pressures);

protected:
	/// What the fluids do.
	virtual capfrac::FluidModel& model() { return *fixed; }
	/// Tells the model the attributes. Throws std::invalid_argument naming one that is out of its range.
	virtual void tell();
	/// Checks the attributes, at assignment and before the first step, without changing anything.
	virtual void checkAttributes() const { capfrac::checkOptions(networkOptions()); }
	/// Puts attributes that were refused back to where they were; see capfrac::Accepted.
	virtual void guardAttributes();
	/// What the model makes of attributes that it may change.
	virtual void show() {}
	/// Called when network and model have been built for the first time.
	virtual void started() {}
	/// Called last in the step, when the forces of the fluids are on the grains.
	virtual void finishStep() {}
	virtual DemGrains grains() { return { *scene, *this, *reader }; }

	/// Called when attributes may have changed, at assignment and after loading. YADE calls postLoad() for the
	/// class and for all its bases, while loading before the class has its attributes: only its own call counts.
	template <class Class> void followAs()
	{
		if (typeid(*this) == typeid(Class)) follow();
	}
	void follow();
	capfrac::NetworkOptions networkOptions() const;
	capfrac::Moment now() const { return { scene->time, scene->dt, scene->iter }; }
	bool prepared() const { return network->built(); }
	auto networkAttributes()
	{
		return std::tie(poreMode, mergeTolerance, mergeHysteresis, remeshDisplacement, localFlips, maxSizeRatio,
		        thickness, waterPressure);
	}
	/// Runs `work`; what it finds wrong is thrown again with the engine, the time and the body's id.
	template <class Work> auto naming(const SceneReader& from, Work work) const
	{
		const auto where = [this] { return getClassName() + " " + whenInLoop(*scene); };
		try {
			return work();
		} catch (const capfrac::GeometryError& e) {
			// The kernels number grains by vertex; people know them by body id.
			const std::string who =
			        e.grain < 0 ? "" : "body #" + std::to_string(from.grainIds[e.grain]) + ": ";
			throw std::runtime_error(where() + who + e.finding);
		} catch (const capfrac::FlowError& e) {
			throw std::runtime_error(where() + e.what());
		} catch (const std::domain_error& e) { // the range of a law
			throw std::runtime_error(where() + e.what());
		} catch (const std::invalid_argument&) { // names an attribute
			throw;
		} catch (const std::logic_error& e) {
			throw std::logic_error(where() + e.what());
		} catch (const std::runtime_error& e) {
			throw std::runtime_error(where() + e.what());
		}
	}
	/// Refuses pressures that are not one finite number for each cell [Pa].
	void checkCellPressures(const std::vector<Real>& pressures) const;
	/// A network of the present scene, aside from the engine's own.
	capfrac::PoreNetwork freshNetwork(SceneReader& fresh) const;
	capfrac::Accepted accepted;

private:
	void build();
	void checkSizes(const SceneReader& from) const;

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
		((capfrac::Saved<SceneReader>,reader,,(Attr::hidden|Attr::readonly),
			"The grains and walls that are followed."))
		((capfrac::Saved<capfrac::PoreNetwork>,network,,(Attr::hidden|Attr::readonly),"State of the network."))
		((capfrac::Saved<capfrac::FixedPressures>,fixed,,(Attr::hidden|Attr::readonly),
			"State of fluids at rest."))
		,
		guardAttributes();
		,
		.add_property("nCells",+[](PoreNetworkEngine& e) { return e.network->mesh.cells.size(); },
			"Number of cells [-].")
		.add_property("nDomains",+[](PoreNetworkEngine& e) { return e.network->domains.count; },
			"Number of domains [-].")
		.add_property("nRemeshes",+[](PoreNetworkEngine& e) { return e.network->counts.remeshes; },
			"How often the triangulation had to change [-].")
		.add_property("nFlips",+[](PoreNetworkEngine& e) { return e.network->counts.flips; },
			"Edges flipped so far [-].")
		.add_property("nRebuilds",+[](PoreNetworkEngine& e) { return e.network->counts.rebuilds; },
			"How often the triangulation was made anew since the first time [-].")
		.add_property("gasIn",+[](PoreNetworkEngine& e) { return e.network->books.gasIn; },
			"Gas that entered the sample through the inlet, less what left, since the start [m³] "
			"|yupdate|.")
		.add_property("waterIn",+[](PoreNetworkEngine& e) { return e.network->books.waterIn; },
			"Water that entered the sample, less what left, since the start (negative in drainage) [m³] "
			"|yupdate|.")
		.add_property("initialVoid",+[](PoreNetworkEngine& e) { return e.network->books.initialVoid; },
			"Void volume at the start, all water [m³].")
		.add_property("initialWater",+[](PoreNetworkEngine& e) { return e.network->books.initialWater; },
			"Water at the start [m³]; counted at pressure zero where it is compressible.")
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
