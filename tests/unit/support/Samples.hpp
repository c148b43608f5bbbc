// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Samples of disks for the tests of the kernels, and a source of random numbers that gives the same
/// ones everywhere (the distributions of the standard library may differ from one library to the next).

#include "geometry/Triangulation.hpp"

#include <random>

namespace capfrac::samples {

class Random {
public:
	explicit Random(unsigned seed)
	        : engine(seed)
	{
	}
	double uniform(double low, double high);
	int below(int n) { return static_cast<int>(engine() % static_cast<unsigned>(n)); }
	bool chance(double probability) { return uniform(0, 1) < probability; }
	std::vector<int> permutation(int n);

private:
	std::mt19937 engine;
};

/// A box that is neither square nor at the origin, so that no test leans on either.
constexpr Box oblong { 1.5, 4.5, -2.0, 2.0 };

/// Disks apart from each other and from the walls, 35 % of the box (20 % for up to three); radii differ by `ratio` at
/// most.
std::vector<Disk> looseSample(Random& random, int n, const Box& box, double ratio);

/// A dense packing: 86 % of the box, about four contacts a grain, overlaps of a few percent of a radius.
std::vector<Disk> packedSample(Random& random, int n, const Box& box, double ratio);

/// A jittered lattice with overlaps and gaps up to a third of the spacing, at walls as well, but no pair
/// closer to bare contact than `awayFromContact` spacings: there the chord has a root and no derivative.
/// Three disks never overlap in one point. The spacing is that of `columns` in the width of the box.
std::vector<Disk> overlappingSample(Random& random, int columns, const Box& box, double awayFromContact);

std::vector<Disk> shifted(std::vector<Disk> grains, Vec2 by);
Box shifted(const Box& box, Vec2 by);

/// Grain `order[i]` of `grains` becomes grain i.
std::vector<Disk> renumbered(const std::vector<Disk>& grains, const std::vector<int>& order);

} // namespace capfrac::samples
