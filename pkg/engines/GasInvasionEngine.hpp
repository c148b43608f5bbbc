#pragma once

#include "SinglePhaseFlowEngine.hpp"

#include "../flow/Displacement.hpp"
#include "../fluids/EntryPressure.hpp"
#include "../fluids/Imbibition.hpp"
#include "../invasion/Drainage.hpp"

namespace yade {

/// Gas in the pores, on top of the network that follows the grains. Its water is drained, and what SinglePhaseFlowEngine brings lies idle;
/// or it is solved for, by that engine's network of throats and its view of the grains (GasInvasionDisplacement.cpp).
class GasInvasionEngine : public SinglePhaseFlowEngine {
public:
	virtual ~GasInvasionEngine() = default;
	void                preSave(GasInvasionEngine&);
	void                postLoad(GasInvasionEngine&);
	std::vector<double> cellPressures() const override;

	boost::python::dict  pyEvents();
	boost::python::dict  pyLevels();
	boost::python::tuple pyInletStretch(int nPores, Real centre);
	boost::python::list  pyBonds();
	Real                 pyNextEntryPressure();
	void                 pySetCellPressures(const std::vector<Real>& pressures) override;

protected:
	void advanceFluids() override;
	void startFluids() override;
	void finishStep() override;
	void checkAttributes() const override;
	void guardAttributes();
	bool drained() const override { return waterFlow == "drained"; }
	void beforeReport() override;
	void followRemesh(const capfrac::Triangulation& before) override;
	Real prescribedPressure(int wall) const override;
	capfrac::FluidForces forcesOfFluids() const override;
	Real reportedEntryPressure(int edge) const override;

private:
	Real                     capillaryPressure() const { return gasPressure - waterPressure; }
	/// Pressure of the gas in a cell that holds gas [Pa].
	Real                     pressureOfGas(int /*cell*/) const { return gasPressure; }
	Real                     throatEntryPressure(int edge) const;
	bool                     gasCanAdvance() const;
	capfrac::DrainageNetwork drainageNetwork() const;
	void                     avalanche();
	void                     record(int edge, int domain, Real entryPressure);
	void                     fillWithGas(int domain);
	bool                     touches(int domain, int wall) const;
	bool                     mayInvade() const;
	std::vector<int>         inletDomains() const;
	void                     checkInlet() const;
	void                     noteBreakthrough();
	void                     checkInvariantsNow(const capfrac::DrainageNetwork& network, const capfrac::Drainage& drainage) const;
	Real                     gapGrowth(int edge) const;
	bool                     bondBroken(Body::id_t a, Body::id_t b) const;
	int                      countBroken() const;
	void                     findRattlers();
	Real                     unbalanced() const;
	bool                     wallsAtRest() const;
	Real                     saturation() const;
	Real                     largestDisplacement(bool rattlersToo) const;
	void                     closeLevel(bool balanced);

	// With waterFlow = 'solved'.
	void                     checkDisplacement() const;
	void                     startDisplacement();
	void                     joinPhases();
	capfrac::TwoFluidNetwork twoFluidNetwork();
	void                     addReservoir(capfrac::TwoFluidNetwork& network) const;
	std::vector<Real>        bodyPressures() const;
	void                     displaceWater();
	void                     writeBack(const capfrac::TwoFluidNetwork& network, const capfrac::DisplacementStep& done);
	void                     recordEntries(const capfrac::TwoFluidNetwork& network, const capfrac::DisplacementStep& done);
	capfrac::TwoFluids       twoFluids() const;

