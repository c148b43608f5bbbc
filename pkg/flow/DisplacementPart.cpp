// SPDX-License-Identifier: GPL-2.0-or-later
#include "DisplacementPart.hpp"
#include "Assembly.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace capfrac {

namespace {

	/// Of the pressures, relative to the largest there is: what is left is made up for by the next part.
	constexpr double accuracy = 1e-7;
	/// Between opening and shutting of a throat, likewise: keeps it from doing both for ever.
	constexpr double slack = 1e-9;
	constexpr int maxIterations = 60;
	/// Lowest absolute pressure of gas that is tried, over that at gauge pressure zero.
	constexpr double leastPressure = 1e-3;

} // namespace

DisplacementPart::DisplacementPart(const TwoFluidNetwork& network_, const std::vector<double>& volume_,
        const DisplacedGrains& grains_, PressureSolver& solver_)
        : network(network_)
        , volume(volume_)
        , grains(grains_)
        , softness(grains_.compression)
        , solver(solver_)
{
	std::fill(softness.lag.begin(), softness.lag.end(), 0);
	for (const auto& pore : network.pores)
		share.push_back(pore.isGas ? 1 : gasShare(network.fluids, pore));
	findBeyond();
	for (std::size_t t = 0; t < network.throats.size(); ++t)
		viscosity.push_back(viscosityIn(static_cast<int>(t)));
	if (network.filmConductance > 0) locked = lockedPores(network);
}

void DisplacementPart::moveAmounts(DisplacementTrial& trial, double h) const
{
	for (std::size_t i = 0; i < network.pores.size(); ++i) {
		const auto& pore = network.pores[i];
		trial.water[i] = pore.water + (pore.isGas ? 0 : h * pore.source);
		trial.gas[i] = pore.gas + (pore.isGas ? h * pore.source : 0);
		trial.held[i] = pore.held;
	}
	trial.films = 0;
	for (std::size_t i = 0; i < locked.size(); ++i)
		if (locked[i]) {
			const double flow =
			        network.filmConductance * std::max(0.0, excessOverFilms(trial, static_cast<int>(i)));
			trial.water[i] -= h * flow;
			trial.films += flow;
		}
	std::vector<double> lowest(network.pores.size(), -1); // capillary pressure of gas that is new to a pore
	for (std::size_t t = 0; t < network.throats.size(); ++t) {
		const auto& throat = network.throats[t];
		if (beyond[t] < 0 && !network.pores[throat.a].isGas) {
			trial.water[throat.a] -= h * trial.throatFlow[t],
			        trial.water[throat.b] += h * trial.throatFlow[t];
			continue;
		}
		if (trial.throatFlow[t] == 0) continue;
		const int from = trial.throatFlow[t] > 0 ? throat.a : throat.b;
		const double amount = h * trial.throatFlow[t] * gasRatio(network.fluids, trial.pressure[from]);
		trial.gas[throat.a] -= amount, trial.gas[throat.b] += amount;
		if (const int pore = beyond[t]; pore >= 0 && network.pores[pore].gas == 0)
			lowest[pore] = lowest[pore] < 0 ? heldBehind(static_cast<int>(t))
			                                : std::min(lowest[pore], heldBehind(static_cast<int>(t)));
	}
	for (std::size_t i = 0; i < lowest.size(); ++i)
		if (lowest[i] >= 0) trial.held[i] = lowest[i];
}

void DisplacementPart::supplyReservoirs(DisplacementTrial& trial, double h) const
{
	const auto& fluids = network.fluids;
	for (std::size_t i = 0; i < network.pores.size(); ++i) {
		const auto& pore = network.pores[i];
		trial.supply[i] = 0;
		if (!pore.fixedPressure) continue;
		const double p = trial.pressure[i];
		double& own = pore.isGas ? trial.gas[i] : trial.water[i];
		const double full = pore.isGas
		        ? (trial.volume[i] - waterVolume(fluids, trial.water[i], p)) * gasRatio(fluids, p)
		        : (trial.volume[i] - gasVolume(fluids, trial.gas[i], p + trial.held[i]))
		                * (1 + p / fluids.waterBulkModulus);
		trial.supply[i] = (full - own) / h;
		own = full;
	}
}

void DisplacementPart::evaluate(DisplacementTrial& trial, double h) const
{
	findFlows(trial);
	moveAmounts(trial, h);
	for (std::size_t i = 0; i < share.size(); ++i)
		trial.load[i] = trial.pressure[i] + share[i] * network.pores[i].held;
	trial.volume = volume;
	if (grains.skeleton) {
		const auto rates = volumeRates(grains.gradient, *grains.skeleton, trial.load, grains.dt);
		for (std::size_t i = 0; i < rates.size(); ++i)
			trial.volume[i] += h * rates[i];
		trial.growth = radiusGrowth(grains.compression, trial.load);
		addGrowth(grains.compression, trial.growth, trial.volume);
	}
	supplyReservoirs(trial, h);
}

double DisplacementPart::residual(const DisplacementTrial& trial, int i) const
{
	return trial.volume[i] - waterVolume(network.fluids, trial.water[i], trial.pressure[i])
	        - gasVolume(network.fluids, trial.gas[i], trial.pressure[i] + trial.held[i]);
}

double DisplacementPart::storage(const DisplacementTrial& trial, int i) const
{
	return storageOf(network.fluids, std::max(0.0, trial.water[i]), std::max(0.0, trial.gas[i]), trial.pressure[i],
	        trial.held[i]);
}

double DisplacementPart::scaleOf(const DisplacementTrial& trial) const
{
	double scale = 0;
	for (double p : trial.pressure)
		scale = std::max(scale, std::abs(p));
	for (std::size_t t = 0; t < beyond.size(); ++t)
		if (beyond[t] >= 0) scale = std::max(scale, network.throats[t].entryPressure);
	return scale;
}

