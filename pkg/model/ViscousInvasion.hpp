// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Gas invades a sediment against the viscosity of the water: both fluids flow, both are compressible, both load
/// grains.
///
/// See flow/Displacement.hpp for a step. It has the pores of a PoreFlow, and the gas of the supply as one more pore.

#include "GasModel.hpp"
#include "SinglePhase.hpp"

#include "../flow/Displacement.hpp"

namespace capfrac {

struct ViscousOptions {
	double gasViscosity = 1.1e-5; ///< [Pa s] > 0; methane
	double maxFilling = 0.5;      ///< share of a pore that gas may fill in a part of a step [-] > 0
};

/// Throws std::invalid_argument naming the option at fault.
void checkOptions(const ViscousOptions& options);

class ViscousInvasion : public GasModel {
public:
	ViscousOptions options;
	PoreFlow flow; ///< its options tell of the water
	FlowRecord flowRecord;
	std::vector<double> growth; ///< of the grains' radii in the last step [m]; empty: rigid grains

	// What cells and edges have beside their contents: part of the state that is saved.
	std::vector<double> cellLoad;            ///< pressure by which a cell loads the grains [Pa]
	std::vector<double> cellState;           ///< pressure of a cell at the end of the last step [Pa]
	std::vector<double> cellHeld;            ///< capillary pressure of gas in a cell of water [Pa]
	std::vector<std::uint8_t> edgeAdvancing; ///< whether gas has passed the edge and fills the pore behind it

	bool drained() const override { return false; }
	void fields(CarryOver& carry) override;
	void advance(PoreNetwork& network, const GrainAnswer& grains, const Moment& now) override;
	void beforeReport(PoreNetwork& network) override { describe(network); }
	std::vector<double> cellPressures(const PoreNetwork& network) const override;
	FluidForces loads(const PoreNetwork& network) const override;
	double saturation(const PoreNetwork&) const override { return gasSaturation; } // of the last step
	double nextEntryPressure(const PoreNetwork& network) const override;

protected:
	void checkStart() const override;
	void startFluids(PoreNetwork& network) override;

private:
	TwoFluids fluids() const;
	double reservoirSize(const PoreNetwork& network) const;
	void letWaterRest(PoreNetwork& network);
	void describe(PoreNetwork& network);
	FluidForces weightOfFluids(const PoreNetwork& network) const;
	DisplacementStep step(const PoreNetwork& network, TwoFluidNetwork& pores, const GrainAnswer& grains, double dt);
	void recordEntries(
	        const PoreNetwork& network, const GrainAnswer& grains, const Moment& now, const DisplacementStep& done);
	void writeBack(
	        PoreNetwork& network, const TwoFluidNetwork& pores, const DisplacementStep& done, long iteration);
	void measureSaturation(const PoreNetwork& network, const TwoFluidNetwork& pores, long iteration);
	// ViscousPores.cpp: the pores as a problem of two fluids
	void joinPhases(PoreNetwork& network) const;
	std::vector<double> bodyPressures(const PoreNetwork& network) const;
	std::vector<TwoFluidPore> twoFluidPores(const PoreNetwork& network) const;
	TwoFluidNetwork twoFluidNetwork(PoreNetwork& network, const GrainAnswer& grains);
	void addThroats(const PoreNetwork& network, const GrainAnswer& grains, TwoFluidNetwork& pores);
	void addReservoir(const PoreNetwork& network, TwoFluidNetwork& pores) const;

	std::vector<int> edgeOfThroat; ///< of the last network of two fluids, without those of the reservoir
	FluidForces weightForce;       ///< of the fluids as they are now; no grains: they have none
};

} // namespace capfrac
