// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One step in time of single-phase flow between grains that move, Eq. 11 of Jain & Juanes (2008):
///
///     dp = (K_f/V) (-dV - sum q dt)
///
/// in three ways: explicit, backward Euler, and backward Euler that foresees how the grains give way
/// (Coupling.hpp). All of them find flows [m^3/s] first and then move mass by these flows, from one place to another,
/// so that mass is kept to round-off whatever the pressures. Where a pressure and K_f (m/V - 1) differ, by the accuracy
/// of the solver or because volumes were foreseen wrongly, the next step starts from m and makes up for it.

#include "FlowNetwork.hpp"
#include "GrainCompression.hpp"
#include "PressureSolver.hpp"

namespace capfrac {

/// What entered, left and stayed during a step [m^3].
struct FlowLedger {
	double in = 0;     ///< through links, sources > 0 and reservoirs
	double out = 0;    ///< through links, sources < 0 and reservoirs
	double stored = 0; ///< growth of the mass in the pores
	double held = 0;   ///< mass in the pores at the end

	/// Mass lost [m^3]: 0 but for round-off.
	double defect() const { return in - out - stored; }
};

struct FlowStep {
	std::vector<double> pressure;   ///< of the pores at the end [Pa]; those that load the grains
	std::vector<double> volume;     ///< of the pores at the end [m^3]; foreseen where grains give way to the fluid
	std::vector<double> growth;     ///< of the radii of compressed grains [m]; empty: rigid grains
	std::vector<double> throatFlow; ///< from a to b [m^3/s]
	std::vector<double> linkFlow;   ///< out of the sample [m^3/s]
	std::vector<double> supply;     ///< from outside into the pores of fixed pressure [m^3/s], 0 elsewhere
	FlowLedger ledger;
	double residual = 0;   ///< of the linear system, relative
	int iterations = 0;    ///< of the linear solver
	bool factored = false; ///< the solver made a new factor
};

/// The longest explicit step [s], Eq. 12-14 of Jain & Juanes (2008) with the sum of Eq. 13 put right:
///
///     dt <= min V/(K_f sum G)          over the pores whose pressure is not fixed
///
/// Eigenvalues of the scheme are at most 2 K_f sum G/V (Gershgorin), so it is the limit of stability as
/// well. Infinity where nothing flows. Throws FlowError for an incompressible fluid and as checkNetwork().
double explicitTimeStepLimit(const FlowNetwork& network);

/// Flow under the pressures at the beginning of the step, for `dt` [s]. `newVolume` [m^3] > 0 are the
/// volumes at the end (empty: unchanged); they and the new masses are written to the network. Throws
/// FlowError when dt exceeds explicitTimeStepLimit() or is not positive, and as that does. Grains that the
/// fluid compresses answer a step later here; FlowError where that diverges (laggedResponse() >= 1).
FlowStep explicitStep(FlowNetwork& network, const std::vector<double>& newVolume, double dt,
        const GrainCompression& compression = {});

/// Backward Euler, stable for any dt [s] > 0 and any K_f, infinity included:
///
///     V' p'/(K_f dt) + sum G (p' - p'_j) = Q + (m - V')/dt            ' marks the end of the step
///
/// where m - V' = V p/K_f - dV. First order in dt. `newVolume` are the volumes with the radii as they are; what
/// grains give way to under p' is in the matrix and in FlowStep::volume. Other arguments as above. Throws
/// FlowError as checkNetwork() and checkGrounded() do, PressureSolverError as the solver does.
FlowStep implicitStep(FlowNetwork& network, const std::vector<double>& newVolume, double dt, PressureSolver& solver,
        const GrainCompression& compression = {});

} // namespace capfrac
