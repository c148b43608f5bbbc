// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The books of the gas in drained water: how much of it there is, and what pressure it has.
///
/// Gas is counted where its law is compressible. Each cell holds a mass of it, so what is cut off takes its gas along
/// and what is met brings it in; clusters share theirs out evenly each step, at the pressure of their mass and volume.

#include "Supply.hpp"

#include "../network/GasClusters.hpp"
#include "../network/PoreNetwork.hpp"

namespace capfrac {

class GasBooks {
public:
	bool started = false;                ///< whether the gas is counted by mass yet
	double reservoirMass = 0;            ///< in the reservoir [kg]
	double reservoirFilled = 0;          ///< volume of the reservoir that this is the gas of [m^3]
	double initialMass = 0;              ///< in the reservoir and the inlet's pores when counting began [kg]
	double injectedMass = 0;             ///< that and all that was supplied since, less what went back [kg]
	std::vector<double> returnedWater;   ///< that came back into each cell because the gas does not suffice [m^2]
	std::vector<double> cutOffPressures; ///< of each cell of gas that is cut off [Pa]; NaN for the others

	/// Mass of the gas in the sample and the reservoir [kg].
	double massIn(const PoreNetwork& network) const;
	/// Brings masses, volumes and pressures into balance after `supplied` [kg] came in through the inlet. `shut`:
	/// edges through which gas does not hang together. Writes gasPressure [Pa] where it follows from the mass.
	void settle(PoreNetwork& network, const SupplyOptions& supply, const std::vector<std::uint8_t>& shut,
	        double waterPressure, double& gasPressure, double supplied);
	/// Takes the water out again that came back because the gas did not suffice. A pore that was entered counts as
	/// full but for that: a remeshing, which makes a new cell water where there is less gas than water in its part,
	/// must not lose it.
	void takeWaterOut(PoreNetwork& network);
	/// Pressures of what is cut off, after a remeshing: until the next step balances the gas again.
	void followCutOff(const PoreNetwork& network, const SupplyOptions& supply,
	        const std::vector<std::uint8_t>& shut, double waterPressure);
	/// A reservoir of another size comes, or goes, with its gas at the gas pressure.
	void attachReservoir(const SupplyOptions& supply, double gasPressure);
	/// Throws std::logic_error where what is there is not what was injected.
	void checkMass(const PoreNetwork& network) const;

private:
	/// What gas a step finds: the clusters, and the room for it in each cell [m^2].
	struct Found {
		GasClusters clusters;
		std::vector<double> room;
		double waterPressure = 0, lowest = 0; ///< that of the water, above the datum and absolute [Pa]
	};
	void startCount(PoreNetwork& network, const SupplyOptions& supply, double gasPressure);
	void settleConnected(PoreNetwork& network, const SupplyOptions& supply, const Found& found, double& gasPressure,
	        double supplied);
	void settleCutOff(PoreNetwork& network, const SupplyOptions& supply, const Found& found);
	void shareOut(PoreNetwork& network, int cell, double room, double share, double density);
	std::vector<double> findCutOffPressures(const PoreNetwork& network, const SupplyOptions& supply,
	        const GasClusters& clusters, double waterPressure) const;
};

} // namespace capfrac
