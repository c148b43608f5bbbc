// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The pores of a network as a problem of flow: volumes and places, throats, boundaries, and how grains give way.
///
/// Pores are the domains; one that grains have all but closed is joined to the neighbour across its widest throat,
/// because a pressure K_f (m/V - 1) means nothing where V goes to zero.

#include "FluidModel.hpp"

#include "../laws/Conductance.hpp"
#include "../network/PoreNetwork.hpp"

#include <optional>

namespace capfrac {

enum class FlowScheme { undrainedStable, implicit, explicitEuler };

/// 'undrainedStable', 'implicit' or 'explicit'; throws std::invalid_argument naming `timeIntegration` otherwise.
FlowScheme flowSchemeFromName(const std::string& name);

/// A value at a place.
struct PointValue {
	Vec2 point;       ///< [m]
	double value = 0; ///< [Pa] or [m^3/s]
};

constexpr double noPressure = std::numeric_limits<double>::quiet_NaN();

/// What the flow of the water is told. Checked by checkOptions().
struct FlowOptions {
	double bulkModulus = 2.2e9; ///< K_f [Pa] > 0, infinity for an incompressible fluid
	double viscosity = 1e-3;    ///< [Pa s] > 0
	ConductanceLaw law = ConductanceLaw::fourSpheres;
	double conductanceFactor = 1; ///< [-] > 0
	double residualAperture = 0;  ///< of parallel plates without force [m] >= 0
	double halvingForce = 1;      ///< that halves their aperture [N] > 0
	FlowScheme scheme = FlowScheme::undrainedStable;
	std::vector<double> wallPressures { noPressure, noPressure, noPressure, noPressure }; ///< [Pa]; NaN: none
	std::vector<double> wallFluxes { 0, 0, 0, 0 };                                        ///< inflow [m^3/s]
	std::vector<PointValue> pointPressures, pointFluxes;
	double density = 0;                                                ///< of the fluid [kg/m^3] >= 0
	Vec2 gravity;                                                      ///< [m/s^2]
	double grainBulkModulus = std::numeric_limits<double>::infinity(); ///< K_s [Pa] > 0
	double closedPore = 1e-3; ///< area of a pore that counts as closed, in smallest grains [-] > 0
};

/// Throws std::invalid_argument naming the option at fault.
void checkOptions(const FlowOptions& options);

class PoreFlow {
public:
	FlowOptions options;
	/// Pressures held in the pores along the walls [Pa]; NaN: none. Those of the options, or what a model makes of
	/// them.
	std::array<double, nWalls> prescribed { noPressure, noPressure, noPressure, noPressure };

	int nPores = 0;
	std::vector<int> poreOfCell;
	std::vector<Vec2> poreCentre;   ///< centroids of the voids [m]
	std::vector<double> poreVolume; ///< [m^3]
	std::vector<double> voids;      ///< of the cells [m^2]
	VolumeGradients gradients;      ///< of the cells
	PressureSolver solver;
	std::vector<double> referenceRadii; ///< at the start [m]
	double referencePressure = 0;       ///< at the start [Pa]

	/// Fills the cells with water at a pressure [Pa], under which the grains have the radii of Eq. 10 of Jain &
	/// Juanes (2008) that they have.
	void start(PoreNetwork& network, double pressure);
	/// Pores, volumes, centroids and gradients as they are now.
	void describe(const PoreNetwork& network);
	/// The throat at an edge between two pores; nothing where there is none.
	std::optional<FlowThroat> throatAt(const PoreNetwork& network, int edge, const GrainAnswer& grains) const;
	/// Volumes, masses, throats and boundaries; the fluid's weight drives the throats' flow.
	FlowNetwork flowNetwork(const PoreNetwork& network, const GrainAnswer& grains) const;
	/// Sources and prescribed pressures of walls and points, into the pores of `flow`.
	void addBoundaries(const PoreNetwork& network, FlowNetwork& flow) const;
	/// How grains and walls give way, with the pores' gradient; `weight`: forces of the fluid's weight [N/m].
	Skeleton skeleton(const PoreNetwork& network, const GrainAnswer& grains, const FluidForces& weight) const;
	/// Forces [N/m] of pressures per cell [Pa], by the very gradient that a step foresees volumes with: what the
	/// grains gain in work the fluid loses; and those of the fluid's `weight`, of no size where it has none.
	FluidForces loads(
	        const PoreNetwork& network, const std::vector<double>& pressures, const FluidForces& weight) const;
	GrainCompression compression(const PoreNetwork& network) const;
	/// Refuses growths of the radii [m] for which Eq. 10 means nothing. Throws std::runtime_error naming the grain.
	void checkGrowth(const PoreNetwork& network, const std::vector<double>& growth) const;
	/// Inflow through each wall [m^3/s] in a step that supplied so much to each pore.
	std::array<double, nWalls> wallInflow(const std::vector<double>& supply) const;
	/// Stiffness that closed pores add to a wall [N/m]; 0 where the step foresees how the wall gives way.
	double wallStiffness(const PoreNetwork& network, int wall) const;
	/// " (pore 3 lies at (x, y) m)"; empty where there is no such pore.
	std::string placeOf(int pore) const;
	/// Runs `work`; a FlowError that it throws is thrown again with the place of its pore.
	template <class Work> auto namingPores(Work work) const
	{
		try {
			return work();
		} catch (const FlowError& error) {
			throw FlowError(error.what() + placeOf(error.pore));
		}
	}

private:
	void group(const PoreNetwork& network, const std::vector<VoidMoments>& moments);
	void findPoresAlongWalls(const PoreNetwork& network);
	void fix(FlowNetwork& flow, int pore, double pressure, const std::string& owner) const;

	std::array<std::vector<int>, nWalls> poresAlong; ///< those at a prescribed pressure along each wall
};

} // namespace capfrac
