// SPDX-License-Identifier: GPL-2.0-or-later
/// flow/Displacement: gas and water in small networks against closed forms, amounts, thresholds.

#include "TwoFluidNetworks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace capfrac {

using namespace samples;

namespace {

	/// A gas reservoir at `pressure`, then `n` pores of water of volume one, the last held at pressure zero.
	TwoFluidNetwork tube(const TwoFluids& fluids, int n, double pressure, double entryPressure)
	{
		TwoFluidNetwork network;
		network.fluids = fluids;
		network.pores.push_back(gasPore(fluids, 1, pressure));
		network.pores[0].fixedPressure = pressure;
		for (int i = 1; i <= n; ++i) {
			network.pores.push_back(waterPore(fluids, 1));
			network.throats.push_back({ i - 1, i, 1, entryPressure });
		}
		network.pores.back().fixedPressure = 0;
		return network;
	}

} // namespace

TEST(Displacement, GasFillsATubeAsWashburnSays)
{
	// With n throats of water ahead, the throat that gas has passed being water for the part 1 - phi, the flow is
	// (P - s)/(n + 1 - phi) in units of conductance over viscosity: a pore takes (n + 1/2)/(P - s), all of them
	// N^2/(2 (P - s)): the square of the length filled is proportional to the time.
	constexpr int n = 12;
	constexpr double pressure = 3, entry = 1;
	auto timesFor = [&](double dt) {
		auto network = tube(stiffFluids(), n, pressure, entry);
		PressureSolver solver;
		std::vector<double> times;
		for (double now = 0; static_cast<int>(times.size()) < n; now += dt) {
			const auto step = displace(network, nullptr, dt, solver);
			expectKept(step);
			for (const auto& filled : step.filled) {
				EXPECT_EQ(filled.pore, static_cast<int>(times.size()) + 1);
				times.push_back(now + filled.time);
			}
		}
		return times;
	};
	auto errorFor = [&](double dt) {
		const auto times = timesFor(dt);
		double worst = 0, exact = 0;
		for (int k = 0; k < n; ++k) {
			exact += (n - 1 - k + 0.5) / (pressure - entry);
			worst = std::max(worst, std::abs(times[k] - exact));
		}
		return worst;
	};
	// First order in time: what divides the flow is that of the part's beginning.
	const double coarse = errorFor(0.02), fine = errorFor(0.01);
	EXPECT_NEAR(
	        coarse / fine, 2, 0.3); // the next term is of the order of dt over the time of a pore, 0.02/0.25, twice
	EXPECT_LT(fine, 0.01 * n);      // half a part's error of the viscosity for each pore
}

TEST(Displacement, ExactlyAtItsEntryPressureGasStaysOutAndAboveItGoesIn)
{
	for (double excess : { -1e-6, 1e-6 }) {
		auto network = tube(stiffFluids(), 3, 1 + excess, 1);
		PressureSolver solver;
		const auto step = displace(network, nullptr, 1, solver);
		EXPECT_EQ(step.entries.size(), excess > 0 ? 1u : 0u);
		expectKept(step);
	}
}

TEST(Displacement, TheMeniscusThatHasPassedJumps)
{
	// It waits for 1 Pa and is then held back by 0.2: a pore next to the outlet takes 1/2 over (P - 0.2), and gas
	// that has begun goes on at 0.5 Pa.
	auto network = tube(stiffFluids(), 1, 1.01, 1);
	network.pores[1].bodyPressure = 0.2;
	PressureSolver solver;
	double time = 0, filled = 0;
	for (; filled == 0 && time < 5; time += 0.001) {
		if (time > 0.1) network.pores[0].fixedPressure = 0.5;
		const auto step = displace(network, nullptr, 0.001, solver);
		expectKept(step);
		if (!step.filled.empty()) filled = time + step.filled[0].time;
	}
	// 0.81 (1 - phi)^-1 until 0.1, then 0.3: (1 - phi)^2/2 falls by 0.081 and by 0.3 a second from 1/2; half of a
	// step's change of the viscosity.
	EXPECT_NEAR(filled, 0.1 + (0.5 - 0.081) / 0.3, 0.01);
	// One that has not begun stays where it is at 0.5 Pa.
	auto waiting = tube(stiffFluids(), 1, 0.5, 1);
	waiting.pores[1].bodyPressure = 0.2;
	EXPECT_TRUE(displace(waiting, nullptr, 1, solver).entries.empty());
}

