// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Pressure levels: each lasts until the grains are at rest, and decides which pressure comes next.

#include "Supply.hpp"

#include <array>
#include <limits>

namespace capfrac {

struct LevelOptions {
	double pressureIncrement = 0;      ///< step of the ramp or the program [Pa] >= 0; 0 holds the pressure
	double maxPressure = 0;            ///< where the ramp ends [Pa]
	std::vector<double> program;       ///< turning points [Pa]; empty: a ramp
	double unbalancedTolerance = 1e-3; ///< below which grains count as at rest [-] > 0
	double restDisplacement = 0.01;    ///< of a wall within minSteps that counts as rest, in smallest radii [-] > 0
	int minSteps = 100;                ///< that a level lasts at least >= 1
	int maxSteps = 20000;              ///< after which the pressure goes on though the grains still move
	int invasionInterval = 0;          ///< steps between one invaded pore and the next >= 0
};

/// Throws std::invalid_argument naming the option at fault.
void checkOptions(const LevelOptions& options);
/// Checks what only the whole shows. Throws std::invalid_argument.
void checkTogether(const LevelOptions& options, const SupplyOptions& supply, double waterPressure);

/// A level that is finished.
struct Level {
	double pressure = 0;                 ///< of the gas [Pa]
	double saturation = 0;               ///< share of the void that holds gas [-]
	double unbalanced = 0;               ///< mean resultant over mean contact force [-]
	double displacement = 0;             ///< largest of the grains that bear load, over their radii [-]
	double displacementWithRattlers = 0; ///< largest of all grains, over their radii [-]
	double gasVolume = 0;                ///< [m^3]
	int iteration = 0;                   ///< its last step
	int brokenBonds = 0;
	bool atRest = false; ///< else maxSteps ended it
};

class Levels {
public:
	std::vector<Level> closed;
	int start = -1;          ///< iteration at which the present level began; -1: none yet
	bool done = false;       ///< the last one is finished
	int programPosition = 0; ///< turning points that were reached

	/// Whether the pressure has come to where a level may be closed.
	bool due(const LevelOptions& options, const SupplyOptions& supply, double gasPressure) const;
	/// The pressure of the next level, which begins at `iteration`; or that was the last one.
	void next(const LevelOptions& options, const SupplyOptions& supply, double& gasPressure, int iteration);
	/// Takes note of options that were changed: another control goes on from here, a new program begins, and so
	/// does a ramp whose end was moved up, or a held pressure that was changed. What was followed is saved: after
	/// loading it changes nothing.
	void follow(const LevelOptions& options, const SupplyOptions& supply, double gasPressure);

	// What follow() compares with: part of the state that is saved.
	std::vector<double> programFollowed;
	GasControl controlFollowed = GasControl::pressure;
	std::array<double, 3> rampEnd { std::numeric_limits<double>::quiet_NaN(), 0,
		0 }; ///< of a ramp that was done [Pa]

private:
	void followProgram(const LevelOptions& options, double& gasPressure);
};

} // namespace capfrac
