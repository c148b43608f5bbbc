// SPDX-License-Identifier: GPL-2.0-or-later
#include "VolumeGradients.hpp"

#include <algorithm>
#include <utility>

namespace capfrac {

namespace {

	/// Part of the circle `r` that lies beyond a chord at `distance` from its centre [m].
	double arcBeyond(double r, double distance)
	{
		if (distance >= r) return 0;
		if (distance <= -r) return 2 * M_PI * r;
		return 2 * r * std::atan2(std::sqrt((r - distance) * (r + distance)), distance);
	}

	/// d(lensArea)/d(ra): the part of the circle `ra` that lies within the other [m].
	double arcWithin(double ra, double rb, double distance)
	{
		if (distance >= ra + rb) return 0;
		if (distance <= std::abs(ra - rb)) return ra < rb ? 2 * M_PI * ra : 0;
		return arcBeyond(ra, (distance * distance + ra * ra - rb * rb) / (2 * distance));
	}

	/// The matrix under construction: the entries are laid out first, then filled edge by edge.
	struct Rows {
		const Triangulation& mesh;
		VolumeGradients b;
		std::vector<std::array<int, 3>> entry; ///< of vertex k of each cell, in b.grains or b.walls

		explicit Rows(const Triangulation& mesh_)
		        : mesh(mesh_)
		        , entry(mesh_.cells.size())
		{
			b.grains.reserve(3 * entry.size());
			for (std::size_t c = 0; c < entry.size(); ++c) {
				const auto& v = mesh.cells[c].vertex;
				std::array<int, 3> order { 0, 1, 2 };
				std::sort(order.begin(), order.end(), [&](int k, int l) { return v[k] < v[l]; });
				for (int k : order)
					entry[c][k] = append(static_cast<int>(c), v[k]);
			}
		}

		int append(int cell, int vertex)
		{
			if (mesh.isWall(vertex)) {
				b.walls.push_back({ cell, mesh.wallOf(vertex), 0 });
				return static_cast<int>(b.walls.size()) - 1;
			}
			b.grains.push_back({ cell, vertex, {}, 0 });
			return static_cast<int>(b.grains.size()) - 1;
		}

		int entryOf(int cell, int vertex) const
		{
			const auto& v = mesh.cells[cell].vertex;
			return entry[cell][std::find(v.begin(), v.end(), vertex) - v.begin()];
		}
		GrainGradient& ofGrain(int cell, int grain) { return b.grains[entryOf(cell, grain)]; }
		WallGradient& ofWall(int cell, int wall) { return b.walls[entryOf(cell, mesh.nGrains + wall)]; }
	};

	/// What an edge does to the cells on its sides. The terms are those of fluidForces(), for unit pressure in
	/// one cell and none in the other; they differ in sign along the edge only.
	void addEdge(Rows& rows, const Edge& e, const std::vector<Disk>& grains, const Box& box, Radii radii)
	{
		const std::array<std::pair<int, double>, 2> sides { { { e.left, 1 }, { e.right, -1 } } };
		const Disk& a = grains[e.a];
		if (rows.mesh.isWall(e.b)) {
			const int wall = rows.mesh.wallOf(e.b);
			const Vec2 normal = Box::outward(wall);
			const double distance = box.distance(wall, a.centre),
			             halfChord = 0.5 * segmentChord(a.radius, distance);
			const double arc = radii == Radii::vary ? arcBeyond(a.radius, distance) : 0;
			for (const auto& [cell, side] : sides) {
				if (cell < 0) continue;
				rows.ofGrain(cell, e.a).centre += halfChord * normal - side * distance * turned(normal);
				rows.ofGrain(cell, e.a).radius += 0.5 * arc;
				rows.ofWall(cell, wall).outward -= halfChord;
			}
			return;
		}
		const Disk& b = grains[e.b];
		const Vec2 edge = b.centre - a.centre;
		const double length = norm(edge);
		const Vec2 normal = (1 / length) * edge;
		const double skew = (b.radius - a.radius) * (b.radius + a.radius) / (2 * length);
		const double halfChord = 0.5 * lensChord(a.radius, b.radius, length);
		const bool vary = radii == Radii::vary;
		const double arcA = vary ? arcWithin(a.radius, b.radius, length) : 0,
		             arcB = vary ? arcWithin(b.radius, a.radius, length) : 0;
		for (const auto& [cell, side] : sides) {
			if (cell < 0) continue;
			rows.ofGrain(cell, e.a).centre +=
			        halfChord * normal - side * (0.5 * length - skew) * turned(normal);
			rows.ofGrain(cell, e.b).centre -=
			        halfChord * normal + side * (0.5 * length + skew) * turned(normal);
			rows.ofGrain(cell, e.a).radius += 0.5 * arcA;
			rows.ofGrain(cell, e.b).radius += 0.5 * arcB;
		}
	}