TEST(Displacement, GasTakesTheThroatWithTheLowerEntryPressure)
{
	auto network = tube(stiffFluids(), 1, 1.5, 1);
	network.pores.push_back(waterPore(network.fluids, 1));
	network.throats.push_back({ 0, 2, 1, 2 });
	network.throats.push_back({ 1, 2, 1, 1 });
	PressureSolver solver;
	for (int k = 0; k < 20; ++k)
		expectKept(displace(network, nullptr, 1, solver));
	EXPECT_TRUE(network.pores[1].isGas);
	EXPECT_FALSE(network.pores[2].isGas);              // cut off from the outlet by then
	EXPECT_NEAR(network.pores[2].pressure, 0.5, 1e-6); // locked: what its interface holds, 1.5 - 1
}

TEST(Displacement, LockedWaterDrainsThroughFilms)
{
	// As above; the films let go G (0.5 - 0) in place of nothing: a pore of volume one takes 1/(0.5 G).
	auto network = tube(stiffFluids(), 1, 1.5, 1);
	network.filmConductance = 0.01;
	network.pores.push_back(waterPore(network.fluids, 1));
	network.throats.push_back({ 1, 2, 1, 1 });
	PressureSolver solver;
	double locked = 0, gone = 0;
	for (double now = 0; gone == 0 && now < 400; now += 1) {
		const auto step = displace(network, nullptr, 1, solver);
		expectKept(step);
		for (const auto& filled : step.filled)
			(filled.pore == 1 ? locked : gone) = now + filled.time;
	}
	// The throat takes part of the drop: the flow is 0.5/(1/G + 1) at first.
	EXPECT_NEAR((gone - locked) * 0.5 * network.filmConductance, 1, 0.02);
}

TEST(Displacement, GasLeavesAPoreThatItsWaterFills)
{
	// Grains have closed in on a pore of gas to 0.85, it holds 0.9 of water: the gas goes to its neighbour, at
	// pressure 1, and the water is squeezed, p = K_f (0.9/0.85 - 1), but for what is left of the gas, 1e-6 of the
	// pore at most, 1e-6 K_f.
	TwoFluids fluids;
	fluids.datum = 2, fluids.waterBulkModulus = 100, fluids.gasViscosity = 1e-3;
	TwoFluidNetwork network;
	network.fluids = fluids;
	network.pores = { gasPore(fluids, 1, 1), gasPore(fluids, 0.1, 1) };
	network.pores[0].fixedPressure = 1;
	network.pores[1].volume = 0.85, network.pores[1].water = 0.9;
	network.throats.push_back({ 0, 1, 1, 200 });
	PressureSolver solver;
	const auto step = displace(network, nullptr, 1, solver);
	expectKept(step);
	ASSERT_EQ(step.lost.size(), 1u);
	EXPECT_FALSE(network.pores[1].isGas);
	EXPECT_GE(network.pores[1].gas, 0);
	EXPECT_NEAR(network.pores[1].pressure, 100 * (0.9 / 0.85 - 1), 1e-4);
}

TEST(Displacement, APoreThatIsTooSmallForItsGasIsOneOfGas)
{
	// A pore of water at a prescribed pressure, nearly full of gas, that grains have closed to less than the gas
	// takes.
	auto network = tube(stiffFluids(1, 1e-3), 2, 3, 1);
	network.pores[2].gas = 0.99;
	network.pores[2].water = 0.01;
	network.pores[2].volume = 0.9;
	PressureSolver solver;
	const auto step = displace(network, nullptr, 1e-3, solver);
	expectKept(step);
	EXPECT_TRUE(network.pores[2].isGas);
	for (const auto& pore : network.pores)
		EXPECT_TRUE(pore.gas >= 0 && pore.water >= 0);
}

