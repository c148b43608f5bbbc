// SPDX-License-Identifier: GPL-2.0-or-later
#include "FluidWeight.hpp"

#include <algorithm>
#include <cmath>

namespace capfrac {

namespace {

	/// What the overlap of a grain with a wall takes back; `x` is relative to the corner.
	void addWallOverlap(
	        FluidForces& force, int i, int wall, const Disk& disk, const Box& box, Vec2 corner, Vec2 weight)
	{
		const double distance = box.distance(wall, disk.centre);
		const double chord = segmentChord(disk.radius, distance);
		const Vec2 normal = Box::outward(wall);
		const Vec2 along = chord * dot(weight, box.foot(wall, disk.centre) - corner) * normal;
		force.grains[i] += segmentArea(disk.radius, distance) * weight + along;
		force.walls[wall] -= along;
	}

	/// What the overlap of two grains takes back: each its segment of the lens, and the pressure along the chord.
	void addLens(FluidForces& force, const Edge& e, const Disk& a, const Disk& b, Vec2 corner, Vec2 weight)
	{
		const double distance = norm(b.centre - a.centre);
		if (distance >= a.radius + b.radius) return;
		if (distance <= std::abs(a.radius - b.radius)) {
			const int inner = a.radius < b.radius ? e.a : e.b;
			force.grains[inner] += M_PI * std::pow(std::min(a.radius, b.radius), 2) * weight;
			return;
		}
		const Vec2 normal = (1 / distance) * (b.centre - a.centre);
		const double ha = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
		const Vec2 along = segmentChord(a.radius, ha) * dot(weight, a.centre + ha * normal - corner) * normal;
		force.grains[e.a] += segmentArea(a.radius, ha) * weight + along;
		force.grains[e.b] += segmentArea(b.radius, distance - ha) * weight - along;
	}

	/// Integral of w.(x - corner) (cos, sin) r over the arc of a disk from the direction of `from`
	/// counter-clockwise to that of `to`.
	Vec2 arcIntegral(const Disk& disk, Vec2 from, Vec2 to, Vec2 corner, Vec2 weight)
	{
		const double start = std::atan2(from.y, from.x), angle = std::atan2(cross(from, to), dot(from, to)),
		             end = start + angle;
		const double r = disk.radius;
		const Vec2 chord { std::sin(end) - std::sin(start), std::cos(start) - std::cos(end) };
		const double sc = 0.5 * (std::sin(end) * std::sin(end) - std::sin(start) * std::sin(start)),
		             twice = 0.25 * (std::sin(2 * end) - std::sin(2 * start));
		const Vec2 along { (0.5 * angle + twice) * weight.x + sc * weight.y,
			sc * weight.x + (0.5 * angle - twice) * weight.y };
		return r * dot(weight, disk.centre - corner) * chord + r * r * along;
	}

	/// Arcs of a cell's grains and its stretches of wall: what presses there.
	void addCell(FluidForces& force, const Triangulation& mesh, int cell, const std::vector<Disk>& grains,
	        const Box& box, Vec2 corner, Vec2 weight)
	{
		const auto& v = mesh.cells[cell].vertex;
		auto cornerOf = [&](int wall, int other) {
			return box.foot(mesh.wallOf(wall), box.foot(mesh.wallOf(other), corner));
		};
		for (int k = 0; k < 3; ++k) {
			const int i = v[k], next = v[(k + 1) % 3], previous = v[(k + 2) % 3];
			if (mesh.isWall(i)) {
				const int wall = mesh.wallOf(i);
				const Vec2 from = mesh.isWall(previous) ? cornerOf(i, previous)
				                                        : box.foot(wall, grains[previous].centre);
				const Vec2 to =
				        mesh.isWall(next) ? cornerOf(i, next) : box.foot(wall, grains[next].centre);
				const double span = dot(to - from, turned(Box::outward(wall)));
				force.walls[wall] +=
				        span * dot(weight, 0.5 * (from + to) - corner) * Box::outward(wall);
				continue;
			}
			auto seen = [&](int vertex) {
				return (mesh.isWall(vertex) ? box.foot(mesh.wallOf(vertex), grains[i].centre)
				                            : grains[vertex].centre)
				        - grains[i].centre;
			};
			force.grains[i] -= arcIntegral(grains[i], seen(next), seen(previous), corner, weight);
		}
	}

	/// What the two fluids on the sides of an edge press on its gap, shared by the grains as they move it.
	void addGap(FluidForces& force, const Triangulation& mesh, const Edge& e, const std::vector<Disk>& grains,
	        const Box& box, Vec2 corner, Vec2 across)
	{
		const Disk& a = grains[e.a];
		const bool wall = mesh.isWall(e.b);
		const Vec2 end = wall ? box.foot(mesh.wallOf(e.b), a.centre) : grains[e.b].centre;
		const double length = wall ? box.distance(mesh.wallOf(e.b), a.centre) : norm(end - a.centre);
		const Vec2 normal = wall ? Box::outward(mesh.wallOf(e.b)) : (1 / length) * (end - a.centre);
		const double from = a.radius, to = length - (wall ? 0 : grains[e.b].radius);
		// across.(x - corner) = p + q s at the distance s from a, times 1 or s/l.
		const double p = dot(across, a.centre - corner), q = dot(across, normal);
		auto moment = [&](int n) { return (std::pow(to, n) - std::pow(from, n)) / n; };
		const double all = p * moment(1) + q * moment(2),
		             onB = wall ? 0 : (p * moment(2) + q * moment(3)) / length;
		force.grains[e.a] -= (all - onB) * turned(normal);
		if (!wall) force.grains[e.b] -= onB * turned(normal);
	}

} // namespace

FluidForces weightForces(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box,
        const std::vector<Vec2>& weightOfCell)
{
	FluidForces force { std::vector<Vec2>(grains.size()), {} };
	const Vec2 corner { box.left, box.bottom };
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		addCell(force, mesh, static_cast<int>(c), grains, box, corner, weightOfCell[c]);
	for (const Edge& e : mesh.edges) {
		const Vec2 left = e.left < 0 ? Vec2 {} : weightOfCell[e.left],
		           right = e.right < 0 ? Vec2 {} : weightOfCell[e.right];
		addGap(force, mesh, e, grains, box, corner, left - right);
		const Vec2 mean = 0.5 * (left + right);
		if (mesh.isWall(e.b))
			addWallOverlap(force, e.a, mesh.wallOf(e.b), grains[e.a], box, corner, mean);
		else
			addLens(force, e, grains[e.a], grains[e.b], corner, mean);
	}
	return force;
}

FluidForces weightForces(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box, Vec2 weight)
{
	FluidForces force { std::vector<Vec2>(grains.size()), {} };
	const Vec2 corner { box.left, box.bottom },
	        middle { 0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top) };
	for (std::size_t i = 0; i < grains.size(); ++i)
		force.grains[i] -= M_PI * grains[i].radius * grains[i].radius * weight;
	for (const Edge& e : mesh.edges)
		if (mesh.isWall(e.b))
			addWallOverlap(force, e.a, mesh.wallOf(e.b), grains[e.a], box, corner, weight);
		else
			addLens(force, e, grains[e.a], grains[e.b], corner, weight);
	for (int w = 0; w < nWalls; ++w) {
		const double length = w == wallLeft || w == wallRight ? box.height() : box.width();
		force.walls[w] += length * dot(weight, box.foot(w, middle) - corner) * Box::outward(w);
	}
	return force;
}

} // namespace capfrac
