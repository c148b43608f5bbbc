// SPDX-License-Identifier: GPL-2.0-or-later
#include "VoidGeometry.hpp"

#include <algorithm>

namespace capfrac {

namespace {

	/// Distance from the centre of `ra` to the common chord of two circles, along the line of centres [m].
	double chordDistance(double ra, double rb, double distance)
	{
		return (distance * distance + ra * ra - rb * rb) / (2 * distance);
	}

	/// Angle from u to v, in (-pi, pi], accurate for any opening.
	double angleBetween(Vec2 u, Vec2 v) { return std::atan2(cross(u, v), dot(u, v)); }

	/// The position that a vertex has as seen from grain `from`: a grain's centre, or the foot on a wall.
	Vec2 seenFrom(const Triangulation& mesh, int from, int vertex, const std::vector<Disk>& grains, const Box& box)
	{
		return mesh.isWall(vertex) ? box.foot(mesh.wallOf(vertex), grains[from].centre) : grains[vertex].centre;
	}

	/// Area where the disks of an edge overlap, or where the disk of `a` reaches beyond the wall `b`.
	double overlapArea(const Triangulation& mesh, int a, int b, const std::vector<Disk>& grains, const Box& box)
	{
		const Disk& g = grains[a];
		if (mesh.isWall(b)) return segmentArea(g.radius, box.distance(mesh.wallOf(b), g.centre));
		return lensArea(g.radius, grains[b].radius, norm(grains[b].centre - g.centre));
	}

	/// The corner shared by two adjacent walls.
	Vec2 corner(int wall1, int wall2, const Box& box)
	{
		const bool left = wall1 == wallLeft || wall2 == wallLeft;
		const bool bottom = wall1 == wallBottom || wall2 == wallBottom;
		return { left ? box.left : box.right, bottom ? box.bottom : box.top };
	}

	double polygonArea(const CellPolygon& p)
	{
		double twice = 0;
		// Relative to the first corner, so that a box far from the origin loses no digits.
		for (std::size_t k = 1; k + 1 < p.size(); ++k)
			twice += cross(p[k] - p[0], p[k + 1] - p[0]);
		return 0.5 * twice;
	}

	/// First moment of half of a disk's part beyond a chord at `distance`, on one side of the axis through its
	/// centre: x along the axis, y away from it, about the centre [m^3].
	Vec2 halfSegmentMoment(double r, double distance)
	{
		if (distance >= r) return {};
		const double d = std::max(distance, -r), halfChord = std::sqrt((r - d) * (r + d));
		return { halfChord * halfChord * halfChord / 3, (r - d) * (r - d) * (2 * r + d) / 6 };
	}

	/// Area and first moment about the origin of half of the overlap of grain `i` with a grain or wall, the half
	/// that lies on the side of `side`, a unit vector square to the line of centres.
	VoidMoments halfOverlap(
	        const Triangulation& mesh, int i, int other, Vec2 side, const std::vector<Disk>& grains, const Box& box)
	{
		VoidMoments half;
		auto add = [&](const Disk& disk, double distance, Vec2 axis) {
			const Vec2 moment = halfSegmentMoment(disk.radius, distance);
			const double area = 0.5 * segmentArea(disk.radius, distance);
			half.area += area;
			half.first += area * disk.centre + moment.x * axis + moment.y * side;
		};
		const Disk& a = grains[i];
		if (mesh.isWall(other)) {
			add(a, box.distance(mesh.wallOf(other), a.centre), Box::outward(mesh.wallOf(other)));
			return half;
		}
		const Disk& b = grains[other];
		const double distance = norm(b.centre - a.centre);
		if (distance >= a.radius + b.radius) return half;
		if (distance <= std::abs(a.radius - b.radius)) {
			const Disk& inner = a.radius < b.radius ? a : b;
			add(inner, -inner.radius, {});
			return half;
		}
		const Vec2 axis = (1 / distance) * (b.centre - a.centre);
		const double ha = chordDistance(a.radius, b.radius, distance);
		add(a, ha, axis);
		add(b, distance - ha, -1 * axis);
		return half;
	}

