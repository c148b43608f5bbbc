// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "GasLaws.hpp"
#include "GasSupplies.hpp"
#include "GrainCensus.hpp"
#include "PoreNetworkEngine.hpp"

namespace yade {

/// What the engines of gas share: attributes of the gas, its supply, inlet and levels, and what only the grains know of
/// an invasion. The models are capfrac::DrainedInvasion and capfrac::ViscousInvasion.
class GasEngine : public PoreNetworkEngine {
public:
	virtual ~GasEngine() = default;
	void postLoad(GasEngine&) { followAs<GasEngine>(); }

	boost::python::dict pyEvents();
	boost::python::dict pyImbibitionEvents();
	boost::python::dict pyLevels();
	boost::python::dict pyGasLedger();
	boost::python::dict pyHistory();
	Real pyRisePerPeriod();
	boost::python::tuple pyInletStretch(int nPores, Real centre);
	boost::python::list pyBonds();
	boost::python::list pyRattlersNow();
	boost::python::dict pyDisplacements(bool atBreakthrough);
	Real pyNextEntryPressure();
	void pySetCellPressures(const std::vector<Real>& pressures) override;
	/// The levels, as what the supply prescribes now makes them: nothing calls when its attributes change.
	const capfrac::Levels& levelsNow();

	/// The model, as both engines of gas see it; refuses for this class, which has none.
	virtual capfrac::GasModel& invasion();

protected:
	capfrac::FluidModel& model() override { return invasion(); }
	void tell() override;
	void show() override;
	void checkAttributes() const override;
	void started() override;
	void finishStep() override;
	DemGrains grains() override { return { *scene, *this, *reader, &*census }; }
	capfrac::GasOptions gasOptions() const;
	/// Checks what a kind of invasion asks of the gas, beyond what both do.
	virtual void checkGas(const capfrac::GasOptions&) const {}
	virtual int stepsBetweenInvasions() const { return 0; }
	auto gasAttributes()
	{
		return std::tie(interfacialTension, contactAngle, entryLaw, gasPressure, pressureIncrement, maxPressure,
		        gasLaw, supply, pressureDatum, historyInterval, unbalancedTolerance, minLevelSteps,
		        maxLevelSteps, restDisplacement, inletWall, outletWall, filmConductance, gasDensity,
		        fluidDensity, gravity, openingThreshold);
	}

private:
	capfrac::SupplyOptions supplyOptions() const;
	capfrac::LevelOptions levelOptions() const;
	void noteBreakthrough();
	void closeLevel(bool balanced);
	void recordHistory();
	Real risePerPeriod();
	void warnOfSupply();

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GasEngine,PoreNetworkEngine,R"""(What :yref:`GasInvasionEngine` and
:yref:`ViscousInvasionEngine` have both: the gas, its
supply, its inlet, and the pressure levels. Use one of these two; this class by itself moves nothing.)""",
		((Real,interfacialTension,0.05,Attr::triggerPostLoad,
			"Interfacial tension $\\gamma$ of gas and water [N/m], > 0."))
		((Real,contactAngle,0,Attr::triggerPostLoad,
			"Contact angle $\\theta$ through the water [rad], in [0, pi/2)."))
		((std::string,entryLaw,"inscribedSphere",Attr::triggerPostLoad,
			"Law of the entry pressure: ``'inscribedSphere'`` (Eq. 15) or ``'mayerStowePrincen'`` (MS-P, "
			"$\\theta$ = 0 only) [-]."))
		((Real,gasPressure,0,Attr::triggerPostLoad,
			"Gas pressure $p_g$ now [Pa], >= waterPressure; rises by itself while the ramp runs, and "
			"follows from the mass of the gas with a rate or a reservoir."))
		((Real,pressureIncrement,0,Attr::triggerPostLoad,
			"Step of the pressure ramp [Pa], >= 0; 0 holds the pressure."))
		((Real,maxPressure,0,Attr::triggerPostLoad,
			"Gas pressure at which the ramp ends [Pa]. Moved up, a ramp that had ended goes on: the way to "
			"stop at chosen pressures."))
		((shared_ptr<GasLaw>,gasLaw,new IncompressibleGas,Attr::triggerPostLoad,
			"Equation of state of the gas: :yref:`IncompressibleGas`, :yref:`IdealGas` or "
			":yref:`TabulatedGas`. Under a prescribed pressure it matters only for gas that is cut off "
			"from the inlet; a rate or a reservoir needs a compressible one."))
		((shared_ptr<GasSupply>,supply,new PressureSupply,Attr::triggerPostLoad,
			"What is prescribed: :yref:`PressureSupply` (the ramp, or a program of pressures), "
			":yref:`RateSupply` or :yref:`ReservoirSupply`. With the last two the pressure follows from "
			"the mass and the volume of the connected gas in the moving grains."))
		((Real,pressureDatum,101325,Attr::triggerPostLoad,
			"Absolute pressure where the pressures of this engine are zero [Pa]: that of the air, or of "
			"the water at the depth of the sediment if "
			":yref:`waterPressure<PoreNetworkEngine.waterPressure>` is 0 there."))
		((int,historyInterval,0,Attr::triggerPostLoad,
			"Steps between two rows of :yref:`history<GasEngine.history>` [-], >= 0; 0: a row per "
			"level. At 8192 rows every second one goes and the interval doubles."))
		((Real,unbalancedTolerance,1e-3,Attr::triggerPostLoad,
			"Mean resultant force on the grains over the mean contact force below which the grains count "
			"as at rest [-], > 0. The resultant is of all forces in the step, weight included, in the "
			"directions in which grains may move."))
		((int,minLevelSteps,100,Attr::triggerPostLoad,"Steps that a pressure level lasts at least [-], >= 1."))
		((int,maxLevelSteps,20000,Attr::triggerPostLoad,
			"Steps after which the pressure rises though the grains still move [-]; such levels are marked "
			"in :yref:`levels<GasEngine.levels>`."))
		((Real,restDisplacement,0.01,Attr::triggerPostLoad,
			"The sample counts as at rest only while no wall would move farther than this within "
			"minLevelSteps, in units of the smallest radius [-], > 0: a sample that comes apart steadily "
			"is balanced, but not at rest."))
		((std::string,inletWall,"bottom",Attr::triggerPostLoad,
			"Wall with the gas inlet: ``'left'``, ``'right'``, ``'bottom'``, ``'top'`` [-]."))
		((Real,inletFrom,0,Attr::triggerPostLoad,
			"Begin of the inlet on its wall, a coordinate [m]; minus infinity: that of the wall. Pores "
			"whose stretch of wall has its middle in [inletFrom, inletTo] are the inlet."))
		((Real,inletTo,0,Attr::triggerPostLoad,
			"End of the inlet on its wall, a coordinate [m]; infinity: that of the wall. The width of the "
			"inlet controls at which pressure a cohesive sediment opens; it is on record in "
			":yref:`inletPores<GasInvasionEngine.inletPores>`."))
		((std::vector<Vector2r>,inletPoints,,Attr::triggerPostLoad,
			"Instead of a stretch of wall: points [m], at least one in the void; the pores that hold them "
			"are the inlet."))
		((std::string,outletWall,"top",Attr::triggerPostLoad,
			"Wall through which the water leaves, or ``'any'`` for all four; gas that reaches it has "
			"broken through [-]."))
		((Real,gasDensity,0,Attr::triggerPostLoad,
			"Density of the gas [kg/m³], >= 0; 0: weightless. With "
			":yref:`fluidDensity<GasEngine.fluidDensity>`, that of the water, and "
			":yref:`gravity<GasEngine.gravity>` both fluids have weight. Drained, they are "
			"columns at rest: gasPressure and waterPressure are those at the middle of the inlet, and the "
			"capillary pressure grows by $(\\rho_w-\\rho_g)g$ with the height above it. Solved, they flow "
			"by $p-\\rho\\,g\\cdot x$, begin at rest, and gasPressure, waterPressure and the pressures "
			"that boundaries prescribe are those at that place. The density of the gas is constant, "
			"whatever gasLaw says."))
		((Real,openingThreshold,0.01,Attr::triggerPostLoad,
			"A throat counts as opened, not rigid, when its gap has grown by more than this many mean "
			"radii since the start, or its bond is broken [-], > 0."))
		((bool,checkInvariants,false,Attr::triggerPostLoad,
			"Check after each avalanche that no throat opened below its entry pressure, that all gas hangs "
			"on the inlet or is trapped, and that every pore is counted once; throws otherwise."))
		((Real,filmConductance,0,Attr::triggerPostLoad,
			"What trapped water loses by films on the grains per pressure difference, $K$ [m³/(Pa·s)], >= "
			"0; 0 locks it. In drained water (with :yref:`trapping<GasInvasionEngine.trapping>`) a cluster "
			"loses $q=K(P_c-P_e)$, $P_e$ its lowest entry pressure, and has the pressure $p_g-P_e$ (>= "
			"waterPressure); in viscous water each of its pores loses K times its excess over "
			"waterPressure."))
		((Real,fluidDensity,0,Attr::triggerPostLoad,
			"Density of the water [kg/m³], >= 0; see :yref:`gasDensity<GasEngine.gasDensity>`."))
		((Vector2r,gravity,Vector2r::Zero(),Attr::triggerPostLoad,"Gravity on the fluids [m/s²]."))
		((capfrac::Saved<GrainCensus>,census,,(Attr::hidden|Attr::readonly),
			"What the grains were at the start."))
		,
		,
		.add_property("programPosition",+[](GasEngine& e) { return e.levelsNow().programPosition; },
			"Turning points of the program that were reached [-].")
		.add_property("reservoirMass",+[](GasEngine& e) { return e.invasion().books.reservoirMass; },
			"Mass of gas in the reservoir [kg].")
		.add_property("initialGasMass",+[](GasEngine& e) { return e.invasion().books.initialMass; },
			"Mass of gas in the reservoir and the pores of the inlet when counting began [kg]; 0 "
			"for the incompressible law.")
		.add_property("injectedGasMass",+[](GasEngine& e) { return e.invasion().books.injectedMass; },
			"That and all that was supplied since, less what went back [kg].")
		.add_property("inletPores",+[](GasEngine& e) { return e.invasion().inletPores; },
			"Number of domains that the inlet fills at the start [-].")
		.add_property("inletWidth",+[](GasEngine& e) { return e.invasion().inletWidth; },
			"Width of the wall that those domains cover [m]; 0 for points.")
		.add_property("breakthroughPressure",+[](GasEngine& e) { return e.invasion().breakthrough.pressure; },
			"Gas pressure when gas first reached the outlet wall [Pa]; NaN before.")
		.add_property("breakthroughIter",+[](GasEngine& e) { return e.invasion().breakthrough.iteration; },
			"Iteration of the breakthrough [-]; -1 before.")
		.add_property("breakthroughDisplacement",
			+[](GasEngine& e) { return e.census->breakthrough.displacement; },
			"Largest displacement of a loaded grain over its radius at the breakthrough [-]. A "
			"grain is loaded that bore load at the start and bears some now.")
		.add_property("breakthroughBroken",+[](GasEngine& e) { return e.census->breakthrough.broken; },
			"Bonds broken until the breakthrough [-]; -1 before.")
		.add_property("level",+[](GasEngine& e) { return e.invasion().levels.closed.size(); },
			"Number of pressure levels that are finished [-].")
		.add_property("levelStart",+[](GasEngine& e) { return e.invasion().levels.start; },
			"Iteration at which the present level began [-].")
		.add_property("lastEventIter",+[](GasEngine& e) { return e.invasion().lastEvent; },
			"Iteration of the last invasion [-].")
		.add_property("nEvents",+[](GasEngine& e) { return e.invasion().events.size(); },
			"Number of pores invaded so far [-].")
		.add_property("rampDone",+[](GasEngine& e) { return e.levelsNow().done; },
			"Whether the last level of the ramp is finished.")
		.add_property("gasSaturation",+[](GasEngine& e) { return e.invasion().gasSaturation; },
			"Share of the void volume that holds gas [-], at each new level and each avalanche.")
		.add_property("rattlers",+[](GasEngine& e) { return e.census->rattlers; },
			"Grains that bore no load at the start: fewer than two contacts with at least a hundredth of "
			"the mean contact force [ids]. See "
			":yref:`rattlersNow<GasEngine.rattlersNow>`.")
		.add_property("nReturns",+[](GasEngine& e) { return e.invasion().returns.size(); },
			"Number of events of imbibition so far: pores refilled, throats snapped off and opened again "
			"[-].")
		.def("events",&GasEngine::pyEvents,
			"The log of all invasions as a dict of lists: ``time`` [s], ``iteration``, ``level``, "
			"``gasPressure`` [Pa], ``throat`` (two body ids), ``pore`` (body ids of its first cell), "
			"``x``, ``y`` [m], ``entryPressure`` [Pa], ``gap`` [m], ``gapGrowth`` [m] since the start, "
			"``bondBroken``, ``opened`` (bool), ``cells``, ``volume`` [m³].")
		.def("imbibitionEvents",&GasEngine::pyImbibitionEvents,
			"The log of imbibition as a dict of lists: ``kind`` ('refill': a pore; 'snapOff', 'reopening': "
			"a throat), ``time`` [s], ``iteration``, ``level``, ``gasPressure`` [Pa], ``threshold`` [Pa] "
			"(refill, snap-off or entry pressure), ``throat`` (two body ids; -1 for a refill), ``pore`` "
			"(body ids of its first cell; -1 for a throat), ``x``, ``y`` [m], ``cells``, ``volume`` [m³] "
			"of the gas that left.")
		.def("levels",&GasEngine::pyLevels,
			"The finished pressure levels as a dict of lists: ``pressure`` [Pa], ``gasSaturation`` [-], "
			"``brokenBonds``, ``displacement`` (the largest since the start, over the grain's radius, of "
			"the grains that bore load at the start and do now) and ``displacementWithRattlers`` (of all "
			"grains) [-], ``unbalanced`` [-], ``atRest`` (bool), ``iteration``, ``gasVolume`` [m³].")
		.def("gasLedger",&GasEngine::pyGasLedger,
			"The ledger of the gas by mass as a dict [kg]: ``injected`` (``initial``, in the reservoir and "
			"the pores of the inlet at the start, and ``supplied`` since), ``sample``, ``cutOff`` (that "
			"part of it that does not hang on the inlet), ``reservoir``, and ``error``, the relative "
			"difference between what came in and what is there. The incompressible gas has the density of "
			"the ideal one at the datum.")
		.def("history",&GasEngine::pyHistory,
			"The course of the injection as a dict of lists, a row per level or per "
			":yref:`historyInterval<GasEngine.historyInterval>` steps: ``time`` [s], "
			"``iteration``, ``gasPressure`` [Pa], ``connectedVolume`` (of the gas in the sample that hangs "
			"on the inlet [m³]), ``mass`` (injected [kg]), ``gasSaturation`` [-], ``brokenBonds``, "
			"``level``.")
		.def("risePerPeriod",&GasEngine::pyRisePerPeriod,
			"What the present :yref:`RateSupply.rate` adds to the pressure of the gas, "
			"at its present volume, within a period of a mean grain on a mean contact, 2 pi sqrt(m/k_n) "
			"[Pa]: in proportion to the rate. The grains stay near rest while it is a thousandth of the "
			"capillary pressure or less. Infinity without room for gas; 0 without contacts.")
		.def("inletStretch",&GasEngine::pyInletStretch,(boost::python::arg("nPores"),
			boost::python::arg("centre")),
			"The stretch of the inlet wall that nPores neighbouring pores cover, as near to the coordinate "
			"`centre` [m] as there are: (from, to) [m]. :raises ValueError: when the wall has fewer pores")
		.def("brokenBonds",&GasEngine::pyBonds,
			"Pairs of bodies that were bonded at the start and are not any more.")
		.def("rattlersNow",&GasEngine::pyRattlersNow,
			"Grains that bear no load as the contacts are now, by the measure of "
			":yref:`rattlers<GasEngine.rattlers>` [ids], ascending.")
		.def("displacements",&GasEngine::pyDisplacements,(boost::python::arg("atBreakthrough")=false),
			"How far each grain has moved since the start, now or at the breakthrough (no grains before "
			"it), as a dict of lists: ``ids``, ``displacement`` (over the grain's radius [-]), "
			"``rattlerAtStart``, ``rattler`` (bool: whether it bore no load then).")
		.def("nextEntryPressure",&GasEngine::pyNextEntryPressure,
			"The lowest entry pressure that the injected gas meets now [Pa], at the datum; infinity where "
			"there is none.")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(GasEngine);

} // namespace yade
