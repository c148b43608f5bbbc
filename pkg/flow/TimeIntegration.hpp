#pragma once

/// One step in time of single-phase flow between grains that move, Eq. 11 of Jain & Juanes (2008):
///
///     dp = (K_f/V) (-dV - sum q dt)
///
/// in three ways: explicit, backward Euler, and backward Euler that foresees how the grains give way. All
/// of them find flows [m^3/s] first and then move mass by these flows, from one place to another, so that
/// mass is kept to round-off whatever the pressures. Where a pressure and K_f (m/V - 1) differ, by the
/// accuracy of the solver or because volumes were foreseen wrongly, the next step starts from m and makes
/// up for it.

#include "FlowNetwork.hpp"
#include "PressureSolver.hpp"

#include "../geometry/VolumeGradients.hpp"

namespace capfrac {

/// What entered, left and stayed during a step [m^3].
struct FlowLedger {
	double in     = 0; ///< through links, sources > 0 and reservoirs
	double out    = 0; ///< through links, sources < 0 and reservoirs
	double stored = 0; ///< growth of the mass in the pores
	double held   = 0; ///< mass in the pores at the end

	/// Mass lost [m^3]: 0 but for round-off.
	double defect() const { return in - out - stored; }
};

struct FlowStep {
	std::vector<double> pressure;   ///< of the pores at the end [Pa]; those that load the grains
	std::vector<double> volume;     ///< of the pores at the end [m^3]; foreseen by coupledStep()
	std::vector<double> throatFlow; ///< from a to b [m^3/s]
	std::vector<double> linkFlow;   ///< out of the sample [m^3/s]
	std::vector<double> supply;     ///< from outside into the pores of fixed pressure [m^3/s], 0 elsewhere
	FlowLedger          ledger;
	double              residual   = 0;     ///< of the linear system, relative
	int                 iterations = 0;     ///< of the linear solver
	bool                factored   = false; ///< the solver made a new factor
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
/// FlowError when dt exceeds explicitTimeStepLimit() or is not positive, and as that does.
FlowStep explicitStep(FlowNetwork& network, const std::vector<double>& newVolume, double dt);

/// Backward Euler, stable for any dt [s] > 0 and any K_f, infinity included:
///
///     V' p'/(K_f dt) + sum G (p' - p'_j) = Q + (m - V')/dt            ' marks the end of the step
///
/// where m - V' = V p/K_f - dV. First order in dt. Arguments as above. Throws FlowError as checkNetwork()
/// and checkGrounded() do, PressureSolverError as the solver does.
FlowStep implicitStep(FlowNetwork& network, const std::vector<double>& newVolume, double dt, PressureSolver& solver);

/// dV/dx of a pore with respect to one degree of freedom [m^2].
struct VolumeEntry {
	int    pore = -1, freedom = -1;
	double value = 0;
};

/// The grains as coupledStep() sees them, one entry per degree of freedom (a component of a velocity).
struct Skeleton {
	std::vector<VolumeEntry> gradient; ///< B, in any order; entries of the same place add up
	std::vector<double>      velocity; ///< v at the beginning of the step (leapfrog: half a step ago) [m/s]
	std::vector<double>      force;    ///< F_c: all forces but those of the fluid [N]
	std::vector<double>      mass;     ///< [kg] > 0; infinity: the motion is prescribed
	double                   damping = 0; ///< lambda of YADE's local damping, 0 <= lambda < 1
};

/// B of the pores from that of the cells: pore `poreOfCell[c]` holds cell c (-1: none). Grain i has the
/// degrees of freedom 2i and 2i + 1, wall w has 2 nGrains + w (along its outward normal); times the
/// `thickness` [m].
std::vector<VolumeEntry> poreGradient(const VolumeGradients& gradients, const std::vector<int>& poreOfCell, int nGrains, double thickness);

/// Backward Euler stable together with an explicit step of the grains, at the time step of the dry grains
/// and at any K_f, infinity included. The leapfrog v' = v + dt (F_c + B^T p')/m, x' = x + dt v' moves the
/// volumes to V' = V + dt B v', to first order. Put into the balance of mass:
///
///     [V/(K_f dt) + L + dt B M^-1 B^T] p' = Q + (m - V)/dt - B (v + dt M^-1 F_c)
///
/// L is the Laplacian of the conductances. All three matrices are symmetric and positive semidefinite; the
/// fluid is a Chorin projection with compressibility and leak-off. Prescribed motions stay out of M^-1.
/// Local damping multiplies accelerations by 1 -+ lambda; M^-1 is taken 1 + lambda times as large throughout, the
/// safe side: in the matrix alone it would leave a bias in grains at rest.
///
/// The volumes in the network are those at the beginning of the step and stay: the caller moves the grains
/// with B^T p' in the same step and sets the new volumes. What they differ from `FlowStep::volume` becomes
/// a correction of pressure in the next step, never lost fluid. Throws as implicitStep() does (a cluster
/// without boundary is determined where grains can change its volume), and FlowError for a mass, force,
/// velocity, damping or index out of range.
FlowStep coupledStep(FlowNetwork& network, const Skeleton& skeleton, double dt, PressureSolver& solver);

} // namespace capfrac
