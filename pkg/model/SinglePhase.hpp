// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One viscous fluid, compressible or not, between grains that move: Eqs. 8 to 14 of Jain & Juanes (2008).
///
/// The mass of the cells (Contents::water, as volume at pressure zero) is the state; a pore's pressure follows from the
/// masses and the voids of its cells. See TimeIntegration.hpp for the three schemes.

#include "PoreFlow.hpp"

namespace capfrac {

/// What flowed so far and in the last step.
struct FlowRecord {
	double massDefect = 0;                ///< sum of in - out - stored over all steps [m^3]: round-off
	std::array<double, nWalls> inflow {}; ///< through the walls in the last step [m^3/s]
	int solverIterations = 0;             ///< in the last step
	int nFactorizations = 0;              ///< so far
};

class SinglePhase : public FluidModel {
public:
	PoreFlow flow;                    ///< its options are this model's
	double initialPressure = 0;       ///< [Pa]
	std::vector<double> cellPressure; ///< after the last step [Pa]; an incompressible fluid has no others
	std::vector<double> growth;       ///< of the grains' radii in the last step [m]; empty: rigid grains
	FlowRecord record;

	void start(PoreNetwork& network, const Moment& now) override;
	bool drained() const override { return false; }
	void fields(CarryOver& carry) override { carry.cells(cellPressure, initialPressure); }
	void advance(PoreNetwork& network, const GrainAnswer& grains, const Moment& now) override;
	void beforeReport(PoreNetwork& network) override { describe(network); }
	std::vector<double> cellPressures(const PoreNetwork& network) const override;
	FluidForces loads(const PoreNetwork& network) const override;
	/// The longest step of the explicit scheme now [s], Eqs. 12-14.
	double timeStepLimit(PoreNetwork& network, const GrainAnswer& grains);
	/// Fills the cells to pressures of their own [Pa] and begins the books anew. Throws std::invalid_argument for
	/// an incompressible fluid.
	void setPressures(PoreNetwork& network, const std::vector<double>& pressures);

private:
	void describe(const PoreNetwork& network);
	FluidForces weightOfFluid(const PoreNetwork& network) const;
	FlowStep step(const PoreNetwork& network, FlowNetwork& pores, const GrainAnswer& grains, double dt);

	FluidForces weightForce; ///< of the fluid as it is now; no grains: it has none
};

/// Refuses gravity that would be ignored, as no fluid has a density.
void checkWeight(Vec2 gravity, bool weightless);

} // namespace capfrac
