// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One part of a step of displace(): implicit, for a length that the caller chooses and may take back.

#include "Displacement.hpp"

namespace capfrac {

/// The grains at the beginning of a part, and how they answer.
struct DisplacedGrains {
	const Skeleton* skeleton = nullptr; ///< null: they stand still
	std::vector<VolumeEntry> gradient;  ///< of the skeleton, sorted
	GrainCompression compression;       ///< its lag: what the radii have still to grow by at pressure zero
	double dt = 0;                      ///< of the whole step [s]
};

/// The network at the end of a part.
struct DisplacementTrial {
	std::vector<double> pressure, water, gas, held, volume; ///< of the pores, as in TwoFluidPore
	std::vector<double> load;                               ///< [Pa]
	std::vector<double> growth;     ///< of the radii of compressed grains [m]; empty: rigid grains
	std::vector<double> throatFlow; ///< from a to b [m^3/s]
	std::vector<double> supply;     ///< into pores of fixed pressure [m^3/s, as amount]
	double films = 0;               ///< water that left through films [m^3/s, as amount]
	std::vector<std::uint8_t> open; ///< throats where gas advances
	std::vector<int> openings;      ///< of each throat, while the pressures were sought
	int iterations = 0, factored = 0;
};

class DisplacementPart {
public:
	/// `volume`: of the pores at the beginning of the part.
	DisplacementPart(const TwoFluidNetwork& network, const std::vector<double>& volume,
	        const DisplacedGrains& grains, PressureSolver& solver);

	/// The end after `h` [s].
	DisplacementTrial end(double h);

	/// The pore of water on the far side of a throat that gas is at; -1 where no gas meets water.
	int waterBehind(int throat) const { return beyond[throat]; }

private:
	// DisplacementThroats.cpp
	void findBeyond();
	/// What divides the conductance of a throat [Pa s].
	double viscosityIn(int throat) const;
	/// Capillary pressure of gas that is through [Pa].
	double heldBehind(int throat) const;
	/// By how much gas exceeds water in a throat where they meet, and in the pore of water behind it [Pa].
	double excessInThroat(const DisplacementTrial& trial, int throat) const;
	double excessBehind(const DisplacementTrial& trial, int throat) const;
	/// What the water in a pore that is cut off exceeds that at the end of its films by, at rest 0 [Pa].
	double excessOverFilms(const DisplacementTrial& trial, int pore) const;
	/// Conductance of a throat now [m^3/(Pa s)], 0 where gas may not pass.
	double conductance(const DisplacementTrial& trial, std::size_t throat) const;
	void findFlows(DisplacementTrial& trial) const;
	bool openAndShut(DisplacementTrial& trial, double slack) const;

	void moveAmounts(DisplacementTrial& trial, double h) const;
	void supplyReservoirs(DisplacementTrial& trial, double h) const;
	double residual(const DisplacementTrial& trial, int pore) const;
	double storage(const DisplacementTrial& trial, int pore) const;
	void evaluate(DisplacementTrial& trial, double h) const;
	/// By how much the pressure of each pore would have to change for what it holds to fill it [Pa], were it
	/// closed.
	std::vector<double> errors(const DisplacementTrial& trial, double h) const;
	void correct(DisplacementTrial& trial, double h);
	void keepOffVacuum(DisplacementTrial& trial) const;
	double scaleOf(const DisplacementTrial& trial) const;
	double sizeOf(const DisplacementTrial& trial, int pore) const;

	const TwoFluidNetwork& network;
	const std::vector<double>& volume;
	const DisplacedGrains& grains;
	GrainCompression softness; ///< of the grains: their compression without the lag
	PressureSolver& solver;
	std::vector<int> beyond;
	std::vector<double> share;        ///< of gas in each pore at the beginning
	std::vector<double> viscosity;    ///< in each throat
	std::vector<std::uint8_t> locked; ///< pores of water without any boundary
};

} // namespace capfrac
