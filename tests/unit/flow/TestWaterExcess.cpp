// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/TwoFluids: how far water is from rest, by hand.

#include "TwoFluidNetworks.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	/// Water in a row of pores of volumes 1, 2, 1, the last held at zero; then gas, and water behind it that is cut
	/// off.
	TwoFluidNetwork row()
	{
		TwoFluidNetwork network;
		network.fluids = samples::stiffFluids();
		for (double volume : { 1.0, 2.0, 1.0 })
			network.pores.push_back(samples::waterPore(network.fluids, volume));
		network.pores.push_back(samples::gasPore(network.fluids, 1, 5));
		network.pores.push_back(samples::waterPore(network.fluids, 7, 100));
		network.pores[2].fixedPressure = 0.0;
		for (int i = 0; i < 4; ++i)
			network.throats.push_back({ i, i + 1, 1, 10 });
		network.pores[0].pressure = 3, network.pores[1].pressure = -6;
		return network;
	}

} // namespace

TEST(WaterExcess, IsTheMeanDistanceFromThePrescribedPressure)
{
	const auto network = row();
	EXPECT_EQ(lockedPores(network), (std::vector<std::uint8_t> { 0, 0, 0, 0, 1 }));
	EXPECT_DOUBLE_EQ(waterExcess(network), (1 * 3 + 2 * 6 + 1 * 0) / 4.0);
}

TEST(WaterExcess, IsNoneOnTheWayFromOnePrescribedPressureToAnother)
{
	auto network = row();
	network.pores[0].fixedPressure = 3.0;
	network.pores[1].pressure = 1;
	EXPECT_DOUBLE_EQ(waterExcess(network), 0);
	network.pores[1].pressure = 5;
	EXPECT_DOUBLE_EQ(waterExcess(network), 2 * 2 / 4.0);
}

TEST(WaterExcess, IsNoneAtRestUnderWeight)
{
	auto network = row();
	for (int i = 0; i < 3; ++i)
		network.pores[i].pressure = network.pores[i].head.water = 10 * i;
	network.pores[2].fixedPressure = 20.0;
	EXPECT_DOUBLE_EQ(waterExcess(network), 0);
}

TEST(WaterExcess, IsUnknownWithoutAnOutletAndWithSources)
{
	auto network = row();
	network.pores[1].source = 1;
	EXPECT_DOUBLE_EQ(waterExcess(network), 0);
	network = row();
	network.pores[2].fixedPressure.reset();
	EXPECT_DOUBLE_EQ(waterExcess(network), 0);
}

} // namespace capfrac
