// SPDX-License-Identifier: GPL-2.0-or-later
#include "CarryOver.hpp"

#include "Contents.hpp"

#include <cmath>
#include <limits>

namespace capfrac {

namespace {

	constexpr double none = std::numeric_limits<double>::quiet_NaN();

	std::vector<double> carriedCells(const std::vector<double>& values, const Triangulation& before,
	        const Triangulation& after, double fallback)
	{
		std::vector<double> kept(after.cells.size(), none);
		for (std::size_t n = 0, o = 0; n < after.cells.size(); ++n) { // both are sorted by vertex
			while (o < before.cells.size() && before.cells[o].vertex < after.cells[n].vertex)
				++o;
			if (o < before.cells.size() && before.cells[o].vertex == after.cells[n].vertex)
				kept[n] = values[o++];
		}
		auto carried = kept;
		for (std::size_t n = 0; n < after.cells.size(); ++n)
			for (int k = 0; k < 3 && std::isnan(carried[n]); ++k)
				if (const int next = after.cells[n].neighbour[k]; next >= 0) carried[n] = kept[next];
		for (auto& value : carried)
			if (std::isnan(value)) value = fallback;
		return carried;
	}

} // namespace

void CarryOver::cells(std::vector<double>& values, double fallback) { ofCells.push_back({ &values, fallback }); }

void CarryOver::edges(std::vector<std::uint8_t>& flags, std::uint8_t fresh) { ofEdges.push_back({ &flags, fresh }); }

void CarryOver::carry(const Triangulation& before, const Triangulation& after) const
{
	for (const auto& field : ofCells)
		if (field.values->size() == before.cells.size())
			*field.values = carriedCells(*field.values, before, after, field.fallback);
	for (const auto& field : ofEdges)
		if (!field.flags->empty()) *field.flags = carryOverEdges(before, *field.flags, after, field.fresh);
}

} // namespace capfrac
