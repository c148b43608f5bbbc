// SPDX-License-Identifier: GPL-2.0-or-later
#include "Walls.hpp"
#include "Attributes.hpp"

#include <algorithm>

namespace yade {

namespace {
	const std::array<std::string, capfrac::nWalls> names { "left", "right", "bottom", "top" };
}

std::string wallName(int wall) { return names[wall]; }

int wallFromName(const std::string& attribute, const std::string& name)
{
	const auto found = std::find(names.begin(), names.end(), name);
	if (found == names.end())
		capfrac::refuseAttribute(attribute, "'" + name + "'", "'left', 'right', 'bottom', 'top'");
	return static_cast<int>(found - names.begin());
}

std::vector<int> wallsFromName(const std::string& attribute, const std::string& name)
{
	if (name == "any") return { 0, 1, 2, 3 };
	if (std::find(names.begin(), names.end(), name) == names.end())
		capfrac::refuseAttribute(attribute, "'" + name + "'", "'left', 'right', 'bottom', 'top', 'any'");
	return { wallFromName(attribute, name) };
}

std::vector<WallStretch> wallStretches(
        const capfrac::Triangulation& mesh, const capfrac::Domains& domains, const SceneReader& reader, int wall)
{
	const bool flat = wall == capfrac::wallBottom || wall == capfrac::wallTop;
	std::vector<WallStretch> pieces;
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const auto& v = mesh.cells[c].vertex;
		if (std::find(v.begin(), v.end(), mesh.nGrains + wall) == v.end()) continue;
		// The part of the wall under a cell: from the foot (or corner) of one neighbour to that of the other.
		WallStretch piece { domains.ofCell[c], 1e300, -1e300 };
		for (const auto& corner : capfrac::cellPolygon(mesh, static_cast<int>(c), reader.grains, reader.box)) {
			if (capfrac::norm(corner - reader.box.foot(wall, corner)) > 0) continue;
			piece.from = math::min(piece.from, flat ? corner.x : corner.y);
			piece.to = math::max(piece.to, flat ? corner.x : corner.y);
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

int cellAt(const capfrac::Triangulation& mesh, const SceneReader& reader, capfrac::Vec2 point)
{
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const auto polygon = capfrac::cellPolygon(mesh, static_cast<int>(c), reader.grains, reader.box);
		bool inside = true;
		for (std::size_t k = 0; k < polygon.size(); ++k)
			inside &=
			        capfrac::cross(polygon[(k + 1) % polygon.size()] - polygon[k], point - polygon[k]) >= 0;
		if (inside) return static_cast<int>(c);
	}
	std::ostringstream text;
	text << "(" << point.x << ", " << point.y << ")";
	capfrac::refuseAttribute("point [m]", text.str(), "a point inside the box");
}

} // namespace yade
