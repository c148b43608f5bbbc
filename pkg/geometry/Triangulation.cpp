#include "Triangulation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <sstream>

namespace capfrac {

namespace {

	using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
	using VertexBase
	        = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
	using FaceBase         = CGAL::Regular_triangulation_face_base_2<Kernel>;
	using PowerTriangulation = CGAL::Regular_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
	using WeightedPoint    = Kernel::Weighted_point_2;

	/// Radius of the disk that stands for a wall, in box sizes. Its surface then sags by less than 1e-5 of
	/// the box over the wall, and its rounding error stays below 1e-11 of it.
	constexpr double wallRadiusInBoxes = 1e5;

	WeightedPoint weightedWall(int wall, const Box& box)
	{
		const double radius = wallRadiusInBoxes * std::max(box.width(), box.height());
		const Vec2   middle { 0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top) };
		const Vec2   centre = box.foot(wall, middle) + radius * Box::outward(wall);
		return WeightedPoint(Kernel::Point_2(centre.x, centre.y), radius * radius);
	}

	WeightedPoint weightedVertex(int vertex, const std::vector<Disk>& grains, const Box& box)
	{
		const int nGrains = static_cast<int>(grains.size());
		if (vertex >= nGrains) return weightedWall(vertex - nGrains, box);
		const Disk& g = grains[vertex];
		return WeightedPoint(Kernel::Point_2(g.centre.x, g.centre.y), g.radius * g.radius);
	}

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
				throw GeometryError(static_cast<int>(i), "has no room of its own: it coincides with another grain or lies within its"
				                                         " neighbours (overlaps must be small against the radii)");
	}

} // namespace

void checkGrains(const std::vector<Disk>& grains, const Box& box)
{
	if (grains.empty()) throw GeometryError(-1, "no grains: the network needs at least one disk in the box");
	const bool finite = std::isfinite(box.left) && std::isfinite(box.right) && std::isfinite(box.bottom) && std::isfinite(box.top);
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
		if (g.centre.x <= box.left || g.centre.x >= box.right) refuse(i, "x [m]", g.centre.x, "between the left and the right wall");
		if (g.centre.y <= box.bottom || g.centre.y >= box.top) refuse(i, "y [m]", g.centre.y, "between the bottom and the top wall");
	}
}

Triangulation triangulate(const std::vector<Disk>& grains, const Box& box)
{
	checkGrains(grains, box);
	const int nVertices = static_cast<int>(grains.size()) + nWalls;

	// The pairs are inserted in CGAL's own spatial order; the result does not depend on the numbering.
	std::vector<std::pair<WeightedPoint, int>> points;
	points.reserve(nVertices);
	for (int v = 0; v < nVertices; ++v)
		points.emplace_back(weightedVertex(v, grains, box), v);
	PowerTriangulation power;
	power.insert(points.begin(), points.end());
	checkNoneHidden(power, grains.size());

	Triangulation mesh;
	mesh.nGrains = static_cast<int>(grains.size());
	mesh.cells.reserve(power.number_of_faces());
	for (auto f = power.finite_faces_begin(); f != power.finite_faces_end(); ++f)
		mesh.cells.push_back({ smallestFirst({ f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info() }), {} });
	std::sort(mesh.cells.begin(), mesh.cells.end(), [](const Cell& a, const Cell& b) { return a.vertex < b.vertex; });
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
	std::sort(sides.begin(), sides.end(), [&](const Side& p, const Side& q) {
		return key(p) != key(q) ? key(p) < key(q) : p.cell < q.cell;
	});

	mesh.edges.clear();
	for (std::size_t i = 0; i < sides.size();) {
		const bool  paired = i + 1 < sides.size() && key(sides[i]) == key(sides[i + 1]);
		const auto  ends   = key(sides[i]);
		const Side& s      = sides[i];
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
	std::vector<WeightedPoint> points;
	points.reserve(grains.size() + nWalls);
	for (int v = 0; v < static_cast<int>(grains.size()) + nWalls; ++v)
		points.push_back(weightedVertex(v, grains, box));

	const Kernel kernel;
	const auto   powerSide   = kernel.power_side_of_oriented_power_circle_2_object();
	const auto   orientation = kernel.orientation_2_object();
	for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
		const auto& v = mesh.cells[c].vertex;
		if (orientation(points[v[0]].point(), points[v[1]].point(), points[v[2]].point()) != CGAL::LEFT_TURN) return false;
		for (int k = 0; k < 3; ++k) {
			const int other = mesh.cells[c].neighbour[k];
			if (other <= c) continue; // outside, or seen from the other cell
			const auto& u = mesh.cells[other].vertex;
			for (int opposite : u)
				if (opposite != v[(k + 1) % 3] && opposite != v[(k + 2) % 3]
				    && powerSide(points[v[0]], points[v[1]], points[v[2]], points[opposite]) == CGAL::ON_POSITIVE_SIDE)
					return false;
		}
	}
	return true;
}

} // namespace capfrac
