// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The pores along a wall.

#include "Domains.hpp"

#include "../geometry/VoidGeometry.hpp"

#include <string>

namespace capfrac {

/// left, right, bottom or top.
std::string wallName(int wall);

/// The wall called left, right, bottom or top; throws std::invalid_argument naming `attribute` otherwise.
int wallFromName(const std::string& attribute, const std::string& name);

/// The walls that `name` stands for: one of them, or all four for any; throws as wallFromName().
std::vector<int> wallsFromName(const std::string& attribute, const std::string& name);

/// The part of a wall that belongs to one domain, in the coordinate along the wall [m].
struct WallStretch {
	int domain = -1;
	double from = 0, to = 0;
	double middle() const { return 0.5 * (from + to); }
};

/// The stretches of a wall in the order of the coordinate; neighbouring cells of one domain make one stretch.
std::vector<WallStretch> wallStretches(
        const Triangulation& mesh, const Domains& domains, const std::vector<Disk>& grains, const Box& box, int wall);

/// The cell that holds a point; throws std::invalid_argument where there is none (outside the box).
int cellAt(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box, Vec2 point);

} // namespace capfrac
