// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "SinglePhaseFlowEngine.hpp"

#include "../flow/Displacement.hpp"
#include "../laws/EntryPressure.hpp"
#include "../laws/Refill.hpp"
#include "../laws/EquationOfState.hpp"
#include "../invasion/Imbibition.hpp"
#include "../network/GasClusters.hpp"
#include "../network/GrainClusters.hpp"

namespace yade {

/// Gas in the pores, on top of the network that follows the grains. Its water is drained, and what
/// SinglePhaseFlowEngine brings lies idle; or it is solved for, by that engine's network of throats and its view of the
/// grains (GasInvasionDisplacement.cpp).
class GasInvasionEngine : public SinglePhaseFlowEngine {
public:
	virtual ~GasInvasionEngine() = default;
	void preSave(GasInvasionEngine&);
	void postSave(GasInvasionEngine&);
	void postLoad(GasInvasionEngine&);
	std::vector<double> cellPressures() const override;

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

protected:
	void advanceFluids() override;
	void startFluids() override;
	void finishStep() override;
	void beforeRemesh() override { takeWaterOut(); }
	void checkAttributes() const override;
	void guardAttributes();
	bool drained() const override { return waterFlow == "drained"; }
	void beforeReport() override;
	void followRemesh(const capfrac::Triangulation& before) override;
	Real prescribedPressure(int wall) const override;
	capfrac::FluidForces forcesOfFluids() const override;
	capfrac::FluidForces weightOfFluid() const override;
	Real reportedEntryPressure(int edge) const override;

private:
	Real capillaryPressure() const { return gasPressure - waterPressure; }
	/// Pressure of the gas in a cell that holds gas [Pa], at the datum.
	Real pressureOfGas(int cell) const;
	Real throatEntryPressure(int edge) const;
	bool gasCanAdvance() const;
	capfrac::DrainageNetwork drainageNetwork() const;
	void avalanche();
	// GasInvasionImbibition.cpp: water that comes back, gas that is cut off, trapped water that leaves by films
	enum class Return { refill = 0, snapOff = 1, reopening = 2 };
	void checkDisplacement() const;
	void checkOutlet(const std::vector<int>& inlet) const;
	capfrac::ImbibitionNetwork imbibitionNetwork() const;
	bool snappedOff(int edge) const;
	void recede();
	void holdCutOffGas();
	void fillWithWater(int domain);
	void reopen(int edge);
	void recordReturn(Return kind, int edge, int domain, Real threshold);
	void drainByFilms();
	// GasInvasionBuoyancy.cpp: weights of gas and water
	bool heavy() const;
	capfrac::Vec2 datum() const;
	capfrac::FluidHeads headsAt(capfrac::Vec2 place) const;
	Real head(capfrac::Vec2 place) const;
	capfrac::Vec2 throatPlace(int edge) const;
	std::pair<Real, Real> throatShape(int edge) const;
	Real entryPressureAtDatum(int edge) const;
	std::vector<double> pressuresAtDatum() const;
	capfrac::Vec2 weightOf(int cell) const;
	capfrac::Vec2 voidCentre(int cell) const;
	void letWaterRest();
	void record(int edge, int domain);
	void fillWithGas(int domain);
	void countDetachedGas(const capfrac::DrainageNetwork& network);
	bool touches(int domain, int wall) const;
	bool mayInvade() const;
	std::vector<int> inletDomains() const;
	void checkInlet() const;
	std::pair<Real, Real> inletWallEnds() const;
	void reachWallEnds();
	bool weightless() const override { return fluidDensity == 0 && gasDensity == 0; }
	void checkInletPoints() const;
	void noteBreakthrough();
	void checkInvariantsNow(const capfrac::DrainageNetwork& network, const capfrac::Drainage& drainage) const;
	Real saturation() const;
	void closeLevel(bool balanced);
	// GasInvasionGrains.cpp: what only the grains and their contacts know
	Real gapGrowth(int edge) const;
	bool bondBroken(Body::id_t a, Body::id_t b) const;
	int countBroken() const;
	std::vector<int> rattlersNow() const;
	std::vector<Real> displacements() const;
	Real largestLoaded(const std::vector<Real>& moved, const std::vector<int>& free) const;
	Real unbalanced() const;
	bool wallsAtRest() const;
	void brakeLooseGrains();
	template <class Wanted> std::vector<capfrac::ContactPair> contactsThat(Wanted wanted) const;

