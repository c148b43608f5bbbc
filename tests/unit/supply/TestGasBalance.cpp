// SPDX-License-Identifier: GPL-2.0-or-later
/// supply/GasBalance: p V = const, the water that gives way and comes back, the mass in all states.

#include "supply/GasBalance.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	/// rho = 2e-5 p.
	EquationOfState simple()
	{
		EquationOfState gas;
		gas.molarMass = 2e-5 * 8.31446261815324 * gas.temperature;
		return gas;
	}

	EquationOfState table()
	{
		EquationOfState gas;
		gas.law = GasLaw::tabulated;
		gas.pressures = { 1e5, 2e5, 4e5 };
		gas.densities = { 2, 5, 7 };
		return gas;
	}

} // namespace

TEST(GasBalance, IdealGasKeepsPressureTimesVolume)
{
	for (double reservoir : { 0.0, 0.5, 3.0 })
		for (double pores : { 0.25, 1.0 }) {
			const auto balance = balanceGas(simple(), 4, reservoir, pores, 1e4);
			EXPECT_DOUBLE_EQ(balance.pressure * (reservoir + pores), 4 / 2e-5);
			EXPECT_EQ(balance.share, 1);
		}
}

TEST(GasBalance, WaterFillsWhatTheGasCannot)
{
	// 4 kg at 1e5 Pa are 2 m^3; with 1.5 m^3 of reservoir half a cubic metre of the pores.
	const auto balance = balanceGas(simple(), 4, 1.5, 2, 1e5);
	EXPECT_EQ(balance.pressure, 1e5);
	EXPECT_DOUBLE_EQ(balance.density, 2);
	EXPECT_DOUBLE_EQ(balance.share, 0.25);
	EXPECT_DOUBLE_EQ(balanceGas(simple(), 4, 0, 8, 1e5).share, 0.25);
	EXPECT_EQ(balanceGas(simple(), 4, 3, 2, 1e5).share, 0) << "the reservoir alone would hold more";
}

TEST(GasBalance, IsContinuousWhereTheWaterBeginsToComeBack)
{
	// Both branches meet at M = rho(p_w) V; a step of 1e-9 in the room moves pressure and share by as much.
	for (const auto& gas : { simple(), table() }) {
		const double mass = gasDensity(gas, 1.5e5) * 3;
		const auto full = balanceGas(gas, mass, 1, 2 - 1e-9, 1.5e5),
		           part = balanceGas(gas, mass, 1, 2 + 1e-9, 1.5e5);
		EXPECT_NEAR(full.pressure / part.pressure, 1, 1e-9);
		EXPECT_NEAR(part.share, 1, 1e-9);
		EXPECT_GE(full.pressure, 1.5e5);
	}
}

TEST(GasBalance, MassIsDensityTimesVolumeAlways)
{
	for (const auto& gas : { simple(), table() })
		for (double pores : { 0.1, 0.7, 2.0, 9.0 }) {
			const auto balance = balanceGas(gas, 4, 0.6, pores, 1.2e5);
			EXPECT_NEAR(balance.density * (0.6 + balance.share * pores), 4, 1e-14 * 4);
			EXPECT_NEAR(gasDensity(gas, balance.pressure), balance.density, 1e-14 * balance.density);
		}
}

TEST(GasBalance, RefusesNoRoomAndWhatTheTableDoesNotHold)
{
	EXPECT_THROW(balanceGas(simple(), 1, 0, 0, 1e5), GasLawError);
	EXPECT_THROW(balanceGas(simple(), 1, 0, -1e-9, 1e5), GasLawError);
	EXPECT_THROW(balanceGas(table(), 8, 0.5, 0.5, 1e5), GasLawError) << "denser than the last pair";
	EXPECT_THROW(balanceGas(simple(), 1, 1, 1, 0), GasLawError) << "water without pressure";
}

} // namespace capfrac