/// Of what flows are differences of [Pa].
double DisplacementPart::sizeOf(const DisplacementTrial& trial, int i) const
{
	const auto& head = network.pores[i].head;
	return std::abs(trial.pressure[i]) + std::abs(head.water) + std::abs(head.gas);
}

std::vector<double> DisplacementPart::errors(const DisplacementTrial& trial, double h) const
{
	// What cannot be known better: sums of volumes, and flows from differences of rounded pressures.
	constexpr double roundOff = 16 * std::numeric_limits<double>::epsilon();
	std::vector<double> noise(volume.size()), error(volume.size());
	for (std::size_t i = 0; i < noise.size(); ++i)
		noise[i] = roundOff * volume[i];
	for (std::size_t t = 0; t < network.throats.size(); ++t) {
		const auto& throat = network.throats[t];
		const double flow =
		        roundOff * h * conductance(trial, t) * (sizeOf(trial, throat.a) + sizeOf(trial, throat.b));
		noise[throat.a] += flow, noise[throat.b] += flow;
	}
	for (std::size_t i = 0; i < error.size(); ++i) {
		const double left = std::abs(residual(trial, static_cast<int>(i)));
		if (!(left <= noise[i]))
			error[i] = std::isfinite(left) ? left / storage(trial, static_cast<int>(i))
			                               : std::numeric_limits<double>::infinity();
	}
	return error;
}

void DisplacementPart::correct(DisplacementTrial& trial, double h)
{
	// The flows of gas are linearized as volumes at one density: that keeps the matrix symmetric, and the pressures
	// of gas that hangs together differ little.
	FlowNetwork linear;
	linear.pores.resize(volume.size());
	for (std::size_t i = 0; i < volume.size(); ++i)
		if (network.pores[i].fixedPressure)
			linear.pores[i].fixedPressure = *network.pores[i].fixedPressure - trial.pressure[i];
	for (std::size_t t = 0; t < network.throats.size(); ++t) {
		const auto& throat = network.throats[t];
		linear.throats.push_back({ throat.a, throat.b, conductance(trial, t) });
	}
	for (std::size_t i = 0; i < locked.size(); ++i)
		if (locked[i] && excessOverFilms(trial, static_cast<int>(i)) > 0)
			linear.links.push_back({ static_cast<int>(i), 0, network.filmConductance });
	Assembly assembly(linear);
	for (std::size_t i = 0; i < volume.size(); ++i) {
		const int pore = static_cast<int>(i);
		assembly.add(pore, pore, storage(trial, pore) / h);
		assembly.addRight(pore, -residual(trial, pore) / h);
	}
	if (grains.skeleton) addMobility(assembly, grains.gradient, *grains.skeleton, grains.dt);
	assembly.addCompression(softness, h);
	FlowStep step;
	assembly.solve(solver, step);
	trial.factored += step.factored;
	for (std::size_t i = 0; i < volume.size(); ++i)
		trial.pressure[i] += step.pressure[i];
	keepOffVacuum(trial);
}

/// Water may be under tension, gas not: a Newton step from afar, or gas that enters water under tension, would leave
/// the range of the gas law.
void DisplacementPart::keepOffVacuum(DisplacementTrial& trial) const
{
	const auto atLeast = [&](int i) {
		const double p = (leastPressure - 1) * network.fluids.datum - trial.held[i];
		if (!network.pores[i].fixedPressure) trial.pressure[i] = std::max(trial.pressure[i], p);
	};
	for (std::size_t i = 0; i < volume.size(); ++i)
		if (trial.gas[i] > 0 || network.pores[i].gas > 0) atLeast(static_cast<int>(i));
	for (std::size_t t = 0; t < beyond.size(); ++t)
		if (trial.open[t]) atLeast(beyond[t]);
}

DisplacementTrial DisplacementPart::end(double h)
{
	DisplacementTrial trial;
	const std::size_t n = network.pores.size();
	for (const auto& pore : network.pores)
		trial.pressure.push_back(pore.fixedPressure.value_or(pore.pressure));
	trial.openings.assign(beyond.size(), 0);
	trial.water.resize(n), trial.gas.resize(n), trial.held.resize(n), trial.load.resize(n), trial.supply.resize(n);
	for (std::size_t t = 0; t < beyond.size(); ++t)
		trial.open.push_back(network.throats[t].advancing && beyond[t] >= 0); // gas may be on both sides by now
	for (std::size_t i = 0; i < n; ++i)
		trial.held[i] = network.pores[i].held;
	keepOffVacuum(trial);
	// Iterations count from the last throat that opened or shut: these come one by one, and there may be many.
	const int most = maxIterations + 10 * static_cast<int>(beyond.size()); // for the case that they come for ever
	for (int iteration = 0; iteration <= maxIterations && trial.iterations <= most; ++trial.iterations) {
		const double scale = scaleOf(trial);
		evaluate(trial, h);
		const auto error = errors(trial, h);
		if (*std::max_element(error.begin(), error.end()) > accuracy * scale)
			++iteration;
		else if (openAndShut(trial, slack * scale))
			iteration = 0;
		else
			return trial;
		correct(trial, h);
	}
	const auto error = errors(trial, h);
	const int worst = static_cast<int>(std::max_element(error.begin(), error.end()) - error.begin());
	std::ostringstream text;
	text << "the pressures of gas and water were not found in " << trial.iterations << " iterations: that of pore "
	     << worst << ", " << trial.pressure[worst] << " Pa, is off by about " << error[worst]
	     << " Pa; allowed: " << accuracy * scaleOf(trial) << " Pa (a shorter time step helps)";
	throw FlowError(text.str(), worst);
}

} // namespace capfrac
