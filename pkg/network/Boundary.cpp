// SPDX-License-Identifier: GPL-2.0-or-later
#include "Boundary.hpp"

#include "../laws/Options.hpp"

#include <algorithm>

namespace capfrac {

namespace {
	const std::array<std::string, nWalls> names { "left", "right", "bottom", "top" };
}

std::string wallName(int wall) { return names[wall]; }

int wallFromName(const std::string& attribute, const std::string& name)
{
	const auto found = std::find(names.begin(), names.end(), name);
	if (found == names.end()) refuseAttribute(attribute, "'" + name + "'", "'left', 'right', 'bottom', 'top'");
	return static_cast<int>(found - names.begin());
}

std::vector<int> wallsFromName(const std::string& attribute, const std::string& name)
{
	if (name == "any") return { 0, 1, 2, 3 };
	if (std::find(names.begin(), names.end(), name) == names.end())
		refuseAttribute(attribute, "'" + name + "'", "'left', 'right', 'bottom', 'top', 'any'");
	return { wallFromName(attribute, name) };
}

std::vector<WallStretch> wallStretches(
        const Triangulation& mesh, const Domains& domains, const std::vector<Disk>& grains, const Box& box, int wall)
{
	const bool flat = wall == wallBottom || wall == wallTop;
	std::vector<WallStretch> pieces;
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const auto& v = mesh.cells[c].vertex;
		if (std::find(v.begin(), v.end(), mesh.nGrains + wall) == v.end()) continue;
		// The part of the wall under a cell: from the foot (or corner) of one neighbour to that of the other.
		WallStretch piece { domains.ofCell[c], 1e300, -1e300 };
		for (const auto& corner : cellPolygon(mesh, static_cast<int>(c), grains, box)) {
			if (norm(corner - box.foot(wall, corner)) > 0) continue;
			piece.from = std::min(piece.from, flat ? corner.x : corner.y);
			piece.to = std::max(piece.to, flat ? corner.x : corner.y);
		}
		pieces.push_back(piece);
	}
	std::sort(pieces.begin(), pieces.end(),
	        [](const WallStretch& a, const WallStretch& b) { return a.middle() < b.middle(); });
	std::vector<WallStretch> stretches;
	for (const auto& piece : pieces)
		if (!stretches.empty() && stretches.back().domain == piece.domain)
			stretches.back().to = piece.to;
		else
			stretches.push_back(piece);
	return stretches;
}

int cellAt(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box, Vec2 point)
{
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const auto polygon = cellPolygon(mesh, static_cast<int>(c), grains, box);
		bool inside = true;
		for (std::size_t k = 0; k < polygon.size(); ++k)
			inside &= cross(polygon[(k + 1) % polygon.size()] - polygon[k], point - polygon[k]) >= 0;
		if (inside) return static_cast<int>(c);
	}
	std::ostringstream text;
	text << "(" << point.x << ", " << point.y << ")";
	refuseAttribute("point [m]", text.str(), "a point inside the box");
}

} // namespace capfrac