	VoidMoments polygonMoments(const CellPolygon& p)
	{
		VoidMoments sum;
		for (std::size_t k = 1; k + 1 < p.size(); ++k) {
			const double area = 0.5 * cross(p[k] - p[0], p[k + 1] - p[0]);
			sum.area += area;
			sum.first += area / 3 * (p[0] + p[k] + p[k + 1]);
		}
		return sum;
	}

	/// Length of a wall that belongs to a cell, measured so that it is positive for a cell that is not turned over.
	double wallSpan(
	        const Triangulation& mesh, const Cell& cell, int k, const std::vector<Disk>& grains, const Box& box)
	{
		const int wall = mesh.wallOf(cell.vertex[k]);
		const int next = cell.vertex[(k + 1) % 3], previous = cell.vertex[(k + 2) % 3];
		const Vec2 along = turned(Box::outward(wall)); // counter-clockwise along the border of the box
		const Vec2 from =
		        mesh.isWall(previous) ? corner(wall, mesh.wallOf(previous), box) : grains[previous].centre;
		const Vec2 to = mesh.isWall(next) ? corner(wall, mesh.wallOf(next), box) : grains[next].centre;
		return dot(to - from, along);
	}

} // namespace

double lensArea(double ra, double rb, double distance)
{
	if (distance >= ra + rb) return 0;
	if (distance <= std::abs(ra - rb)) return M_PI * std::min(ra, rb) * std::min(ra, rb);
	const double ha = chordDistance(ra, rb, distance);
	return segmentArea(ra, ha) + segmentArea(rb, distance - ha);
}

double segmentArea(double r, double distance)
{
	if (distance >= r) return 0;
	if (distance <= -r) return M_PI * r * r;
	// atan2 instead of acos: acos loses half of the digits where the overlap is small, as contacts are.
	const double halfChord = std::sqrt((r - distance) * (r + distance));
	return r * r * std::atan2(halfChord, distance) - distance * halfChord;
}

double lensChord(double ra, double rb, double distance)
{
	if (distance >= ra + rb || distance <= std::abs(ra - rb)) return 0;
	return segmentChord(ra, chordDistance(ra, rb, distance));
}

double segmentChord(double r, double distance)
{
	return std::abs(distance) >= r ? 0 : 2 * std::sqrt((r - distance) * (r + distance));
}

double gap(const Triangulation& mesh, int a, int b, const std::vector<Disk>& grains, const Box& box)
{
	if (mesh.isWall(b)) return box.distance(mesh.wallOf(b), grains[a].centre) - grains[a].radius;
	return norm(grains[b].centre - grains[a].centre) - grains[a].radius - grains[b].radius;
}

CellPolygon cellPolygon(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box)
{
	const auto& v = mesh.cells[cell].vertex;
	CellPolygon polygon;
	for (int k = 0; k < 3; ++k) {
		if (!mesh.isWall(v[k])) {
			polygon.push_back(grains[v[k]].centre);
			continue;
		}
		const int next = v[(k + 1) % 3], previous = v[(k + 2) % 3];
		polygon.push_back(mesh.isWall(previous) ? corner(mesh.wallOf(v[k]), mesh.wallOf(previous), box)
		                                        : seenFrom(mesh, previous, v[k], grains, box));
		// Between two walls the corner is named once, by the second of them.
		if (!mesh.isWall(next)) polygon.push_back(seenFrom(mesh, next, v[k], grains, box));
	}
	return polygon;
}

Vec2 cellCentre(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box)
{
	Vec2 sum;
	const auto polygon = cellPolygon(mesh, cell, grains, box);
	for (Vec2 p : polygon)
		sum += p;
	return (1.0 / static_cast<double>(polygon.size())) * sum;
}

double voidArea(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box)
{
	const auto& v = mesh.cells[cell].vertex;
	double area = polygonArea(cellPolygon(mesh, cell, grains, box));
	for (int k = 0; k < 3; ++k) {
		const int i = v[k], next = v[(k + 1) % 3], previous = v[(k + 2) % 3];
		if (mesh.isWall(i)) continue;
		const Vec2 x = grains[i].centre;
		const Vec2 to = seenFrom(mesh, i, next, grains, box) - x;
		const Vec2 from = seenFrom(mesh, i, previous, grains, box) - x;
		const double r = grains[i].radius;
		area -= 0.5 * angleBetween(to, from) * r * r;
		// Every edge of the cell has exactly one end whose `next` it is; that of two walls has no overlap.
		area += 0.5 * overlapArea(mesh, i, next, grains, box);
		if (mesh.isWall(previous)) area += 0.5 * overlapArea(mesh, i, previous, grains, box);
	}
	return area;
}

std::vector<double> voidAreas(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box)
{
	std::vector<double> areas(mesh.cells.size());
	for (std::size_t c = 0; c < areas.size(); ++c)
		areas[c] = voidArea(mesh, static_cast<int>(c), grains, box);
	return areas;
}

VoidMoments voidMoments(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box)
{
	const auto& v = mesh.cells[cell].vertex;
	VoidMoments found = polygonMoments(cellPolygon(mesh, cell, grains, box));
	auto add = [&](const VoidMoments& part) { found.area += part.area, found.first += part.first; };
	for (int k = 0; k < 3; ++k) {
		const int i = v[k], next = v[(k + 1) % 3], previous = v[(k + 2) % 3];
		if (mesh.isWall(i)) continue;
		const Vec2 x = grains[i].centre;
		const Vec2 to = seenFrom(mesh, i, next, grains, box) - x,
		           from = seenFrom(mesh, i, previous, grains, box) - x;
		const Vec2 toSide = turned((1 / norm(to)) * to), fromSide = turned((1 / norm(from)) * from);
		const double r = grains[i].radius, sector = 0.5 * angleBetween(to, from) * r * r;
		found.area -= sector;
		found.first -= sector * x
		        + r * r * r / 3 * (toSide - fromSide);        // the integral of r^2 (cos, sin)/3 over the angle
		add(halfOverlap(mesh, i, next, toSide, grains, box)); // the cell is on the left of i -> next
		if (mesh.isWall(previous)) add(halfOverlap(mesh, i, previous, -1 * fromSide, grains, box));
	}
	found.first -= found.area * Vec2 { box.left, box.bottom };
	return found;
}

FluidForces& FluidForces::operator+=(const FluidForces& other)
{
	for (std::size_t i = 0; i < grains.size(); ++i)
		grains[i] += other.grains[i];
	for (int w = 0; w < nWalls; ++w)
		walls[w] += other.walls[w];
	return *this;
}

FluidForces fluidForces(
        const Triangulation& mesh, const std::vector<double>& pressure, const std::vector<Disk>& grains, const Box& box)
{
	FluidForces force { std::vector<Vec2>(grains.size()), {} };

	for (const Edge& e : mesh.edges) {
		const double pLeft = e.left < 0 ? 0 : pressure[e.left], pRight = e.right < 0 ? 0 : pressure[e.right];
		const double across = pLeft - pRight, meanPressure = 0.5 * (pLeft + pRight);
		if (across == 0 && meanPressure == 0) continue;
		const Disk& a = grains[e.a];
		if (mesh.isWall(e.b)) {
			const int wall = mesh.wallOf(e.b);
			const Vec2 normal = Box::outward(wall);
			const double distance = box.distance(wall, a.centre);
			const Vec2 overlap = meanPressure * segmentChord(a.radius, distance) * normal;
			force.grains[e.a] += overlap - across * distance * turned(normal);
			force.walls[wall] -= overlap;
			continue;
		}
		// The pressure difference loads the whole edge; the two grains share it where the power bisector
		// cuts the edge, which is what the sectors' change of angle amounts to.
		const Disk& b = grains[e.b];
		const Vec2 edge = b.centre - a.centre;
		const double length = norm(edge);
		const Vec2 normal = (1 / length) * edge;
		const double skew = (b.radius - a.radius) * (b.radius + a.radius) / (2 * length);
		const Vec2 overlap = meanPressure * lensChord(a.radius, b.radius, length) * normal;
		force.grains[e.a] += overlap - across * (0.5 * length - skew) * turned(normal);
		force.grains[e.b] -= overlap + across * (0.5 * length + skew) * turned(normal);
	}

	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		for (int k = 0; k < 3; ++k)
			if (mesh.isWall(mesh.cells[c].vertex[k])) {
				const int wall = mesh.wallOf(mesh.cells[c].vertex[k]);
				force.walls[wall] += pressure[c] * wallSpan(mesh, mesh.cells[c], k, grains, box)
				        * Box::outward(wall);
			}
	return force;
}

} // namespace capfrac
