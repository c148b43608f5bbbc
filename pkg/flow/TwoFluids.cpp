// SPDX-License-Identifier: GPL-2.0-or-later
#include "TwoFluids.hpp"
#include "FlowNetwork.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace capfrac {

namespace {

	[[noreturn]] void refuse(const std::string& what, double value, const std::string& allowed, int pore = -1)
	{
		std::ostringstream text;
		text.precision(10);
		text << what << " = " << value << ", allowed: " << allowed;
		throw FlowError(text.str(), pore);
	}

	bool positive(double value) { return value > 0 && std::isfinite(value); }

	bool notNegative(double value) { return value >= 0 && std::isfinite(value); }

	bool isFinite(const FluidHeads& head) { return std::isfinite(head.water) && std::isfinite(head.gas); }

	void checkPore(int i, const TwoFluidPore& pore)
	{
		// Names are put together only when something is wrong: this runs every step.
		const auto named = [&](const char* what) { return "pore " + std::to_string(i) + ": " + what; };
		if (!positive(pore.volume)) refuse(named("volume [m^3]"), pore.volume, "> 0", i);
		if (!notNegative(pore.water)) refuse(named("water [m^3]"), pore.water, ">= 0", i);
		if (!notNegative(pore.gas)) refuse(named("gas [m^3]"), pore.gas, ">= 0", i);
		if (!notNegative(pore.held)) refuse(named("held pressure [Pa]"), pore.held, ">= 0", i);
		if (!notNegative(pore.bodyPressure))
			refuse(named("capillary pressure in the body [Pa]"), pore.bodyPressure, ">= 0", i);
		if (!std::isfinite(pore.pressure)) refuse(named("pressure [Pa]"), pore.pressure, "a finite number", i);
		if (!isFinite(pore.head))
			refuse(named("head [Pa]"), std::isfinite(pore.head.water) ? pore.head.gas : pore.head.water,
			        "a finite number", i);
		if (!std::isfinite(pore.source)) refuse(named("source [m^3/s]"), pore.source, "a finite number", i);
		if (pore.fixedPressure && !std::isfinite(*pore.fixedPressure))
			refuse(named("prescribed pressure [Pa]"), *pore.fixedPressure, "a finite number", i);
	}

} // namespace

void checkTwoFluids(const TwoFluids& fluids)
{
	if (!positive(fluids.waterBulkModulus))
		refuse("bulk modulus of the water [Pa]", fluids.waterBulkModulus, "finite and > 0");
	if (!positive(fluids.waterViscosity))
		refuse("viscosity of the water [Pa s]", fluids.waterViscosity, "finite and > 0");
	if (!positive(fluids.gasViscosity))
		refuse("viscosity of the gas [Pa s]", fluids.gasViscosity, "finite and > 0");
	if (!positive(fluids.datum))
		refuse("absolute pressure at gauge pressure zero [Pa]", fluids.datum, "finite and > 0");
	if (const auto& law = gasLaws()[fluids.gas.law]; !law.compressible)
		throw FlowError("equation of state of the gas: '" + std::string(law.name)
		        + "', allowed: " + compressibleGasLaws(", ") + " (its pressure has to follow from its mass)");
	checkEquationOfState(fluids.gas);
}

