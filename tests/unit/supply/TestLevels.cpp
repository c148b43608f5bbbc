// SPDX-License-Identifier: GPL-2.0-or-later
/// supply/Levels: which pressure comes next.

#include "supply/Levels.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	/// The pressures of the levels until the last one is done.
	std::vector<double> course(
	        Levels& levels, const LevelOptions& options, const SupplyOptions& supply, double pressure)
	{
		std::vector<double> held;
		for (int step = 0; step < 100 && !levels.done; ++step) {
			held.push_back(pressure);
			levels.next(options, supply, pressure, step);
		}
		return held;
	}

	LevelOptions ramp(double increment, double max)
	{
		LevelOptions options;
		options.pressureIncrement = increment, options.maxPressure = max;
		return options;
	}

} // namespace

TEST(Levels, ARampEndsAtItsMaximum)
{
	Levels levels;
	EXPECT_EQ(course(levels, ramp(4, 10), {}, 1), (std::vector<double> { 1, 5, 9, 10 }));
	EXPECT_EQ(levels.start, 3);
}

TEST(Levels, AHeldPressureIsOneLevel)
{
	Levels levels;
	EXPECT_EQ(course(levels, ramp(0, 10), {}, 7), std::vector<double> { 7 });
}

TEST(Levels, AProgramGoesUpAndDown)
{
	auto options = ramp(3, 0);
	options.program = { 5, 1, 1, 2 };
	Levels levels;
	EXPECT_EQ(course(levels, options, {}, 1), (std::vector<double> { 1, 4, 5, 2, 1, 2 }));
	EXPECT_EQ(levels.programPosition, 4);
}

TEST(Levels, ARampWhoseEndIsMovedUpGoesOn)
{
	Levels levels;
	const SupplyOptions supply;
	auto options = ramp(4, 10);
	levels.follow(options, supply, 1);
	course(levels, options, supply, 1);
	levels.follow(options, supply, 10); // nothing was changed
	EXPECT_TRUE(levels.done);
	options.maxPressure = 12;
	levels.follow(options, supply, 10);
	EXPECT_EQ(course(levels, options, supply, 10), (std::vector<double> { 10, 12 }));
}

TEST(Levels, AnotherProgramOrControlBeginsAnew)
{
	Levels levels;
	SupplyOptions supply;
	auto options = ramp(2, 0);
	options.program = { 3 };
	levels.follow(options, supply, 1);
	course(levels, options, supply, 1);
	levels.follow(options, supply, 3);
	EXPECT_TRUE(levels.done);
	options.program = { 3, 5 };
	levels.follow(options, supply, 3);
	EXPECT_FALSE(levels.done);
	EXPECT_EQ(levels.programPosition, 0);
	course(levels, options, supply, 3);
	supply.control = GasControl::rate;
	levels.follow(options, supply, 5);
	EXPECT_FALSE(levels.done);
}

TEST(Levels, UnderARateALevelIsDueAfterAnIncrement)
{
	SupplyOptions supply;
	supply.control = GasControl::rate;
	const auto options = ramp(4, 0);
	Levels levels;
	EXPECT_TRUE(levels.due(options, supply, 1));
	Level last;
	last.pressure = 10;
	levels.closed.push_back(last);
	EXPECT_FALSE(levels.due(options, supply, 13.9));
	EXPECT_TRUE(levels.due(options, supply, 14));
	EXPECT_TRUE(levels.due(options, supply, 6)); // it may have fallen
	EXPECT_FALSE(levels.due(ramp(0, 0), supply, 14));
}

TEST(Levels, OptionsThatDoNotGoTogetherAreNamed)
{
	SupplyOptions supply;
	auto options = ramp(0, 0);
	options.program = { 5 };
	EXPECT_THROW(checkTogether(options, supply, 0), std::invalid_argument); // no increment
	options.pressureIncrement = 1;
	EXPECT_NO_THROW(checkTogether(options, supply, 0));
	EXPECT_THROW(checkTogether(options, supply, 6), std::invalid_argument); // below the water
	supply.control = GasControl::reservoir;
	EXPECT_THROW(checkTogether(options, supply, 0), std::invalid_argument);
	options.maxSteps = options.minSteps - 1;
	EXPECT_THROW(checkOptions(options), std::invalid_argument);
}

} // namespace capfrac
