// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What models of gas that invades a sediment share: inlet and outlet, entry pressures, weights, pressure levels, logs.

#include "EventLog.hpp"
#include "FluidModel.hpp"
#include "Hydrostatics.hpp"
#include "Inlet.hpp"

#include "../laws/EntryPressure.hpp"
#include "../supply/GasBooks.hpp"
#include "../supply/Levels.hpp"

namespace capfrac {

/// What both kinds of invasion are told. Checked by checkOptions().
struct GasOptions {
	double tension = 0.05;   ///< gamma of gas and water [N/m] > 0
	double contactAngle = 0; ///< theta through the water [rad] in [0, pi/2)
	EntryLaw law = EntryLaw::inscribedSphere;
	double waterPressure = 0; ///< of the drained water, or at the outlet [Pa]
	InletOptions inlet;
	std::string outletWall = "top"; ///< a wall, or 'any'
	SupplyOptions supply;
	LevelOptions levels;
	double waterDensity = 0, gasDensity = 0; ///< [kg/m^3] >= 0
	Vec2 gravity;                            ///< [m/s^2]
	double filmConductance = 0;              ///< of water films, from what is trapped [m^3/(Pa s)] >= 0
	double openingThreshold = 0.01;          ///< growth of a gap that counts as opened, in mean radii [-] > 0
	int historyInterval = 0;                 ///< steps between two rows of the history >= 0; 0: a row a level
	bool checkInvariants = false;
};

/// Throws std::invalid_argument naming the option at fault.
void checkOptions(const GasOptions& options);

class GasModel : public FluidModel {
public:
	GasOptions gas;
	double gasPressure = 0;   ///< of the gas at the inlet [Pa]: told, or found where it follows from the mass
	double gasSaturation = 0; ///< share of the void that holds gas [-], as last found
	double waterExcess = 0;   ///< how far the water is from rest [Pa]; 0 where it is drained
	int lastEvent = -1;       ///< iteration of the last invasion; -1: none
	int inletPores = 0;       ///< domains that the inlet filled at the start
	double inletWidth = 0;    ///< of wall that they cover [m]
	GasBooks books;           ///< of its mass
	Levels levels;
	std::vector<InvasionEvent> events;
	std::vector<ReturnEvent> returns;
	History history;
	Breakthrough breakthrough;
	std::vector<Disk> startGrains; ///< when the invasion began
	Box startBox;

	void start(PoreNetwork& network, const Moment& now) override;
	double entryPressureOf(const PoreNetwork& network, int edge) const override;
	/// Share of the void that holds gas now [-].
	virtual double saturation(const PoreNetwork& network) const = 0;
	/// Gas that hangs together.
	virtual GasClusters clusters(const PoreNetwork& network) const
	{
		return gasClusters(network.mesh, network.contents);
	}
	/// Volume of the gas in the sample that hangs on the inlet [m^3].
	double connectedGas(const PoreNetwork& network) const;
	/// Mass injected so far [kg]; of an incompressible gas, at the density of the ideal one at the datum.
	double injectedMass(const PoreNetwork& network) const;
	/// The lowest entry pressure that the injected gas meets now [Pa], at the datum; infinity where there is none.
	virtual double nextEntryPressure(const PoreNetwork& network) const = 0;

	double capillaryPressure() const { return gasPressure - gas.waterPressure; }
	Hydrostatics columns(const PoreNetwork& network) const
	{
		return { gas.waterDensity, gas.gasDensity, gas.gravity, middleOf(network, gas.inlet) };
	}
	/// The capillary pressure at the datum at which gas enters a throat [Pa].
	double entryPressureAtDatum(const PoreNetwork& network, const Hydrostatics& columns, int edge) const;
	/// Growth of a gap since the start [m].
	double gapGrowth(const PoreNetwork& network, int edge) const;
	/// Displacement of each grain since the start over its radius [-].
	std::vector<double> displacements(const PoreNetwork& network) const;

protected:
	/// Finds the inlet, checks it and fills its pores.
	void fillInlet(PoreNetwork& network);
	/// Checks what only the whole of the options shows, before anything is filled.
	virtual void checkStart() const = 0;
	/// Whether water has to leave by the outlet, or to come in there, so that it must not be all of the inlet's.
	virtual bool needsOutlet() const { return gas.filmConductance > 0; }
	void checkOutlet(const PoreNetwork& network, const std::vector<int>& inlet) const;
	/// Called when the inlet is filled.
	virtual void startFluids(PoreNetwork&) {}
	/// Fills a domain with gas and books it.
	static void fillWithGas(PoreNetwork& network, int domain);
	void record(const PoreNetwork& network, const GrainAnswer& grains, const Moment& now, int edge, int domain);
	/// Notes when gas has reached the outlet.
	void noteBreakthrough(const PoreNetwork& network, long iteration);
	std::vector<int> outlets() const { return wallsFromName("outletWall", gas.outletWall); }
};

/// Density that an incompressible gas counts with [kg/m^3]: that of the ideal one at the datum; NaN without one.
double datumDensity(const SupplyOptions& supply);

} // namespace capfrac
