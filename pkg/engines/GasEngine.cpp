// SPDX-License-Identifier: GPL-2.0-or-later
#include "GasEngine.hpp"

#include <algorithm>

namespace yade {

YADE_PLUGIN((GasEngine));
CREATE_LOGGER(GasEngine);

namespace {

	/// Excess of the water's pressure that still counts as rest, over the capillary pressure [-]: so far a pressure
	/// at which gas enters may be off.
	constexpr Real restingExcess = 0.01;
	/// Steps between two looks whether the grains are at rest: a look costs about as much as the rest of the
	/// engine.
	constexpr int checkPeriod = 10;

} // namespace

capfrac::GasModel& GasEngine::invasion()
{
	throw std::logic_error(getClassName() + ": use GasInvasionEngine or ViscousInvasionEngine, which move the gas");
}

capfrac::SupplyOptions GasEngine::supplyOptions() const
{
	if (!gasLaw) capfrac::refuseAttribute("gasLaw", "None", "an object such as IdealGas()");
	if (!supply) capfrac::refuseAttribute("supply", "None", "an object such as RateSupply()");
	auto options = supply->options();
	options.gas = gasLaw->equation(), options.lawName = gasLaw->getClassName();
	options.pressureDatum = pressureDatum;
	return options;
}

capfrac::LevelOptions GasEngine::levelOptions() const
{
	return { pressureIncrement, maxPressure, supply->turningPoints(), unbalancedTolerance, restDisplacement,
		minLevelSteps, maxLevelSteps, stepsBetweenInvasions() };
}

capfrac::GasOptions GasEngine::gasOptions() const
{
	capfrac::GasOptions options;
	options.tension = interfacialTension, options.contactAngle = contactAngle;
	options.law = capfrac::entryLawFromName(entryLaw);
	options.waterPressure = waterPressure;
	options.inlet = { inletWall, inletFrom, inletTo, {} };
	for (const auto& p : inletPoints)
		options.inlet.points.push_back({ p[0], p[1] });
	options.outletWall = outletWall;
	options.supply = supplyOptions(), options.levels = levelOptions();
	options.waterDensity = fluidDensity, options.gasDensity = gasDensity;
	options.gravity = { gravity[0], gravity[1] };
	options.filmConductance = filmConductance, options.openingThreshold = openingThreshold;
	options.historyInterval = historyInterval, options.checkInvariants = checkInvariants;
	return options;
}

void GasEngine::checkAttributes() const
{
	PoreNetworkEngine::checkAttributes();
	capfrac::requireFinite("gasPressure [Pa]", gasPressure);
	const auto options = gasOptions();
	capfrac::checkOptions(options);
	checkGas(options);
}

void GasEngine::tell()
{
	PoreNetworkEngine::tell();
	auto& gas = invasion();
	gas.gas = gasOptions();
	gas.gasPressure = gasPressure;
	gas.levels.follow(gas.gas.levels, gas.gas.supply, gasPressure);
}

const capfrac::Levels& GasEngine::levelsNow()
{
	tell();
	return invasion().levels;
}

void GasEngine::show()
{
	const auto& gas = invasion();
	gasPressure = gas.gasPressure;
	inletFrom = gas.gas.inlet.from, inletTo = gas.gas.inlet.to;
}

void GasEngine::started()
{
	census->start(*scene, *reader);
	noteBreakthrough();
	warnOfSupply();
}

/// What the grains were when gas reached the outlet, in this step.
void GasEngine::noteBreakthrough()
{
	auto& then = census->breakthrough;
	if (invasion().breakthrough.iteration < 0 || then.broken >= 0) return;
	then.broken = census->countBroken(*scene);
	then.displacements = invasion().displacements(*network);
	then.rattlers = yade::rattlersNow(*scene, *reader);
	then.displacement = census->largestLoaded(*reader, then.displacements, then.rattlers);
}

// --- levels ---------------------------------------------------------------------------------------

void GasEngine::finishStep()
{
	noteBreakthrough();
	brakeLooseGrains(*scene, *this, *reader);
	const int iter = static_cast<int>(scene->iter);
	if (historyInterval > 0 && iter % historyInterval == 0) recordHistory();
	const auto& gas = invasion();
	const auto& levels = gas.levels;
	if (levels.done || iter % checkPeriod != 0 || !levels.due(gas.gas.levels, gas.gas.supply, gasPressure)) return;
	if (iter - std::max(levels.start, gas.lastEvent) < std::max(minLevelSteps, stepsBetweenInvasions())) return;
	// Pressures of a ramp are known to its increment in any case.
	const Real excess = math::max(restingExcess * gas.capillaryPressure(), pressureIncrement);
	const bool atRest = gas.waterExcess <= excess
	        && wallsAtRest(*scene, *reader, restDisplacement * network->smallestRadius(), minLevelSteps)
	        && unbalanced(*scene, *this, *reader) < unbalancedTolerance;
	if (!atRest && iter - levels.start < maxLevelSteps) return;
	closeLevel(atRest);
}

void GasEngine::closeLevel(bool balanced)
{
	auto& gas = invasion();
	gas.gasSaturation = gas.saturation(*network);
	if (gas.drained()) network->syncContents();
	const auto moved = gas.displacements(*network);
	capfrac::Level level;
	level.pressure = gasPressure, level.saturation = gas.gasSaturation;
	level.unbalanced = unbalanced(*scene, *this, *reader);
	level.displacement = census->largestLoaded(*reader, moved, yade::rattlersNow(*scene, *reader));
	level.displacementWithRattlers = *std::max_element(moved.begin(), moved.end());
	level.gasVolume = thickness * network->contents.totalGas();
	level.iteration = static_cast<int>(scene->iter);
	level.brokenBonds = census->countBroken(*scene), level.atRest = balanced;
	gas.levels.closed.push_back(level);
	if (historyInterval == 0) recordHistory();
	gas.levels.next(gas.gas.levels, gas.gas.supply, gas.gasPressure, static_cast<int>(scene->iter));
	show();
}

void GasEngine::recordHistory()
{
	auto& gas = invasion();
	if (!gas.history.wants()) return;
	capfrac::HistoryRow row;
	row.time = scene->time, row.iteration = static_cast<int>(scene->iter);
	row.gasPressure = gasPressure, row.connectedVolume = gas.connectedGas(*network);
	row.mass = gas.injectedMass(*network), row.saturation = gas.saturation(*network);
	row.brokenBonds = census->countBroken(*scene), row.level = static_cast<int>(gas.levels.closed.size());
	gas.history.add(row);
}

// --- warnings -------------------------------------------------------------------------------------

Real GasEngine::risePerPeriod()
{
	const auto& gas = invasion();
	const auto& from = gas.gas.supply;
	if (from.rate == 0) return 0;
	const Real slope = capfrac::gasDensityDerivative(from.gas, gasPressure + from.pressureDatum);
	return from.rate * periodOfGrains(*scene, *reader)
	        / (slope * (from.reservoirVolume + gas.connectedGas(*network)));
}

/// Two ways to ask too much of a quasi-static model; neither is an error.
void GasEngine::warnOfSupply()
{
	const auto& gas = invasion();
	const auto& from = gas.gas.supply;
	if (!gas.drained() || !from.pressureFollows()) return;
	const Real threshold = math::max(gas.capillaryPressure(), gas.nextEntryPressure(*network));
	if (!std::isfinite(threshold)) return; // the gas is everywhere
	const Real entered = waterPressure + threshold;
	if (from.gas.law == capfrac::GasLaw::tabulated && entered + pressureDatum > from.gas.pressures.back()) {
		LOG_WARN("TabulatedGas.table ends at " << from.gas.pressures.back() << " Pa, the gas enters at "
		                                       << entered + pressureDatum
		                                       << " Pa (absolute): the run will stop at the end of the table");
		return;
	}
	const Real rise = risePerPeriod();
	if (from.control == capfrac::GasControl::rate && rise > 1e-3 * threshold)
		LOG_WARN("RateSupply.rate = "
		        << from.rate << " kg/s raises the pressure by " << rise
		        << " Pa within a period of a grain, more than a thousandth of the " << threshold
		        << " Pa at which the gas enters: the grains do not stay near rest. A rate of up to "
		        << from.rate * 1e-3 * threshold / rise << " kg/s, or a larger reservoirVolume, lets them");
	const Real volume = from.reservoirVolume + gas.connectedGas(*network);
	const Real pore = network->books.initialVoid / network->domains.count;
	if (from.densityAt(entered) * volume < from.densityAt(waterPressure) * (volume + pore))
		LOG_WARN("the gas behind the inlet, "
		        << volume << " m³ with the reservoir, cannot fill a mean pore of " << pore
		        << " m³ before its pressure falls to the water's: each pore will fill at "
		           "the rate of the supply. A larger reservoirVolume changes that");
}

} // namespace yade
