// SPDX-License-Identifier: GPL-2.0-or-later
#include "FlowNetwork.hpp"

#include "../network/UnionFind.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace capfrac {

namespace {

	[[noreturn]] void refuse(const std::string& what, double value, const char* allowed, int pore = -1)
	{
		std::ostringstream text;
		text.precision(10);
		text << what << " = " << value << ", allowed: " << allowed;
		throw FlowError(text.str(), pore);
	}

	void checkFinite(const std::string& what, double value, int pore)
	{
		if (!std::isfinite(value)) refuse(what, value, "a finite number", pore);
	}

	void checkPore(const FlowNetwork& network, std::size_t i)
	{
		const FlowPore& pore = network.pores[i];
		// Names are put together only when something is wrong: this runs every step.
		if (pore.volume > 0 && std::isfinite(pore.volume) && std::isfinite(pore.mass)
		        && std::isfinite(pore.source) && std::isfinite(pore.fixedPressure.value_or(0)))
			return;
		const std::string name = "pore " + std::to_string(i) + ": ";
		if (!(pore.volume > 0 && std::isfinite(pore.volume)))
			refuse(name + "volume [m^3]", pore.volume, "> 0", static_cast<int>(i));
		checkFinite(name + "mass [m^3]", pore.mass, static_cast<int>(i));
		checkFinite(name + "source [m^3/s]", pore.source, static_cast<int>(i));
		checkFinite(name + "fixed pressure [Pa]", pore.fixedPressure.value_or(0), static_cast<int>(i));
	}

	void checkConductance(const char* what, std::size_t index, double value)
	{
		if (value >= 0 && std::isfinite(value)) return;
		refuse(what + std::to_string(index) + ": conductance [m^3/(Pa s)]", value, ">= 0");
	}

	void checkEnd(const char* what, std::size_t index, int pore, std::size_t nPores)
	{
		if (pore >= 0 && static_cast<std::size_t>(pore) < nPores) return;
		refuse(what + std::to_string(index) + ": pore", pore,
		        ("0 to " + std::to_string(static_cast<long>(nPores) - 1)).c_str());
	}

	void checkBulkModulus(double bulkModulus)
	{
		if (!(bulkModulus > 0))
			refuse("bulk modulus of the fluid [Pa]", bulkModulus, "> 0 (infinity: incompressible)");
	}

} // namespace

void checkFluid(double bulkModulus, double viscosity)
{
	checkBulkModulus(bulkModulus);
	if (!(viscosity > 0 && std::isfinite(viscosity))) refuse("viscosity [Pa s]", viscosity, "> 0");
}

void checkNetwork(const FlowNetwork& network)
{
	checkBulkModulus(network.bulkModulus);
	const std::size_t n = network.pores.size();
	for (std::size_t i = 0; i < n; ++i)
		checkPore(network, i);
	for (std::size_t t = 0; t < network.throats.size(); ++t) {
		const FlowThroat& throat = network.throats[t];
		checkEnd("throat ", t, throat.a, n);
		checkEnd("throat ", t, throat.b, n);
		if (throat.a == throat.b)
			throw FlowError("throat " + std::to_string(t) + ": joins pore " + std::to_string(throat.a)
			        + " to itself");
		checkConductance("throat ", t, throat.conductance);
	}
	for (std::size_t l = 0; l < network.links.size(); ++l) {
		checkEnd("boundary link ", l, network.links[l].pore, n);
		checkConductance("boundary link ", l, network.links[l].conductance);
		if (!std::isfinite(network.links[l].pressure))
			refuse("boundary link " + std::to_string(l) + ": pressure [Pa]", network.links[l].pressure,
			        "a finite number");
	}
}

double massAt(double pressure, double volume, double bulkModulus) { return volume * (1 + pressure / bulkModulus); }

std::vector<double> pressuresOf(const FlowNetwork& network)
{
	if (network.incompressible())
		throw FlowError("the mass of an incompressible fluid says nothing about its pressure");
	std::vector<double> pressure;
	pressure.reserve(network.pores.size());
	// m - V first: m/V - 1 would lose the digits that a stiff fluid lives on twice.
	for (const FlowPore& pore : network.pores)
		pressure.push_back(pore.fixedPressure
		                ? *pore.fixedPressure
		                : network.bulkModulus * ((pore.mass - pore.volume) / pore.volume));
	return pressure;
}

double totalMass(const FlowNetwork& network)
{
	double sum = 0;
	for (const FlowPore& pore : network.pores)
		sum += pore.mass;
	return sum;
}

FlowClusters findClusters(const FlowNetwork& network)
{
	const int n = static_cast<int>(network.pores.size());
	UnionFind sets(n);
	for (const FlowThroat& throat : network.throats)
		if (throat.conductance > 0) sets.join(throat.a, throat.b);
	FlowClusters clusters;
	clusters.ofPore.resize(n);
	// The smallest pore represents its set, so that it comes first here.
	for (int i = 0; i < n; ++i) {
		if (sets.find(i) == i) {
			clusters.ofPore[i] = clusters.count++;
			clusters.first.push_back(i);
		} else
			clusters.ofPore[i] = clusters.ofPore[sets.find(i)];
	}
	clusters.grounded.assign(clusters.count, 0);
	for (int i = 0; i < n; ++i)
		if (network.pores[i].fixedPressure) clusters.grounded[clusters.ofPore[i]] = 1;
	for (const BoundaryLink& link : network.links)
		if (link.conductance > 0) clusters.grounded[clusters.ofPore[link.pore]] = 1;
	return clusters;
}

void checkGrounded(
        const FlowNetwork& network, const FlowClusters& clusters, const std::vector<std::uint8_t>& freeVolume)
{
	if (!network.incompressible()) return;
	auto floats = [&](int c) { return !clusters.grounded[c] && (freeVolume.empty() || !freeVolume[c]); };
	int cluster = 0;
	while (cluster < clusters.count && !floats(cluster))
		++cluster;
	if (cluster == clusters.count) return;
	const bool anywhere =
	        std::any_of(clusters.grounded.begin(), clusters.grounded.end(), [](std::uint8_t g) { return g != 0; });
	if (!anywhere)
		throw FlowError("incompressible flow without a pressure anywhere: fix one, link a pore to the outside, "
		                "or give the "
		                "fluid a finite bulk modulus");
	const auto size = std::count(clusters.ofPore.begin(), clusters.ofPore.end(), cluster);
	throw FlowError("pore " + std::to_string(clusters.first[cluster])
	                + ": its cluster (pores: " + std::to_string(size)
	                + ") is cut off from every boundary with a pressure, which leaves the pressure of an "
	                  "incompressible fluid undetermined",
	        clusters.first[cluster]);
}

} // namespace capfrac
