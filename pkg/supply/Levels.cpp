// SPDX-License-Identifier: GPL-2.0-or-later
#include "Levels.hpp"

#include <algorithm>
#include <cmath>

namespace capfrac {

void checkOptions(const LevelOptions& o)
{
	requireNotNegative("pressureIncrement [Pa]", o.pressureIncrement);
	requireFinite("maxPressure [Pa]", o.maxPressure);
	requirePositive("unbalancedTolerance [-]", o.unbalancedTolerance);
	if (o.minSteps < 1) refuseAttribute("minLevelSteps [-]", o.minSteps, ">= 1");
	if (o.maxSteps < o.minSteps) refuseAttribute("maxLevelSteps [-]", o.maxSteps, ">= minLevelSteps");
	requirePositive("restDisplacement [-]", o.restDisplacement);
	if (o.invasionInterval < 0) refuseAttribute("invasionInterval [-]", o.invasionInterval, ">= 0");
	for (double p : o.program)
		requireFinite("PressureSupply.program [Pa]", p);
}

void checkTogether(const LevelOptions& o, const SupplyOptions& supply, double waterPressure)
{
	if (o.program.empty()) return;
	if (supply.pressureFollows())
		refuseAttribute("PressureSupply.program, points", o.program.size(),
		        "none with supply = " + nameOf(supply.control));
	if (!(o.pressureIncrement > 0))
		refuseAttribute("pressureIncrement [Pa]", o.pressureIncrement, "> 0 with a PressureSupply.program");
	for (double p : o.program)
		if (!(p >= waterPressure)) refuseAttribute("PressureSupply.program [Pa]", p, ">= waterPressure");
}

bool Levels::due(const LevelOptions& o, const SupplyOptions& supply, double gasPressure) const
{
	if (supply.control != GasControl::rate) return true;
	// The pressure moves by itself: a level is what is at rest after it moved by an increment.
	return o.pressureIncrement > 0
	        && (closed.empty() || std::abs(gasPressure - closed.back().pressure) >= o.pressureIncrement);
}

void Levels::next(const LevelOptions& o, const SupplyOptions& supply, double& gasPressure, int iteration)
{
	start = iteration;
	if (supply.control == GasControl::rate) return;
	if (supply.control == GasControl::reservoir)
		done = true; // at rest, and nothing more to come
	else if (!o.program.empty())
		followProgram(o, gasPressure);
	else if (o.pressureIncrement <= 0 || gasPressure >= o.maxPressure)
		done = true, rampEnd = { gasPressure, o.maxPressure, o.pressureIncrement };
	else
		gasPressure = std::min(gasPressure + o.pressureIncrement, o.maxPressure);
}

void Levels::followProgram(const LevelOptions& o, double& gasPressure)
{
	const int nPoints = static_cast<int>(o.program.size());
	while (programPosition < nPoints && gasPressure == o.program[programPosition])
		++programPosition;
	if (programPosition == nPoints) {
		done = true;
		return;
	}
	const double target = o.program[programPosition], way = target - gasPressure;
	gasPressure =
	        std::abs(way) <= o.pressureIncrement ? target : gasPressure + std::copysign(o.pressureIncrement, way);
}

void Levels::follow(const LevelOptions& o, const SupplyOptions& supply, double gasPressure)
{
	if (supply.control != controlFollowed) done = false;
	if (o.program != programFollowed) programPosition = 0, done = false;
	controlFollowed = supply.control, programFollowed = o.program;
	if (!done || supply.pressureFollows() || !o.program.empty() || gasPressure >= o.maxPressure) return;
	if (rampEnd != std::array<double, 3> { gasPressure, o.maxPressure, o.pressureIncrement }) done = false;
}

} // namespace capfrac