	/// Where a vertex lies as seen along a wall: only that coordinate of the result counts.
	Vec2 alongWall(const Triangulation& mesh, int vertex, const std::vector<Disk>& grains, const Box& box)
	{
		return mesh.isWall(vertex) ? box.foot(mesh.wallOf(vertex), {}) : grains[vertex].centre;
	}

	/// Direction in which a grain sees another vertex of its cell.
	Vec2 towards(const Triangulation& mesh, int grain, int vertex, const std::vector<Disk>& grains)
	{
		return mesh.isWall(vertex) ? Box::outward(mesh.wallOf(vertex))
		                           : grains[vertex].centre - grains[grain].centre;
	}

	/// What the corners of a cell do: the sector of a grain that grows, the span of a wall that moves.
	void addCorner(Rows& rows, int cell, int k, const std::vector<Disk>& grains, const Box& box, Radii radii)
	{
		const Triangulation& mesh = rows.mesh;
		const auto& v = mesh.cells[cell].vertex;
		const int at = v[k], next = v[(k + 1) % 3], previous = v[(k + 2) % 3];
		if (mesh.isWall(at)) {
			const Vec2 along =
			        turned(Box::outward(mesh.wallOf(at))); // counter-clockwise along the border of the box
			const Vec2 span = alongWall(mesh, next, grains, box) - alongWall(mesh, previous, grains, box);
			rows.ofWall(cell, mesh.wallOf(at)).outward += dot(span, along);
			return;
		}
		if (radii == Radii::fixed) return;
		const Vec2 from = towards(mesh, at, next, grains), to = towards(mesh, at, previous, grains);
		rows.ofGrain(cell, at).radius -= grains[at].radius * std::atan2(cross(from, to), dot(from, to));
	}

} // namespace

VolumeGradients volumeGradients(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box, Radii radii)
{
	Rows rows(mesh);
	for (const Edge& e : mesh.edges)
		addEdge(rows, e, grains, box, radii);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		for (int k = 0; k < 3; ++k)
			addCorner(rows, static_cast<int>(c), k, grains, box, radii);
	return std::move(rows.b);
}

FluidForces fluidForces(const VolumeGradients& gradients, const std::vector<double>& pressure, std::size_t nGrains)
{
	FluidForces force { std::vector<Vec2>(nGrains), {} };
	for (const auto& g : gradients.grains)
		force.grains[g.grain] += pressure[g.cell] * g.centre;
	for (const auto& w : gradients.walls)
		force.walls[w.wall] += pressure[w.cell] * w.outward * Box::outward(w.wall);
	return force;
}

std::vector<double> voidAreaRates(const VolumeGradients& gradients, const BoundaryRates& rates, std::size_t nCells)
{
	std::vector<double> rate(nCells, 0);
	for (const auto& g : gradients.grains) {
		rate[g.cell] += dot(g.centre, rates.centre[g.grain]);
		if (!rates.radius.empty()) rate[g.cell] += g.radius * rates.radius[g.grain];
	}
	for (const auto& w : gradients.walls)
		rate[w.cell] += w.outward * rates.outward[w.wall];
	return rate;
}

} // namespace capfrac
