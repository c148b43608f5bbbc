// SPDX-License-Identifier: GPL-2.0-or-later
/// Pressures of GasInvasionEngine, and when they rise.

#include "GasInvasionEngine.hpp"

#include <algorithm>

namespace yade {

namespace {

	/// Excess of the water's pressure that still counts as rest, over the capillary pressure [-]: so far a pressure
	/// at which gas enters may be off.
	constexpr Real restingExcess = 0.01;

} // namespace

void GasInvasionEngine::finishStep()
{
	brakeLooseGrains();
	if (historyInterval > 0 && scene->iter % historyInterval == 0) recordHistory();
	constexpr int checkPeriod = 10; // the check costs about as much as the rest of the engine
	if (rampDone || scene->iter % checkPeriod != 0 || !levelDue()) return;
	const int steps = static_cast<int>(scene->iter) - std::max(levelStart, lastEventIter);
	if (steps < std::max(minLevelSteps, invasionInterval)) return;
	// Pressures of a ramp are known to its increment in any case.
	const bool atRest = waterExcess <= math::max(restingExcess * capillaryPressure(), pressureIncrement)
	        && wallsAtRest() && unbalanced() < unbalancedTolerance;
	if (!atRest && static_cast<int>(scene->iter) - levelStart < maxLevelSteps) return;
	closeLevel(atRest);
}

void GasInvasionEngine::closeLevel(bool balanced)
{
	gasSaturation = saturation();
	syncContents();
	Vector6r numbers;
	const auto moved = displacements();
	numbers << gasPressure, gasSaturation, unbalanced(), largestLoaded(moved, rattlersNow()),
	        *std::max_element(moved.begin(), moved.end()), thickness * contents.totalGas();
	levelNumbers.push_back(numbers);
	levelCounts.push_back(Vector3i(static_cast<int>(scene->iter), countBroken(), balanced ? 1 : 0));
	++level;
	levelStart = static_cast<int>(scene->iter);
	if (historyInterval == 0) recordHistory();
	nextPressure();
}

bool GasInvasionEngine::levelDue() const
{
	if (control != GasControl::rate) return true;
	// The pressure moves by itself: a level is what is at rest after it moved by an increment.
	return pressureIncrement > 0
	        && (levelNumbers.empty() || math::abs(gasPressure - levelNumbers.back()[0]) >= pressureIncrement);
}

void GasInvasionEngine::nextPressure()
{
	if (control == GasControl::rate) return;
	if (control == GasControl::reservoir)
		rampDone = true; // at rest, and nothing more to come
	else if (!pressureProgram.empty())
		followProgram();
	else if (pressureIncrement <= 0 || gasPressure >= maxPressure)
		endRamp();
	else
		gasPressure = math::min(gasPressure + pressureIncrement, maxPressure);
}

void GasInvasionEngine::endRamp()
{
	rampDone = true;
	rampEnd = { gasPressure, maxPressure, pressureIncrement };
}

/// A ramp whose end was moved up goes on, and so does a held pressure that was changed. Called after loading, too,
/// which changes nothing.
void GasInvasionEngine::goOnWhereChanged()
{
	if (!rampDone || pressureFollows() || !pressureProgram.empty() || gasPressure >= maxPressure) return;
	if (rampEnd != Vector3r(gasPressure, maxPressure, pressureIncrement)) rampDone = false;
}

void GasInvasionEngine::followProgram()
{
	const int nPoints = static_cast<int>(pressureProgram.size());
	while (programPosition < nPoints && gasPressure == pressureProgram[programPosition])
		++programPosition;
	if (programPosition == nPoints) {
		rampDone = true;
		return;
	}
	const Real target = pressureProgram[programPosition], way = target - gasPressure;
	gasPressure =
	        math::abs(way) <= pressureIncrement ? target : gasPressure + std::copysign(pressureIncrement, way);
}

Real GasInvasionEngine::saturation() const
{
	if (!drained()) return gasSaturation; // of the last step
	const auto voids = currentVoids();
	Real gas = 0, all = 0;
	for (std::size_t c = 0; c < voids.size(); ++c) {
		all += voids[c];
		gas += contents.phase[c] == capfrac::Phase::gas && !contents.held[c] ? voids[c] - contents.water[c]
		                                                                     : contents.gas[c];
	}
	return gas / all;
}

} // namespace yade
