/// Pressures of GasInvasionEngine, and when they rise.

#include "GasInvasionEngine.hpp"

#include <algorithm>

namespace yade {

std::vector<double> GasInvasionEngine::cellPressures() const
{
	if (!drained()) return SinglePhaseFlowEngine::cellPressures();
	std::vector<double> pressure(mesh.cells.size());
	for (std::size_t c = 0; c < pressure.size(); ++c)
		pressure[c] = contents.phase[c] == capfrac::Phase::gas ? pressureOfGas(static_cast<int>(c)) : waterPressure;
	return pressure;
}

void GasInvasionEngine::finishStep()
{
	constexpr int checkPeriod = 10; // the check costs about as much as the rest of the engine
	if (rampDone || scene->iter % checkPeriod != 0) return;
	const int steps = static_cast<int>(scene->iter) - std::max(levelStart, lastEventIter);
	if (steps < std::max(minLevelSteps, invasionInterval)) return;
	scene->forces.sync();
	const bool atRest = wallsAtRest() && unbalanced() < unbalancedTolerance;
	if (!atRest && static_cast<int>(scene->iter) - levelStart < maxLevelSteps) return;
	closeLevel(atRest);
}

void GasInvasionEngine::closeLevel(bool balanced)
{
	gasSaturation = saturation();
	syncContents();
	Vector6r numbers;
	numbers << gasPressure, gasSaturation, unbalanced(), largestDisplacement(false), largestDisplacement(true), thickness * contents.totalGas();
	levelNumbers.push_back(numbers);
	levelCounts.push_back(Vector3i(static_cast<int>(scene->iter), countBroken(), balanced ? 1 : 0));
	++level;
	levelStart = static_cast<int>(scene->iter);
	if (pressureIncrement <= 0 || gasPressure >= maxPressure) rampDone = true;
	else
		gasPressure = math::min(gasPressure + pressureIncrement, maxPressure);
}

Real GasInvasionEngine::saturation() const
{
	if (!drained()) return gasSaturation; // of the last step
	const auto voids = currentVoids();
	Real       gas = 0, all = 0;
	for (std::size_t c = 0; c < voids.size(); ++c) {
		all += voids[c];
		gas += contents.phase[c] == capfrac::Phase::gas ? voids[c] - contents.water[c] : contents.gas[c];
	}
	return gas / all;
}

} // namespace yade
