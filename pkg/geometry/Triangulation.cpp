// SPDX-License-Identifier: GPL-2.0-or-later
#include "PowerPoints.hpp"

#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <sstream>

namespace capfrac {

namespace {

	using Kernel = PowerPoints::Kernel;
	using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel,
	        CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
	using FaceBase = CGAL::Regular_triangulation_face_base_2<Kernel>;
	using PowerTriangulation =
	        CGAL::Regular_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

	std::array<int, 3> smallestFirst(std::array<int, 3> v)
	{
		std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
		return v;
	}

	[[noreturn]] void refuse(std::size_t grain, const char* what, double value, const char* allowed)
	{
		std::ostringstream text;
		text.precision(10);
		text << what << " = " << value << ", allowed: " << allowed;
		throw GeometryError(static_cast<int>(grain), text.str());
	}

	void checkNoneHidden(const PowerTriangulation& t, std::size_t nGrains)
	{
		std::vector<char> seen(nGrains + nWalls, 0);
		for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v)
			seen[v->info()] = 1;
		for (std::size_t i = 0; i < nGrains; ++i)
			if (!seen[i])
				throw GeometryError(static_cast<int>(i),
				        "has no room of its own: it coincides with another grain or lies within its"
				        " neighbours (overlaps must be small against the radii)");
	}

} // namespace

void checkGrains(const std::vector<Disk>& grains, const Box& box)
{
	if (grains.empty()) throw GeometryError(-1, "no grains: the network needs at least one disk in the box");
	const bool finite = std::isfinite(box.left) && std::isfinite(box.right) && std::isfinite(box.bottom)
	        && std::isfinite(box.top);
	if (!finite || box.width() <= 0 || box.height() <= 0) {
		std::ostringstream text;
		text << "box [" << box.left << ", " << box.right << "] x [" << box.bottom << ", " << box.top
		     << "] is empty or not finite; allowed: left < right and bottom < top";
		throw GeometryError(-1, text.str());
	}
	for (std::size_t i = 0; i < grains.size(); ++i) {
		const Disk& g = grains[i];
		if (!std::isfinite(g.radius) || g.radius <= 0) refuse(i, "radius [m]", g.radius, "finite and > 0");
		if (!std::isfinite(g.centre.x)) refuse(i, "x [m]", g.centre.x, "finite");
		if (!std::isfinite(g.centre.y)) refuse(i, "y [m]", g.centre.y, "finite");
		if (g.centre.x <= box.left || g.centre.x >= box.right)
			refuse(i, "x [m]", g.centre.x, "between the left and the right wall");
		if (g.centre.y <= box.bottom || g.centre.y >= box.top)
			refuse(i, "y [m]", g.centre.y, "between the bottom and the top wall");
	}
}

Triangulation triangulate(const std::vector<Disk>& grains, const Box& box)
{
	checkGrains(grains, box);

	// The pairs are inserted in CGAL's own spatial order; the result does not depend on the numbering.
	const PowerPoints weighted(grains, box);
	std::vector<std::pair<PowerPoints::WeightedPoint, int>> points;
	points.reserve(weighted.size());
	for (int v = 0; v < weighted.size(); ++v)
		points.emplace_back(weighted[v], v);
	PowerTriangulation power;
	power.insert(points.begin(), points.end());
	checkNoneHidden(power, grains.size());

	Triangulation mesh;
	mesh.nGrains = static_cast<int>(grains.size());
	mesh.cells.reserve(power.number_of_faces());
	for (auto f = power.finite_faces_begin(); f != power.finite_faces_end(); ++f)
		mesh.cells.push_back(
		        { smallestFirst({ f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info() }), {} });
	std::sort(
	        mesh.cells.begin(), mesh.cells.end(), [](const Cell& a, const Cell& b) { return a.vertex < b.vertex; });
	connectCells(mesh);
	return mesh;
}

void connectCells(Triangulation& mesh)
{
	struct Side {
		int from, to, cell, opposite;
	};
	// Every side is listed under its pair of vertices; two cells share an edge where two sides meet.
	std::vector<Side> sides;
	sides.reserve(3 * mesh.cells.size());
	for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c)
		for (int k = 0; k < 3; ++k)
			sides.push_back({ mesh.cells[c].vertex[(k + 1) % 3], mesh.cells[c].vertex[(k + 2) % 3], c, k });
	auto key = [](const Side& s) { return std::make_pair(std::min(s.from, s.to), std::max(s.from, s.to)); };
	std::sort(sides.begin(), sides.end(),
	        [&](const Side& p, const Side& q) { return key(p) != key(q) ? key(p) < key(q) : p.cell < q.cell; });

	mesh.edges.clear();
	for (std::size_t i = 0; i < sides.size();) {
		const bool paired = i + 1 < sides.size() && key(sides[i]) == key(sides[i + 1]);
		const auto ends = key(sides[i]);
		const Side& s = sides[i];
		mesh.cells[s.cell].neighbour[s.opposite] = paired ? sides[i + 1].cell : -1;
		if (paired) mesh.cells[sides[i + 1].cell].neighbour[sides[i + 1].opposite] = s.cell;
		if (!mesh.isWall(ends.first)) {
			Edge e { ends.first, ends.second, -1, -1 };
			for (std::size_t n = 0; n < (paired ? 2u : 1u); ++n)
				(sides[i + n].from == ends.first ? e.left : e.right) = sides[i + n].cell;
			mesh.edges.push_back(e);
		}
		i += paired ? 2 : 1;
	}
}

bool isRegular(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box)
{
	const PowerPoints points(grains, box);
	for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
		if (!points.isCounterClockwise(mesh.cells[c].vertex)) return false;
		for (int k = 0; k < 3; ++k)
			if (mesh.cells[c].neighbour[k] > c && !isLocallyRegular(mesh.cells, c, k, points)) return false;
	}
	return true;
}

} // namespace capfrac
