// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the schemes in time share: the linear system of a step, and the move of mass by the flows it gave.

#include "GrainCompression.hpp"
#include "TimeIntegration.hpp"

#include <string>

namespace capfrac {

/// Throws FlowError "what = value, allowed: allowed".
[[noreturn]] void refuseStep(const std::string& what, double value, const std::string& allowed);

/// Checks a time step [s]: > 0. Throws FlowError.
void checkStep(double dt);

/// Volumes of the pores [m^3].
std::vector<double> volumesOf(const FlowNetwork& network);

/// Per cluster: 1 where the fluid compresses a grain on its border, so that its volume is not fixed.
std::vector<std::uint8_t> compressed(const FlowClusters& clusters, const GrainCompression& compression);

/// A linear system in the pressures of all pores, of which the fixed ones go to the right-hand side. It
/// begins as L p = Q: conductances, links and sources.
class Assembly {
public:
	explicit Assembly(const FlowNetwork& network);

	/// Adds to the matrix, at (i, j) and (j, i).
	void add(int i, int j, double value)
	{
		const int u = unknown[i], v = unknown[j];
		if (u >= 0 && u == v)
			system.diagonal[u] += value;
		else if (u >= 0 && v >= 0)
			system.entries.push_back({ u, v, value });
		else if (u >= 0)
			right[u] -= value * *network.pores[j].fixedPressure;
		else if (v >= 0)
			right[v] -= value * *network.pores[i].fixedPressure;
	}

	/// Adds to the right-hand side [m^3/s].
	void addRight(int i, double value)
	{
		if (unknown[i] >= 0) right[unknown[i]] += value;
	}

	/// Storage for the volumes `volume` at the end of the step; with an infinite K_f that of the volumes only.
	void addStorage(const std::vector<double>& volume, double dt);

	/// What grains give way to as the fluid compresses them.
	void addCompression(const GrainCompression& compression, double dt);

	/// Finds the pressures of all pores, fixed ones as given, and the flows under them.
	void solve(PressureSolver& solver, FlowStep& step) const;

private:
	const FlowNetwork& network;
	std::vector<int> unknown; ///< pore -> row, -1 for a fixed pressure
	int count = 0;
	PressureSystem system;
	std::vector<double> right;
};

/// Throat and link flows under `step.pressure`.
void findFlows(const FlowNetwork& network, FlowStep& step);

/// Moves mass by the flows found, for `dt`, and writes the ledger. A pore of fixed pressure is topped up
/// from outside to what its volume at the end, `step.volume`, holds at that pressure.
void moveMass(FlowNetwork& network, double dt, FlowStep& step);

} // namespace capfrac
