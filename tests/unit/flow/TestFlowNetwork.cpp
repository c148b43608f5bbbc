// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/FlowNetwork: masses and pressures, clusters, what is refused and how it is said.

#include "FlowNetworks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace capfrac {

namespace {

	using namespace samples;

	/// Pores of volume one in a row, full at pressure zero, throats of conductance one between them.
	FlowNetwork row(int n, double bulkModulus)
	{
		FlowNetwork network;
		network.bulkModulus = bulkModulus;
		for (int i = 0; i < n; ++i) {
			network.pores.push_back({ 1, 1, 0, {} });
			if (i > 0) network.throats.push_back({ i - 1, i, 1 });
		}
		return network;
	}

	/// The message for a row of three pores after `spoil`.
	template <class Spoil> std::string messageAfter(Spoil spoil)
	{
		FlowNetwork network = row(3, 2e9);
		spoil(network);
		return messageOf([&] { checkNetwork(network); });
	}

} // namespace

TEST(FlowNetwork, MassAndPressureAreInverse)
{
	FlowNetwork network = row(3, 2.2e9);
	const double volume[] { 3e-9, 1, 2e4 }, pressure[] { 1e5, -3e4, 0 };
	for (int i = 0; i < 3; ++i)
		network.pores[i].volume = volume[i],
		network.pores[i].mass = massAt(pressure[i], volume[i], network.bulkModulus);
	const auto found = pressuresOf(network);
	// m is V (1 + p/K) rounded: 2 eps of it make 2 eps K of pressure, about 1e-6 Pa.
	for (int i = 0; i < 3; ++i)
		EXPECT_NEAR(found[i], pressure[i], 2 * 2.3e-16 * 2.2e9);
	EXPECT_EQ(massAt(1e5, 3, infinite), 3);
	network.pores[1].fixedPressure = 77;
	EXPECT_EQ(pressuresOf(network)[1], 77);
	EXPECT_DOUBLE_EQ(totalMass(row(3, 1)), 3);
}

TEST(FlowNetwork, ClustersAreJoinedByOpenThroatsOnly)
{
	FlowNetwork network = row(6, 1);
	network.throats[1].conductance = 0; // 0 1 | 2 3 4 | 5
	network.throats[4].conductance = 0;
	network.links = { { 3, 0, 1 }, { 5, 0, 0 } };
	const auto clusters = findClusters(network);
	EXPECT_EQ(clusters.count, 3);
	EXPECT_EQ(clusters.ofPore, (std::vector<int> { 0, 0, 1, 1, 1, 2 }));
	EXPECT_EQ(clusters.first, (std::vector<int> { 0, 2, 5 }));
	EXPECT_EQ(clusters.grounded, (std::vector<std::uint8_t> { 0, 1, 0 })) << "a closed link sets no pressure";
	network.pores[1].fixedPressure = 0;
	EXPECT_EQ(findClusters(network).grounded, (std::vector<std::uint8_t> { 1, 1, 0 }));
	EXPECT_EQ(findClusters({}).count, 0);
}

TEST(FlowNetworkErrors, IncompressibleFluidNeedsAPressure)
{
	FlowNetwork network = row(4, infinite);
	auto message = [&](const std::vector<std::uint8_t>& freeVolume = {}) {
		return messageOf([&] { checkGrounded(network, findClusters(network), freeVolume); });
	};
	EXPECT_EQ(message(),
	        "incompressible flow without a pressure anywhere: fix one, link a pore to the outside, or give the "
	        "fluid a finite bulk modulus");
	EXPECT_EQ(message({ 1 }), "no FlowError") << "grains that give way set the pressure";
	network.links = { { 0, 1e5, 2 } };
	EXPECT_EQ(message(), "no FlowError");
	network.throats[1].conductance = 0;
	EXPECT_EQ(message(),
	        "pore 2: its cluster (pores: 2) is cut off from every boundary with a pressure, which leaves the "
	        "pressure of an incompressible fluid "
	        "undetermined");
	EXPECT_EQ(message({ 0, 1 }), "no FlowError");
	network.bulkModulus = 1e9;
	EXPECT_EQ(message(), "no FlowError") << "a compressible fluid keeps the pressure that it has";
	EXPECT_EQ(messageOf([] { pressuresOf(row(1, infinite)); }),
	        "the mass of an incompressible fluid says nothing about its pressure");
}

