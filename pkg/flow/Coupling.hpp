// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Flow and the motion of the grains in one linear system: see coupledStep().

#include "GrainCompression.hpp"
#include "TimeIntegration.hpp"

#include "../geometry/VolumeGradients.hpp"

namespace capfrac {

class Assembly;

/// dV/dx of a pore with respect to one degree of freedom [m^2].
struct VolumeEntry {
	int pore = -1, freedom = -1;
	double value = 0;
};

/// The grains as coupledStep() sees them, one entry per degree of freedom (a component of a velocity).
struct Skeleton {
	std::vector<VolumeEntry> gradient; ///< B; fastest as poreGradient() returns it: sorted by freedom, then pore
	std::vector<double> velocity;      ///< v at the beginning of the step (leapfrog: half a step ago) [m/s]
	std::vector<double> force;         ///< F_c: all forces but those of the fluid [N]
	std::vector<double> mass;          ///< [kg] > 0; infinity: the motion is prescribed
	double damping = 0;                ///< lambda of YADE's local damping, 0 <= lambda < 1
	GrainCompression compression;      ///< of the grains by the fluid; empty: rigid
};

/// B of the pores from that of the cells: pore `poreOfCell[c]` holds cell c (-1: none). Grain i has the
/// degrees of freedom 2i and 2i + 1, wall w has 2 nGrains + w (along its outward normal); times the
/// `thickness` [m]. Sorted by degree of freedom, then pore, one entry for each place.
std::vector<VolumeEntry> poreGradient(
        const VolumeGradients& gradients, const std::vector<int>& poreOfCell, int nGrains, double thickness);

/// Adds dt (1 + lambda) B M^-1 B^T to a system; `b` as in Skeleton, sorted by freedom, then pore.
void addMobility(Assembly& assembly, const std::vector<VolumeEntry>& b, const Skeleton& skeleton, double dt);

/// Rates of the volumes of the pores [m^3/s] under the pressures `load` [Pa], B (v + dt (1 + lambda) M^-1 (F_c + B^T
/// load)); `b` as above.
std::vector<double> volumeRates(
        const std::vector<VolumeEntry>& b, const Skeleton& skeleton, const std::vector<double>& load, double dt);

/// The entries sorted by freedom, then pore, those of the same place added up.
std::vector<VolumeEntry> sortedGradient(std::vector<VolumeEntry> entries);

/// Checks the numbers of a skeleton of so many pores. Throws FlowError.
void checkSkeleton(int nPores, const Skeleton& skeleton);

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
