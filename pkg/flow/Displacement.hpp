// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Gas displaces water, both viscous and compressible, between grains that may move.
///
/// Water flows between pores of water, gas between pores of gas, each with the conductance of the throat over its own
/// viscosity. From a pore of gas to a neighbour of water the throat is shut until the difference of their pressures
/// exceeds the entry pressure; then gas flows in, at G (p_g - p_w - s), and the neighbour's water gives way. s is the
/// capillary pressure of the meniscus in the pore, lower than that in the throat: what it falls by drives the jump.
/// When the last water has left, the neighbour is a pore of gas. Gas does not recede: a throat where the difference
/// falls below s is shut, and opens at the entry pressure again (no imbibition). The viscosity in a throat that gas has
/// just passed is that of what fills the pore behind it, in proportion.
///
/// Fluids with weight flow by the differences of p less their own heads. What the gas has to exceed the entry pressure
/// by is the difference in the throat, gas and water both carried there from their pores; gas that is through is
/// compared with the water in the body of the pore, for that is where its meniscus is. It is through where it exceeds
/// both: s is at most the capillary pressure that gas at the entry pressure has in the body.
///
/// A step is backward Euler, in parts that end when a pore is full. Which throats are open belongs to the unknowns:
/// found together with the pressures by Newton's method. Fluids move by the flows found, so both amounts are kept to
/// round-off whatever the pressures; where what a pore holds does not fill it exactly, the next part starts from there
/// and makes up for it.

#include "Coupling.hpp"
#include "TwoFluids.hpp"

#include <cstdint>

namespace capfrac {

/// The first gas in a pore of water.
struct GasEntry {
	int throat = -1, pore = -1;
	double time = 0; ///< after the beginning of the step [s]
};

/// A pore of water that became one of gas.
struct PoreFilled {
	int pore = -1;
	double time = 0; ///< after the beginning of the step [s]
};

struct DisplacementStep {
	std::vector<double>
	        load; ///< pressures that load the grains, mean over the step [Pa]: p + s times the share of gas
	std::vector<double> growth; ///< of the radii of compressed grains [m]; empty: rigid grains
	std::vector<double>
	        supply; ///< from outside into the pores of fixed pressure, mean over the step [m^3/s, as amount]
	std::vector<GasEntry> entries;  ///< in the order of time
	std::vector<PoreFilled> filled; ///< in the order of time
	std::vector<PoreFilled> lost;   ///< pores of gas that grains closed until the water in them had all the room
	FlowLedger water, gas;          ///< [m^3, as amounts]
	int parts = 0;                  ///< that the step was divided into
	int iterations = 0;             ///< of Newton's method, all parts together
	int factored = 0;               ///< factorizations
};

struct DisplacementOptions {
	double maxFilling = 0.5; ///< share of a pore's volume that gas may gain in one part of a step [-], > 0
};

/// Moves both fluids for `dt` [s]. Amounts, pressures and phases in the network are brought to the end of the step; the
/// volumes stay those of the beginning: the caller moves the grains, under `DisplacementStep::load`, in the same step.
/// `skeleton` (null: grains stand still) as in coupledStep(): the step foresees how grains give way and is stable
/// at the time step of the dry grains. Grains that the fluids compress (`Skeleton::compression`) do so under the
/// pressures that load them.
///
/// Throws FlowError as checkTwoFluidNetwork() and checkSkeleton() do, for a dt that is not positive, and where
/// pressures are not found (naming the pore); PressureSolverError as the solver does; GasLawError where the gas leaves
/// the range of its law. The network is then as before.
DisplacementStep displace(TwoFluidNetwork& network, const Skeleton* skeleton, double dt, PressureSolver& solver,
        const DisplacementOptions& options = {});

} // namespace capfrac