TEST(FlowNetworkErrors, NameThePoreOrThroatAndTheValue)
{
	const double nan = std::nan("");
	EXPECT_EQ(messageAfter([](FlowNetwork&) {}), "no FlowError");
	EXPECT_EQ(messageAfter([](FlowNetwork& n) { n.bulkModulus = infinite; }), "no FlowError");
	EXPECT_EQ(
	        messageAfter([](FlowNetwork& n) { n.pores[2].volume = 0; }), "pore 2: volume [m^3] = 0, allowed: > 0");
	EXPECT_EQ(messageAfter([=](FlowNetwork& n) { n.pores[1].mass = nan; }),
	        "pore 1: mass [m^3] = nan, allowed: a finite number");
	EXPECT_EQ(messageAfter([](FlowNetwork& n) { n.pores[0].source = infinite; }),
	        "pore 0: source [m^3/s] = inf, allowed: a finite number");
	EXPECT_EQ(messageAfter([=](FlowNetwork& n) { n.pores[0].fixedPressure = nan; }),
	        "pore 0: fixed pressure [Pa] = nan, allowed: a finite number");
	EXPECT_EQ(messageAfter([=](FlowNetwork& n) { n.throats[1].conductance = nan; }),
	        "throat 1: conductance [m^3/(Pa s)] = nan, allowed: >= 0");
	EXPECT_EQ(messageAfter([](FlowNetwork& n) { n.throats[0].conductance = -2; }),
	        "throat 0: conductance [m^3/(Pa s)] = -2, allowed: >= 0");
	EXPECT_EQ(messageAfter([](FlowNetwork& n) { n.throats[0].b = 3; }), "throat 0: pore = 3, allowed: 0 to 2");
	EXPECT_EQ(messageAfter([](FlowNetwork& n) { n.throats[1].a = 2; }), "throat 1: joins pore 2 to itself");
	EXPECT_EQ(messageAfter([](FlowNetwork& n) {
		n.links = { { -1, 0, 1 } };
	}),
	        "boundary link 0: pore = -1, allowed: 0 to 2");
	EXPECT_EQ(messageAfter([=](FlowNetwork& n) {
		n.links = { { 0, 0, nan } };
	}),
	        "boundary link 0: conductance [m^3/(Pa s)] = nan, allowed: >= 0");
	EXPECT_EQ(messageAfter([=](FlowNetwork& n) {
		n.links = { { 0, nan, 1 } };
	}),
	        "boundary link 0: pressure [Pa] = nan, allowed: a finite number");
	EXPECT_EQ(messageAfter([](FlowNetwork& n) { n.bulkModulus = -1e9; }),
	        "bulk modulus of the fluid [Pa] = -1000000000, allowed: > 0 (infinity: incompressible)");
	EXPECT_EQ(messageAfter([=](FlowNetwork& n) { n.bulkModulus = nan; }),
	        "bulk modulus of the fluid [Pa] = nan, allowed: > 0 (infinity: incompressible)");
}

TEST(FlowNetworkErrors, Fluid)
{
	EXPECT_EQ(messageOf([] { checkFluid(infinite, 1e-3); }), "no FlowError");
	EXPECT_EQ(messageOf([] { checkFluid(-5, 1e-3); }),
	        "bulk modulus of the fluid [Pa] = -5, allowed: > 0 (infinity: incompressible)");
	EXPECT_EQ(messageOf([] { checkFluid(1e9, -1e-3); }), "viscosity [Pa s] = -0.001, allowed: > 0");
	EXPECT_EQ(messageOf([] { checkFluid(1e9, std::nan("")); }), "viscosity [Pa s] = nan, allowed: > 0");
}

} // namespace capfrac