	// GasInvasionDisplacement.cpp: waterFlow = 'solved'
	void checkWaterFlow() const;
	void checkDisplacementTogether() const;
	void startDisplacement();
	Real reservoirSize() const;
	void joinPhases();
	std::vector<capfrac::TwoFluidPore> twoFluidPores() const;
	capfrac::TwoFluidNetwork twoFluidNetwork();
	void addReservoir(capfrac::TwoFluidNetwork& network) const;
	std::vector<Real> bodyPressures() const;
	void displaceWater();
	void writeBack(const capfrac::TwoFluidNetwork& network, const capfrac::DisplacementStep& done);
	void recordEntries(const capfrac::DisplacementStep& done);
	capfrac::TwoFluids twoFluids() const;
	// GasInvasionSupply.cpp: how much gas there is, and its pressure
	enum class GasControl { pressure, rate, reservoir };
	bool gasCounted() const { return gasState.law != capfrac::GasLaw::incompressible; } ///< by mass
	bool pressureFollows() const { return control != GasControl::pressure; }            ///< from the mass
	bool levelDue() const;
	void nextPressure();
	void followProgram();
	void endRamp();
	void goOnWhereChanged();
	void checkSupply() const;
	void checkSupplyTogether() const;
	void guardSupply();
	void warnOfSupply() const;
	void settleGas(Real supplied);
	void startCount();
	void attachReservoir();
	void settleConnected(const capfrac::GasClusters& clusters, const std::vector<double>& room, Real supplied);
	void settleCutOff(const capfrac::GasClusters& clusters, const std::vector<double>& room);
	void takeWaterOut();
	void shareOut(int cell, Real room, Real share, Real density);
	void followCutOff();
	std::vector<double> findCutOffPressures(const capfrac::GasClusters& clusters) const;
	/// Gas that hangs together: not through throats that are snapped off.
	capfrac::GasClusters gasClusters() const { return capfrac::gasClusters(mesh, contents, snapped); }
	void checkMass() const;
	void recordHistory();
	Real connectedGas() const;
	Real gasMassIn() const;
	Real periodOfGrains() const;
	Real densityAt(Real pressure) const { return capfrac::gasDensity(gasState, pressure + pressureDatum); }
	template <class Work> auto namingGas(Work work) const;