void checkTwoFluidNetwork(const TwoFluidNetwork& network)
{
	checkTwoFluids(network.fluids);
	const int n = static_cast<int>(network.pores.size());
	for (int i = 0; i < n; ++i)
		checkPore(i, network.pores[i]);
	for (std::size_t t = 0; t < network.throats.size(); ++t) {
		const auto& throat = network.throats[t];
		if (throat.a >= 0 && throat.a < n && throat.b >= 0 && throat.b < n && throat.a != throat.b
		        && notNegative(throat.conductance) && notNegative(throat.entryPressure)
		        && isFinite(throat.head))
			continue;
		const std::string name = "throat " + std::to_string(t) + ": ";
		if (!notNegative(throat.conductance))
			refuse(name + "conductance times viscosity [m^3]", throat.conductance, ">= 0");
		if (!notNegative(throat.entryPressure))
			refuse(name + "entry pressure [Pa]", throat.entryPressure, ">= 0");
		if (!isFinite(throat.head))
			refuse(name + "head [Pa]",
			        std::isfinite(throat.head.water) ? throat.head.gas : throat.head.water,
			        "a finite number");
		throw FlowError(name + "joins pores " + std::to_string(throat.a) + " and " + std::to_string(throat.b)
		        + ", allowed: two different ones of " + std::to_string(n));
	}
	if (!notNegative(network.filmConductance))
		refuse("conductance of films [m^3/(Pa s)]", network.filmConductance, ">= 0");
	if (!std::isfinite(network.filmPressure))
		refuse("pressure at the end of films [Pa]", network.filmPressure, "a finite number");
}

double gasRatio(const TwoFluids& fluids, double pressure)
{
	return gasDensity(fluids.gas, fluids.datum + pressure) / gasDensity(fluids.gas, fluids.datum);
}

double gasRatioDerivative(const TwoFluids& fluids, double pressure)
{
	return gasDensityDerivative(fluids.gas, fluids.datum + pressure) / gasDensity(fluids.gas, fluids.datum);
}

double waterVolume(const TwoFluids& fluids, double amount, double pressure)
{
	return amount / (1 + pressure / fluids.waterBulkModulus);
}

double gasVolume(const TwoFluids& fluids, double amount, double pressure)
{
	return amount == 0 ? 0 : amount / gasRatio(fluids, pressure);
}

double storageOf(const TwoFluids& fluids, double water, double gas, double pressure, double held)
{
	const double squeezed = 1 + pressure / fluids.waterBulkModulus;
	const double ofWater = water / (fluids.waterBulkModulus * squeezed * squeezed);
	if (gas == 0) return ofWater;
	const double ratio = gasRatio(fluids, pressure + held);
	return ofWater + gas * gasRatioDerivative(fluids, pressure + held) / (ratio * ratio);
}

std::vector<std::uint8_t> lockedPores(const TwoFluidNetwork& network)
{
	FlowNetwork water;
	water.pores.resize(network.pores.size());
	for (std::size_t i = 0; i < network.pores.size(); ++i)
		if (!network.pores[i].isGas) water.pores[i].fixedPressure = network.pores[i].fixedPressure;
	for (const auto& t : network.throats)
		if (!network.pores[t.a].isGas && !network.pores[t.b].isGas)
			water.throats.push_back({ t.a, t.b, t.conductance });
	const auto clusters = findClusters(water);
	std::vector<std::uint8_t> locked;
	for (std::size_t i = 0; i < network.pores.size(); ++i)
		locked.push_back(!network.pores[i].isGas && !clusters.grounded[clusters.ofPore[i]]);
	return locked;
}

double waterExcess(const TwoFluidNetwork& network)
{
	double low = std::numeric_limits<double>::infinity(), high = -low;
	for (const auto& pore : network.pores) {
		if (pore.isGas) continue;
		if (pore.source != 0) return 0;
		if (pore.fixedPressure)
			low = std::min(low, *pore.fixedPressure - pore.head.water),
			high = std::max(high, *pore.fixedPressure - pore.head.water);
	}
	if (low > high) return 0;
	const auto locked = lockedPores(network);
	double sum = 0, volume = 0;
	for (std::size_t i = 0; i < network.pores.size(); ++i) {
		const auto& pore = network.pores[i];
		if (pore.isGas || locked[i]) continue;
		const double p = pore.pressure - pore.head.water;
		sum += pore.volume * std::max({ 0.0, low - p, p - high });
		volume += pore.volume;
	}
	return volume > 0 ? sum / volume : 0;
}

double gasShare(const TwoFluids& fluids, const TwoFluidPore& pore)
{
	return std::clamp(gasVolume(fluids, pore.gas, pore.pressure + pore.held) / pore.volume, 0.0, 1.0);
}

} // namespace capfrac