	capfrac::EntryLaw                law = capfrac::EntryLaw::inscribedSphere;
	capfrac::Accepted                accepted;
	std::vector<capfrac::Disk>       startGrains; ///< the grains when the invasion began
	capfrac::Box                     startBox;
	std::vector<int>                 edgeOfThroat; ///< of the last network of two fluids, without those of the reservoir

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GasInvasionEngine,SinglePhaseFlowEngine,R"""(Gas under a slowly rising pressure enters a water-filled, deformable sediment: capillary invasion, fracture, or both.

Every step: the network follows the grains (:yref:`PoreNetworkEngine`); gas that hangs on the inlet advances through every throat whose entry pressure, Eq. 15 of
[Jain2008]_ (corrected) with the gap as it is now, does not exceed $P_c = p_g - p_w$, the lowest first, until none is left (or one pore at a time: :yref:`invasionInterval<GasInvasionEngine.invasionInterval>`); gas pores then load the grains with $p_g$, water
pores with $p_w$. The pressure rises by :yref:`pressureIncrement<GasInvasionEngine.pressureIncrement>` whenever the grains are at rest. Water is drained
(its pressure is constant), the gas weightless and inviscid; no imbibition. Whether grains are pushed apart is decided by the contacts alone.)""",
		((Real,interfacialTension,0.05,Attr::triggerPostLoad,"Interfacial tension $\\gamma$ of gas and water [N/m], > 0."))
		((Real,contactAngle,0,Attr::triggerPostLoad,"Contact angle $\\theta$ through the water [rad], in [0, pi/2)."))
		((std::string,entryLaw,"inscribedSphere",Attr::triggerPostLoad,"Law of the entry pressure: ``'inscribedSphere'`` (Eq. 15) or ``'mayerStowePrincen'`` (MS-P, $\\theta$ = 0 only) [-]."))
		((Real,gasPressure,0,Attr::triggerPostLoad,"Gas pressure $p_g$ now [Pa], >= waterPressure; rises by itself while the ramp runs."))
		((Real,pressureIncrement,0,Attr::triggerPostLoad,"Step of the pressure ramp [Pa], >= 0; 0 holds the pressure."))
		((Real,maxPressure,0,Attr::triggerPostLoad,"Gas pressure at which the ramp ends [Pa]. Moved up, a ramp that had ended goes on: the way to stop at chosen pressures."))
		((Real,unbalancedTolerance,1e-3,Attr::triggerPostLoad,"Mean resultant force on the grains over the mean contact force below which the grains count as at rest [-], > 0."))
		((int,minLevelSteps,100,Attr::triggerPostLoad,"Steps that a pressure level lasts at least [-], >= 1."))
		((int,maxLevelSteps,20000,Attr::triggerPostLoad,"Steps after which the pressure rises though the grains still move [-]; such levels are marked in :yref:`levels<GasInvasionEngine.levels>`."))
		((std::string,inletWall,"bottom",Attr::triggerPostLoad,"Wall with the gas inlet: ``'left'``, ``'right'``, ``'bottom'``, ``'top'`` [-]."))
		((Real,inletFrom,0,,"Begin of the inlet on its wall, a coordinate [m]. Pores whose stretch of wall has its middle in [inletFrom, inletTo] are the inlet."))
		((Real,inletTo,0,,"End of the inlet on its wall, a coordinate [m]. The width of the inlet controls at which pressure a cohesive sediment opens; it is on record in :yref:`inletPores<GasInvasionEngine.inletPores>`."))
		((std::vector<Vector2r>,inletPoints,,,"Instead of a stretch of wall: points [m]; the pores that hold them are the inlet."))
		((std::string,outletWall,"top",Attr::triggerPostLoad,"Wall through which the water leaves, or ``'any'`` for all four; gas that reaches it has broken through [-]."))
		((bool,trapping,false,,"Whether water that is cut off from the outlet stays (true) or drains by films (false) [-]."))
		((std::string,waterFlow,"drained",Attr::triggerPostLoad,"``'drained'``: the water keeps :yref:`waterPressure<PoreNetworkEngine.waterPressure>` and gives way at once. ``'solved'``: it is viscous and compressible and has to flow to the outlet, which is held at waterPressure (or what :yref:`wallPressures<SinglePhaseFlowEngine.wallPressures>` says), and so is the gas; both load the grains, and the step foresees how these give way (stable at the time step of the dry grains). Attributes of :yref:`SinglePhaseFlowEngine` then apply [-]."))
		((Real,gasViscosity,1.1e-5,Attr::triggerPostLoad,"Viscosity of the gas [Pa·s], > 0, with ``waterFlow = 'solved'``; methane."))
		((Real,maxFilling,0.5,Attr::triggerPostLoad,"Share of a pore that gas may fill in one part of a time step [-], > 0, with ``waterFlow = 'solved'``: a long step is divided."))
		((Real,filmConductance,0,Attr::triggerPostLoad,"Conductance of the films from a pore of water that is cut off to the outlet [m³/(Pa·s)], >= 0, with ``waterFlow = 'solved'``; 0: it is locked."))
		((std::vector<Real>,cellState,,(Attr::hidden|Attr::readonly),"Pressures of the cells at the end of the last step [Pa]."))
		((std::vector<Real>,cellHeld,,(Attr::hidden|Attr::readonly),"Capillary pressures of gas in cells of water [Pa]."))
		((std::vector<int>,edgeAdvancing,,(Attr::hidden|Attr::readonly),"Whether gas has passed the edge and fills the pore behind it."))
		((Real,reservoirGas,0,(Attr::hidden|Attr::readonly),"Gas upstream of the inlet [m³ at pressure zero]."))
		((Real,openingThreshold,0.01,Attr::triggerPostLoad,"A throat counts as opened, not rigid, when its gap has grown by more than this many mean radii since the start, or its bond is broken [-], > 0."))
		((int,invasionInterval,0,Attr::triggerPostLoad,"Steps between one invaded pore and the next [-], >= 0. 0: the grains stand still during an avalanche, as in a rigid sediment. Otherwise the grains answer to each pore before the gas takes the next one, and a throat that opens at a fracture's tip comes before a rigid one with a higher entry pressure."))
		((bool,checkInvariants,false,,"Check after each avalanche that no throat opened below its entry pressure, that all gas hangs on the inlet or is trapped, and that every pore is counted once; throws otherwise."))
		((int,inletPores,0,Attr::readonly,"Number of domains that the inlet fills at the start |yupdate| [-]."))
		((Real,inletWidth,0,Attr::readonly,"Width of the wall that those domains cover [m] |yupdate|; 0 for points."))
		((Real,breakthroughPressure,NaN,Attr::readonly,"Gas pressure when gas first reached the outlet wall [Pa] |yupdate|; NaN before."))
		((int,breakthroughIter,-1,Attr::readonly,"Iteration of the breakthrough [-] |yupdate|; -1 before."))
		((Real,breakthroughDisplacement,NaN,Attr::readonly,"Largest displacement of a loaded grain over its radius at the breakthrough [-] |yupdate|."))
		((int,breakthroughBroken,-1,Attr::readonly,"Bonds broken until the breakthrough [-] |yupdate|; -1 before."))
		((Real,restDisplacement,0.01,Attr::triggerPostLoad,"The sample counts as at rest only while no wall would move farther than this within minLevelSteps, in units of the smallest radius [-], > 0: a sample that comes apart steadily is balanced, but not at rest."))
		((int,level,0,Attr::readonly,"Number of pressure levels that are finished [-] |yupdate|."))
		((int,levelStart,-1,Attr::readonly,"Iteration at which the present level began [-] |yupdate|."))
		((int,lastEventIter,-1,Attr::readonly,"Iteration of the last invasion [-] |yupdate|."))
		((int,nEvents,0,Attr::readonly,"Number of pores invaded so far [-] |yupdate|."))
		((bool,rampDone,false,Attr::readonly,"Whether the last level of the ramp is finished |yupdate|."))
		((Real,gasSaturation,0,Attr::readonly,"Share of the void volume that holds gas [-] |yupdate|, at each new level and each avalanche."))
		((int,nTrappedWater,0,Attr::readonly,"Domains of water that are cut off from the outlet [-] |yupdate| (with trapping)."))
		((int,nDetachedGas,0,Attr::readonly,"Domains of gas that are cut off from the inlet [-] |yupdate|; they keep the gas pressure and do not advance."))
		((std::vector<int>,rattlers,,Attr::readonly,"Grains that bore no load at the start: fewer than two contacts with at least a hundredth of the mean contact force [ids] |yupdate|."))
		((std::vector<int>,savedBonds,,(Attr::hidden|Attr::readonly),"Pairs bonded at the start, for saving."))
		((std::vector<Real>,savedStart,,(Attr::hidden|Attr::readonly),"Grains and box at the start [m], for saving."))
		((std::vector<Vector3i>,eventBodies,,(Attr::hidden|Attr::readonly),"Cells of the events: three bodies each."))
		((std::vector<Vector3i>,eventThroats,,(Attr::hidden|Attr::readonly),"Throats of the events: two bodies and the flags (1 broken bond, 2 opened)."))
		((std::vector<Vector3i>,eventCounts,,(Attr::hidden|Attr::readonly),"Iteration, level, cells of each event."))
		((std::vector<Vector6r>,eventNumbers,,(Attr::hidden|Attr::readonly),"Time, gas pressure, entry pressure, gap, gap growth, void volume of each event."))
		((std::vector<Vector2r>,eventPlaces,,(Attr::hidden|Attr::readonly),"Where the entered pores are [m]."))
		((std::vector<Vector6r>,levelNumbers,,(Attr::hidden|Attr::readonly),"Pressure, saturation, unbalanced force, displacement of loaded grains, of all grains, gas volume at the end of each level."))
		((std::vector<Vector3i>,levelCounts,,(Attr::hidden|Attr::readonly),"Last iteration, broken bonds, whether at rest, of each level."))
		,
		guardAttributes();
		,
		.def("events",&GasInvasionEngine::pyEvents,"The log of all invasions as a dict of lists: ``time`` [s], ``iteration``, ``level``, ``gasPressure`` [Pa], ``throat`` (two body ids), ``pore`` (body ids of its first cell), ``x``, ``y`` [m], ``entryPressure`` [Pa], ``gap`` [m], ``gapGrowth`` [m] since the start, ``bondBroken``, ``opened`` (bool), ``cells``, ``volume`` [m³].")
		.def("levels",&GasInvasionEngine::pyLevels,"The finished pressure levels as a dict of lists: ``pressure`` [Pa], ``gasSaturation`` [-], ``brokenBonds``, ``displacement`` and ``displacementWithRattlers`` (largest so far over the grain's radius [-]), ``unbalanced`` [-], ``atRest`` (bool), ``iteration``, ``gasVolume`` [m³].")
		.def("inletStretch",&GasInvasionEngine::pyInletStretch,(boost::python::arg("nPores"),boost::python::arg("centre")),"The stretch of the inlet wall that nPores neighbouring pores cover, as near to the coordinate `centre` [m] as there are: (from, to) [m]. :raises ValueError: when the wall has fewer pores")
		.def("brokenBonds",&GasInvasionEngine::pyBonds,"Pairs of bodies that were bonded at the start and are not any more.")
		.def("nextEntryPressure",&GasInvasionEngine::pyNextEntryPressure,"The lowest entry pressure that the injected gas meets now [Pa]; infinity where there is none.")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(GasInvasionEngine);

} // namespace yade