	capfrac::EntryLaw law = capfrac::EntryLaw::inscribedSphere;
	capfrac::Accepted accepted;
	capfrac::Accepted acceptedSupply;
	capfrac::EquationOfState gasState;
	GasControl control = GasControl::pressure;
	capfrac::Accepted acceptedDisplacement;
	std::vector<std::uint8_t> snapped;      ///< per edge: snapped off; empty until the first that is
	std::vector<capfrac::Disk> startGrains; ///< the grains when the invasion began
	capfrac::Box startBox;
	std::vector<int> edgeOfThroat; ///< of the last network of two fluids, without those of the reservoir

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GasInvasionEngine,SinglePhaseFlowEngine,
	R"""(Gas under a slowly rising pressure enters a water-filled, deformable sediment: capillary invasion,
fracture, or both.

Every step: the network follows the grains (:yref:`PoreNetworkEngine`); gas that hangs on the inlet advances through
every throat whose entry pressure, Eq. 15 of [Jain2008]_ (corrected) with the gap as it is now, does not exceed $P_c =
p_g - p_w$, the lowest first, until none is left (or one pore at a time:
:yref:`invasionInterval<GasInvasionEngine.invasionInterval>`); gas pores then load the grains with $p_g$, water pores
with $p_w$. The pressure rises by :yref:`pressureIncrement<GasInvasionEngine.pressureIncrement>` whenever the grains
are at rest. A grain that has lost its contacts and feels no other force, which :yref:`NewtonIntegrator.damping` cannot
slow down, loses its speed in the fluid around it: by $2d/T$, d being that damping and T the period of a mean grain on
a mean contact. Water is drained (its pressure is constant), the gas inviscid. With
:yref:`imbibition<GasInvasionEngine.imbibition>` water comes back when the pressure falls. Whether grains are pushed
apart is decided by the contacts alone.)""",
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
		((std::string,gasLaw,"incompressible",Attr::triggerPostLoad,
			"Equation of state of the gas: ``'incompressible'``, ``'ideal'`` (rho = p M/(Z R T)) or "
			"``'tabulated'`` [-]. Under a prescribed pressure it matters only for gas that is cut off from "
			"the inlet; a rate or a reservoir needs a compressible one."))
		((Real,gasMolarMass,0.016043,Attr::triggerPostLoad,"Molar mass $M$ of the gas [kg/mol], > 0; methane."))
		((Real,gasTemperature,293.15,Attr::triggerPostLoad,"Temperature $T$ of the gas, constant [K], > 0."))
		((Real,gasDeviation,1,Attr::triggerPostLoad,
			"Deviation factor $Z$ of the gas [-], > 0; 1 for an ideal gas, about 0.8 for methane at 10 MPa "
			"and 290 K."))
		((std::vector<Vector2r>,gasTable,,Attr::triggerPostLoad,
			"Pairs (absolute pressure [Pa], density [kg/m³]) of the tabulated law, both ascending, at "
			"least two; linear in between, in proportion below the first, refused above the last."))
		((Real,pressureDatum,101325,Attr::triggerPostLoad,
			"Absolute pressure where the pressures of this engine are zero [Pa]: that of the air, or of "
			"the water at the depth of the sediment if "
			":yref:`waterPressure<PoreNetworkEngine.waterPressure>` is 0 there."))
		((std::string,gasControl,"pressure",Attr::triggerPostLoad,
			"What is prescribed: ``'pressure'`` (the ramp, or "
			":yref:`pressureProgram<GasInvasionEngine.pressureProgram>`), ``'rate'`` "
			"(:yref:`gasRate<GasInvasionEngine.gasRate>`) or ``'reservoir'`` "
			"(:yref:`reservoirVolume<GasInvasionEngine.reservoirVolume>` of gas at the starting pressure, "
			"and no more) [-]. With the last two the pressure follows from the mass and the volume of the "
			"connected gas in the moving grains."))
		((std::vector<Real>,pressureProgram,,Attr::triggerPostLoad,
			"Turning points of the gas pressure [Pa]: it goes from one to the next, up or down, in steps "
			"of :yref:`pressureIncrement<GasInvasionEngine.pressureIncrement>`, each when the grains are "
			"at rest. Empty: the ramp up to :yref:`maxPressure<GasInvasionEngine.maxPressure>`."))
		((Real,gasRate,0,Attr::triggerPostLoad,
			"Mass of gas supplied per time with ``gasControl = 'rate'`` [kg/s], >= 0; 0 shuts the gas in."))
		((Real,reservoirVolume,0,Attr::triggerPostLoad,
			"Volume of gas upstream of the inlet, at the pressure of the connected gas [m³], >= 0; with a "
			"rate, the dead volume of the supply. Changed later, it comes or goes with its gas."))
		((int,historyInterval,0,Attr::triggerPostLoad,
			"Steps between two rows of :yref:`history<GasInvasionEngine.history>` [-], >= 0; 0: a row per "
			"level. At 8192 rows every second one goes and the interval doubles."))
		((int,programPosition,0,Attr::readonly,
			"Turning points of the program that were reached [-] |yupdate|."))
		((std::vector<Real>,programFollowed,,(Attr::hidden|Attr::readonly),
			"The program that programPosition counts in [Pa]."))
		((std::string,controlFollowed,"pressure",(Attr::hidden|Attr::readonly),
			"The gasControl of the last steps."))
		((Vector3r,rampEnd,Vector3r(NaN,NaN,NaN),(Attr::hidden|Attr::readonly),
			"gasPressure, maxPressure and pressureIncrement when a ramp or a held pressure was done [Pa]."))
		((std::vector<Real>,cutOffPressures,,(Attr::hidden|Attr::readonly),
			"Pressure of each cell of gas that is cut off [Pa]; NaN for the others."))
		((Real,reservoirMass,0,Attr::readonly,"Mass of gas in the reservoir [kg] |yupdate|."))
		((Real,initialGasMass,0,Attr::readonly,
			"Mass of gas in the reservoir and the pores of the inlet when counting began [kg] |yupdate|; 0 "
			"for the incompressible law."))
		((Real,injectedGasMass,0,Attr::readonly,
			"That and all that was supplied since, less what went back [kg] |yupdate|."))
		((Real,reservoirFilled,0,(Attr::hidden|Attr::readonly),
			"Volume of the reservoir that reservoirMass is the gas of."))
		((std::vector<Real>,returnedWater,,(Attr::hidden|Attr::readonly),
			"Water that came back into each cell of gas because the gas does not suffice [m²]."))
		((bool,massStarted,false,(Attr::hidden|Attr::readonly),"Whether the gas is counted by mass yet."))
		((int,historyStride,1,(Attr::hidden|Attr::readonly),
			"Rows of the history that come to one that is kept."))
		((int,historySeen,0,(Attr::hidden|Attr::readonly),"Rows of the history that came so far."))
		((std::vector<Vector6r>,historyNumbers,,(Attr::hidden|Attr::readonly),
			"Time, pressure, connected volume, mass, saturation of each row of the history."))
		((std::vector<Vector3i>,historyCounts,,(Attr::hidden|Attr::readonly),
			"Iteration, broken bonds, level of each row of the history."))
		((Real,unbalancedTolerance,1e-3,Attr::triggerPostLoad,
			"Mean resultant force on the grains over the mean contact force below which the grains count "
			"as at rest [-], > 0. The resultant is of all forces in the step, weight included, in the "
			"directions in which grains may move."))
		((int,minLevelSteps,100,Attr::triggerPostLoad,"Steps that a pressure level lasts at least [-], >= 1."))
		((int,maxLevelSteps,20000,Attr::triggerPostLoad,
			"Steps after which the pressure rises though the grains still move [-]; such levels are marked "
			"in :yref:`levels<GasInvasionEngine.levels>`."))
		((std::string,inletWall,"bottom",Attr::triggerPostLoad,
			"Wall with the gas inlet: ``'left'``, ``'right'``, ``'bottom'``, ``'top'`` [-]."))
		((Real,inletFrom,0,,
			"Begin of the inlet on its wall, a coordinate [m]; minus infinity: that of the wall. Pores "
			"whose stretch of wall has its middle in [inletFrom, inletTo] are the inlet."))
		((Real,inletTo,0,,
			"End of the inlet on its wall, a coordinate [m]; infinity: that of the wall. The width of the "
			"inlet controls at which pressure a cohesive sediment opens; it is on record in "
			":yref:`inletPores<GasInvasionEngine.inletPores>`."))
		((std::vector<Vector2r>,inletPoints,,,
			"Instead of a stretch of wall: points [m], at least one in the void; the pores that hold them "
			"are the inlet."))
		((std::string,outletWall,"top",Attr::triggerPostLoad,
			"Wall through which the water leaves, or ``'any'`` for all four; gas that reaches it has "
			"broken through [-]."))
		((bool,trapping,false,Attr::triggerPostLoad,
			"Whether water that is cut off from the outlet stays (true) or drains by films (false) [-]."))
		((bool,imbibition,false,,
			"Whether water refills pores when the capillary pressure falls below their refill pressure "
			"$2\\gamma\\cos\\theta/r_b$, $r_b$ the radius of the largest sphere in the pore, and gas that "
			"loses the inlet is trapped: it keeps its amount and its pressure. Gas recedes through the "
			"inlet alone, whose pores stay gas; the outlet passes water alone."))
		((bool,snapOff,false,Attr::triggerPostLoad,
			"With imbibition: whether the water films in a throat of gas snap it off below "
			"$\\gamma/r_{in}\\,(\\cos\\theta-\\sin\\theta\\tan\\beta)$, $\\beta$ = 45 degrees; $\\theta$ < "
			"45 degrees. Gas opens it again at its entry pressure."))
		((Real,filmConductance,0,Attr::triggerPostLoad,
			"With trapping, or ``waterFlow = 'solved'``: what trapped water loses by films per pressure "
			"difference [m³/(Pa·s)], >= 0; 0 locks it. Drained: a cluster loses $q=K(P_c-P_e)$, $P_e$ its "
			"lowest entry pressure, and has the pressure $p_g-P_e$ (>= waterPressure); solved: each of its "
			"pores loses K times its excess over waterPressure."))
		((Real,gasDensity,0,Attr::triggerPostLoad,
			"Density of the gas [kg/m³], >= 0; 0: weightless. With "
			":yref:`fluidDensity<SinglePhaseFlowEngine.fluidDensity>`, that of the water, and "
			":yref:`gravity<SinglePhaseFlowEngine.gravity>` both fluids have weight. Drained, they are "
			"columns at rest: gasPressure and waterPressure are those at the middle of the inlet, and the "
			"capillary pressure grows by $(\\rho_w-\\rho_g)g$ with the height above it. Solved, they flow "
			"by $p-\\rho\\,g\\cdot x$, begin at rest, and gasPressure, waterPressure and the pressures "
			"that boundaries prescribe are those at that place. The density of the gas is constant, "
			"whatever gasLaw says."))
		((std::string,waterFlow,"drained",Attr::triggerPostLoad,
			"``'drained'``: the water keeps :yref:`waterPressure<PoreNetworkEngine.waterPressure>` and "
			"gives way at once. ``'solved'``: it is viscous and compressible and has to flow to the "
			"outlet, which is held at waterPressure (or what "
			":yref:`wallPressures<SinglePhaseFlowEngine.wallPressures>` says), and so is the gas; both "
			"load the grains, and the step foresees how these give way (stable at the time step of the dry "
			"grains). Attributes of :yref:`SinglePhaseFlowEngine` then apply [-]."))
		((Real,gasViscosity,1.1e-5,Attr::triggerPostLoad,
			"Viscosity of the gas [Pa·s], > 0, with ``waterFlow = 'solved'``; methane."))
		((Real,maxFilling,0.5,Attr::triggerPostLoad,
			"Share of a pore that gas may fill in one part of a time step [-], > 0, with ``waterFlow = "
			"'solved'``: a long step is divided."))
		((std::vector<Real>,cellState,,(Attr::hidden|Attr::readonly),
			"Pressures of the cells at the end of the last step [Pa]."))
		((std::vector<Real>,cellHeld,,(Attr::hidden|Attr::readonly),
			"Capillary pressures of gas in cells of water [Pa]."))
		((std::vector<int>,edgeAdvancing,,(Attr::hidden|Attr::readonly),
			"Whether gas has passed the edge and fills the pore behind it."))
		((Real,openingThreshold,0.01,Attr::triggerPostLoad,
			"A throat counts as opened, not rigid, when its gap has grown by more than this many mean "
			"radii since the start, or its bond is broken [-], > 0."))
		((int,invasionInterval,0,Attr::triggerPostLoad,
			"Steps between one invaded pore and the next [-], >= 0. 0: the grains stand still during an "
			"avalanche, as in a rigid sediment. Otherwise the grains answer to each pore before the gas "
			"takes the next one, and a throat that opens at a fracture's tip comes before a rigid one with "
			"a higher entry pressure."))
		((bool,checkInvariants,false,,
			"Check after each avalanche that no throat opened below its entry pressure, that all gas hangs "
			"on the inlet or is trapped, and that every pore is counted once; throws otherwise."))
		((int,inletPores,0,Attr::readonly,"Number of domains that the inlet fills at the start |yupdate| [-]."))
		((Real,inletWidth,0,Attr::readonly,
			"Width of the wall that those domains cover [m] |yupdate|; 0 for points."))
		((Real,breakthroughPressure,NaN,Attr::readonly,
			"Gas pressure when gas first reached the outlet wall [Pa] |yupdate|; NaN before."))
		((int,breakthroughIter,-1,Attr::readonly,"Iteration of the breakthrough [-] |yupdate|; -1 before."))
		((Real,breakthroughDisplacement,NaN,Attr::readonly,
			"Largest displacement of a loaded grain over its radius at the breakthrough [-] |yupdate|. A "
			"grain is loaded that bore load at the start and bears some now."))
		((std::vector<Real>,breakthroughDisplacements,,(Attr::hidden|Attr::readonly),
			"Displacement of each grain over its radius at the breakthrough [-]."))
		((std::vector<int>,breakthroughRattlers,,(Attr::hidden|Attr::readonly),
			"Grains that bore no load at the breakthrough [ids], ascending."))
		((int,breakthroughBroken,-1,Attr::readonly,
			"Bonds broken until the breakthrough [-] |yupdate|; -1 before."))
		((Real,restDisplacement,0.01,Attr::triggerPostLoad,
			"The sample counts as at rest only while no wall would move farther than this within "
			"minLevelSteps, in units of the smallest radius [-], > 0: a sample that comes apart steadily "
			"is balanced, but not at rest."))
		((int,level,0,Attr::readonly,"Number of pressure levels that are finished [-] |yupdate|."))
		((int,levelStart,-1,Attr::readonly,"Iteration at which the present level began [-] |yupdate|."))
		((int,lastEventIter,-1,Attr::readonly,"Iteration of the last invasion [-] |yupdate|."))
		((int,nEvents,0,Attr::readonly,"Number of pores invaded so far [-] |yupdate|."))
		((bool,rampDone,false,Attr::readonly,"Whether the last level of the ramp is finished |yupdate|."))
		((Real,gasSaturation,0,Attr::readonly,
			"Share of the void volume that holds gas [-] |yupdate|, at each new level and each avalanche."))
		((int,nTrappedWater,0,Attr::readonly,
			"Domains of water that are cut off from the outlet [-] |yupdate| (with trapping)."))
		((Real,waterExcess,0,Attr::readonly,
			"With ``waterFlow = 'solved'``: how far the water that is not cut off is from rest [Pa], a "
			"mean over its volume |yupdate|. A level lasts until that is at most an increment, or a "
			"hundredth of the capillary pressure where that is more: the ramp waits for the water, too. "
			"Not with wallFluxes or pointFluxes, nor below a pressure that is prescribed elsewhere."))
		((int,nDetachedGas,0,Attr::readonly,
			"Domains of gas that are cut off from the inlet [-] |yupdate|; they keep the gas pressure "
			"(with imbibition: the one they had) and do not advance."))
		((int,nReturns,0,Attr::readonly,
			"Number of events of imbibition so far: pores refilled, throats snapped off and opened again "
			"[-] |yupdate|."))
		((std::vector<int>,rattlers,,Attr::readonly,
			"Grains that bore no load at the start: fewer than two contacts with at least a hundredth of "
			"the mean contact force [ids] |yupdate|. See "
			":yref:`rattlersNow<GasInvasionEngine.rattlersNow>`."))
		((std::vector<int>,savedBonds,,(Attr::hidden|Attr::readonly),"Pairs bonded at the start, for saving."))
		((std::vector<Real>,savedStart,,(Attr::hidden|Attr::readonly),
			"Grains and box at the start [m], for saving."))
		((std::vector<Vector3i>,eventBodies,,(Attr::hidden|Attr::readonly),
			"Cells of the events: three bodies each."))
		((std::vector<Vector3i>,eventThroats,,(Attr::hidden|Attr::readonly),
			"Throats of the events: two bodies and the flags (1 broken bond, 2 opened)."))
		((std::vector<Vector3i>,eventCounts,,(Attr::hidden|Attr::readonly),
			"Iteration, level, cells of each event."))
		((std::vector<Vector6r>,eventNumbers,,(Attr::hidden|Attr::readonly),
			"Time, gas pressure, entry pressure, gap, gap growth, void volume of each event."))
		((std::vector<Vector2r>,eventPlaces,,(Attr::hidden|Attr::readonly),"Where the entered pores are [m]."))
		((std::vector<int>,savedSnapped,,(Attr::hidden|Attr::readonly),
			"Edges that are snapped off, for saving."))
		((std::vector<Vector3i>,returnBodies,,(Attr::hidden|Attr::readonly),
			"Imbibition: cells refilled, three bodies each."))
		((std::vector<Vector3i>,returnThroats,,(Attr::hidden|Attr::readonly),
			"Imbibition: throats, two bodies, and the number of cells."))
		((std::vector<Vector3i>,returnCounts,,(Attr::hidden|Attr::readonly),
			"Imbibition: iteration, level, kind of each event."))
		((std::vector<Vector6r>,returnNumbers,,(Attr::hidden|Attr::readonly),
			"Imbibition: time, gas pressure, threshold, volume, x, y of each event."))
		((std::vector<Vector6r>,levelNumbers,,(Attr::hidden|Attr::readonly),
			"Pressure, saturation, unbalanced force, displacement of loaded grains, of all grains, gas "
			"volume at the end of each level."))
		((std::vector<Vector3i>,levelCounts,,(Attr::hidden|Attr::readonly),
			"Last iteration, broken bonds, whether at rest, of each level."))
		,
		guardAttributes();
		,
		.def("events",&GasInvasionEngine::pyEvents,
			"The log of all invasions as a dict of lists: ``time`` [s], ``iteration``, ``level``, "
			"``gasPressure`` [Pa], ``throat`` (two body ids), ``pore`` (body ids of its first cell), "
			"``x``, ``y`` [m], ``entryPressure`` [Pa], ``gap`` [m], ``gapGrowth`` [m] since the start, "
			"``bondBroken``, ``opened`` (bool), ``cells``, ``volume`` [m³].")
		.def("imbibitionEvents",&GasInvasionEngine::pyImbibitionEvents,
			"The log of imbibition as a dict of lists: ``kind`` ('refill': a pore; 'snapOff', 'reopening': "
			"a throat), ``time`` [s], ``iteration``, ``level``, ``gasPressure`` [Pa], ``threshold`` [Pa] "
			"(refill, snap-off or entry pressure), ``throat`` (two body ids; -1 for a refill), ``pore`` "
			"(body ids of its first cell; -1 for a throat), ``x``, ``y`` [m], ``cells``, ``volume`` [m³] "
			"of the gas that left.")
		.def("levels",&GasInvasionEngine::pyLevels,
			"The finished pressure levels as a dict of lists: ``pressure`` [Pa], ``gasSaturation`` [-], "
			"``brokenBonds``, ``displacement`` (the largest since the start, over the grain's radius, of "
			"the grains that bore load at the start and do now) and ``displacementWithRattlers`` (of all "
			"grains) [-], ``unbalanced`` [-], ``atRest`` (bool), ``iteration``, ``gasVolume`` [m³].")
		.def("gasLedger",&GasInvasionEngine::pyGasLedger,
			"The ledger of the gas by mass as a dict [kg]: ``injected`` (``initial``, in the reservoir and "
			"the pores of the inlet at the start, and ``supplied`` since), ``sample``, ``cutOff`` (that "
			"part of it that does not hang on the inlet), ``reservoir``, and ``error``, the relative "
			"difference between what came in and what is there. The incompressible gas has the density of "
			"the ideal one at the datum.")
		.def("history",&GasInvasionEngine::pyHistory,
			"The course of the injection as a dict of lists, a row per level or per "
			":yref:`historyInterval<GasInvasionEngine.historyInterval>` steps: ``time`` [s], "
			"``iteration``, ``gasPressure`` [Pa], ``connectedVolume`` (of the gas in the sample that hangs "
			"on the inlet [m³]), ``mass`` (injected [kg]), ``gasSaturation`` [-], ``brokenBonds``, "
			"``level``.")
		.def("risePerPeriod",&GasInvasionEngine::pyRisePerPeriod,
			"What the present :yref:`gasRate<GasInvasionEngine.gasRate>` adds to the pressure of the gas, "
			"at its present volume, within a period of a mean grain on a mean contact, 2 pi sqrt(m/k_n) "
			"[Pa]: in proportion to the rate. The grains stay near rest while it is a thousandth of the "
			"capillary pressure or less. Infinity without room for gas; 0 without contacts.")
		.def("inletStretch",&GasInvasionEngine::pyInletStretch,(boost::python::arg("nPores"),
			boost::python::arg("centre")),
			"The stretch of the inlet wall that nPores neighbouring pores cover, as near to the coordinate "
			"`centre` [m] as there are: (from, to) [m]. :raises ValueError: when the wall has fewer pores")
		.def("brokenBonds",&GasInvasionEngine::pyBonds,
			"Pairs of bodies that were bonded at the start and are not any more.")
		.def("rattlersNow",&GasInvasionEngine::pyRattlersNow,
			"Grains that bear no load as the contacts are now, by the measure of "
			":yref:`rattlers<GasInvasionEngine.rattlers>` [ids], ascending.")
		.def("displacements",&GasInvasionEngine::pyDisplacements,(boost::python::arg("atBreakthrough")=false),
			"How far each grain has moved since the start, now or at the breakthrough (no grains before "
			"it), as a dict of lists: ``ids``, ``displacement`` (over the grain's radius [-]), "
			"``rattlerAtStart``, ``rattler`` (bool: whether it bore no load then).")
		.def("nextEntryPressure",&GasInvasionEngine::pyNextEntryPressure,
			"The lowest entry pressure that the injected gas meets now [Pa], at the datum; infinity where "
			"there is none.")
	);
	// clang-format on
	DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(GasInvasionEngine);

} // namespace yade