TEST(Displacement, ClosedGasExpandsAtConstantTemperature)
{
	// A reservoir of volume 1 at gauge pressure 1 (absolute 3) opens into a chamber of volume 2 at gauge pressure 0
	// (absolute 2): (3 + 4)/3 absolute.
	TwoFluids fluids;
	fluids.datum = 2;
	TwoFluidNetwork network;
	network.fluids = fluids;
	network.pores = { gasPore(fluids, 1, 1), gasPore(fluids, 2, 0) };
	network.throats.push_back({ 0, 1, fluids.gasViscosity, 0 });
	PressureSolver solver;
	const double before = held(network);
	for (int k = 0; k < 100; ++k)
		expectKept(displace(network, nullptr, 1, solver));
	for (const auto& pore : network.pores)
		EXPECT_NEAR(pore.pressure, 7.0 / 3 - 2, 1e-6);
	EXPECT_NEAR(held(network), before, 1e-13);
}

TEST(Displacement, RateRaisesThePressureUntilTheThroatOpens)
{
	// Gas of absolute pressure 2 in a volume 1, fed 0.1 a second (as volume at absolute pressure 2): p = 2 + 0.2 t
	// absolute until gauge pressure 1, at t = 5; then the water takes what comes.
	TwoFluids fluids;
	fluids.datum = 2, fluids.waterBulkModulus = 1e9, fluids.waterViscosity = 1e-6, fluids.gasViscosity = 1e-9;
	auto network = tube(fluids, 2, 0, 1);
	network.pores[0].fixedPressure.reset();
	network.pores[0].source = 0.1;
	PressureSolver solver;
	double entered = -1;
	for (double now = 0; now < 8; now += 0.125) {
		const auto step = displace(network, nullptr, 0.125, solver);
		expectKept(step);
		if (!step.entries.empty() && entered < 0) entered = now + 0.125;
		if (entered < 0)
			EXPECT_NEAR(network.pores[0].pressure, 0.2 * (now + 0.125), 1e-6);
		else
			EXPECT_NEAR(network.pores[0].pressure, 1, 1e-4); // viscous drop of 0.1 x 1e-6 and less
	}
	EXPECT_NEAR(entered, 5.125, 1e-9);
}

TEST(Displacement, AmountsAreKeptInANetworkWithoutOrder)
{
	Random random(5);
	auto network = disorderedTwoFluids(random);
	const auto fluids = network.fluids;
	PressureSolver solver;
	int filled = 0, entered = 0;
	for (int k = 0; k < 200; ++k) {
		const double before = held(network);
		const auto step = displace(network, nullptr, 0.5, solver);
		expectKept(step);
		EXPECT_NEAR(held(network) - before, step.water.stored + step.gas.stored, 1e-10);
		filled += static_cast<int>(step.filled.size()), entered += static_cast<int>(step.entries.size());
		// What a pore holds fills it, to the accuracy of the pressures: 1e-7 of the highest, about 5, times the
		// compressibility, at most 2/(5 + 0.15).
		for (const auto& pore : network.pores) {
			const double holds = waterVolume(fluids, pore.water, pore.pressure)
			        + gasVolume(fluids, pore.gas, pore.pressure + pore.held);
			EXPECT_NEAR(holds, pore.volume, 2e-7);
			EXPECT_GE(pore.water, 0);
		}
	}
	EXPECT_GT(filled, 30);
	EXPECT_GE(entered, filled);
}

TEST(Displacement, AFailedStepLeavesTheNetworkAsItWas)
{
	auto network = tube(stiffFluids(), 3, 2, 1);
	network.pores[2].volume = -1;
	PressureSolver solver;
	EXPECT_NE(messageOf([&] {
		displace(network, nullptr, 1, solver);
	}).find("pore 2: volume [m^3] = -1, allowed: > 0"),
	        std::string::npos);
	network.pores[2].volume = 1;
	EXPECT_NE(messageOf([&] { displace(network, nullptr, 0, solver); }).find("time step"), std::string::npos);
	network.fluids.gas.law = GasLaw::incompressible;
	EXPECT_NE(messageOf([&] { displace(network, nullptr, 1, solver); }).find("incompressible"), std::string::npos);
	network.fluids.gas.law = GasLaw::ideal;
	network.fluids.waterViscosity = 0;
	EXPECT_NE(messageOf([&] { displace(network, nullptr, 1, solver); }).find("viscosity of the water [Pa s] = 0"),
	        std::string::npos);
	EXPECT_EQ(network.pores[1].gas, 0);
	EXPECT_EQ(network.pores[1].pressure, 0);
}

} // namespace capfrac
