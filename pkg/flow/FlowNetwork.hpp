// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A problem of single-phase flow in plain numbers: pores, throats between them, links to the outside.
///
/// Mass is the primary unknown. A pore of void volume V holds the mass m, counted as the volume [m^3] that
/// it fills at pressure zero; the pressure follows from the linear law of a slightly compressible fluid,
///
///     p = K_f (m/V - 1),   m = V (1 + p/K_f)                          K_f: bulk modulus [Pa]
///
/// so that a change of V at constant m is the term -dV_p of Eq. 11 of Jain & Juanes (2008) and needs no
/// bookkeeping of its own. All flows [m^3/s] are flows of m. With K_f infinite m is V.

#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace capfrac {

struct FlowPore {
	double volume = 0;                   ///< V [m^3] > 0
	double mass = 0;                     ///< m [m^3]
	double source = 0;                   ///< Q [m^3/s] into the pore
	std::optional<double> fixedPressure; ///< [Pa]: a reservoir; its mass is kept at V (1 + p/K_f) from outside
};

/// Flow from a to b is G (p_a - p_b).
struct FlowThroat {
	int a = -1, b = -1;     ///< pores
	double conductance = 0; ///< G = C/L [m^3/(Pa s)] >= 0
};

/// Flow out of the pore is G (p - pressure).
struct BoundaryLink {
	int pore = -1;
	double pressure = 0;    ///< outside [Pa]
	double conductance = 0; ///< G [m^3/(Pa s)] >= 0
};

struct FlowNetwork {
	std::vector<FlowPore> pores;
	std::vector<FlowThroat> throats;
	std::vector<BoundaryLink> links;
	double bulkModulus = std::numeric_limits<double>::infinity(); ///< K_f [Pa] > 0

	bool incompressible() const { return bulkModulus == std::numeric_limits<double>::infinity(); }
};

/// A flow problem that cannot be solved as it stands; the message names the pore or throat and the value.
struct FlowError : std::invalid_argument {
	explicit FlowError(const std::string& finding, int pore_ = -1)
	        : std::invalid_argument(finding)
	        , pore(pore_)
	{
	}
	int pore; ///< -1 where no single pore is at fault
};

/// Checks a fluid: bulk modulus [Pa] > 0, infinity allowed; viscosity [Pa s] > 0. Throws FlowError.
void checkFluid(double bulkModulus, double viscosity);

/// Checks every number of the network, not whether it can be solved. Throws FlowError.
void checkNetwork(const FlowNetwork& network);

/// The mass that fills `volume` at `pressure`: V (1 + p/K_f) [m^3].
double massAt(double pressure, double volume, double bulkModulus);

/// The pressure of every pore [Pa] from its mass, or the fixed one. K_f must be finite: an incompressible
/// fluid has the pressures of its last step only (FlowError).
std::vector<double> pressuresOf(const FlowNetwork& network);

/// Sum of the masses [m^3].
double totalMass(const FlowNetwork& network);

/// Sets of pores that exchange fluid through throats of G > 0.
struct FlowClusters {
	int count = 0;
	std::vector<int> ofPore;            ///< pore -> cluster, numbered by the first pore of each
	std::vector<int> first;             ///< cluster -> its first pore
	std::vector<std::uint8_t> grounded; ///< 1: a fixed pressure, or a link of G > 0, sets its level of pressure
};

FlowClusters findClusters(const FlowNetwork& network);

/// Checks that the pressure of an incompressible fluid is determined: some boundary with a pressure, and
/// one for every cluster. Clusters with `freeVolume` = 1 (empty: none) may go without, because grains that
/// give way set their pressure. Nothing to check for a compressible fluid. Throws FlowError.
void checkGrounded(
        const FlowNetwork& network, const FlowClusters& clusters, const std::vector<std::uint8_t>& freeVolume = {});

} // namespace capfrac
