#include "FluidWeight.hpp"

#include <algorithm>
#include <cmath>

namespace capfrac {

namespace {

	/// What the overlap of a grain with a wall takes back; `x` is relative to the corner.
	void addWallOverlap(FluidForces& force, int i, int wall, const Disk& disk, const Box& box, Vec2 corner, Vec2 weight)
	{
		const double distance = box.distance(wall, disk.centre);
		const double chord    = segmentChord(disk.radius, distance);
		const Vec2   normal   = Box::outward(wall);
		const Vec2   along    = chord * dot(weight, box.foot(wall, disk.centre) - corner) * normal;
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
		const Vec2   normal = (1 / distance) * (b.centre - a.centre);
		const double ha     = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
		const Vec2   along  = segmentChord(a.radius, ha) * dot(weight, a.centre + ha * normal - corner) * normal;
		force.grains[e.a] += segmentArea(a.radius, ha) * weight + along;
		force.grains[e.b] += segmentArea(b.radius, distance - ha) * weight - along;
	}

} // namespace

FluidForces weightForces(const Triangulation& mesh, const std::vector<Disk>& grains, const Box& box, Vec2 weight)
{
	FluidForces force { std::vector<Vec2>(grains.size()), {} };
	const Vec2  corner { box.left, box.bottom }, middle { 0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top) };
	for (std::size_t i = 0; i < grains.size(); ++i)
		force.grains[i] -= M_PI * grains[i].radius * grains[i].radius * weight;
	for (const Edge& e : mesh.edges)
		if (mesh.isWall(e.b)) addWallOverlap(force, e.a, mesh.wallOf(e.b), grains[e.a], box, corner, weight);
		else
			addLens(force, e, grains[e.a], grains[e.b], corner, weight);
	for (int w = 0; w < nWalls; ++w) {
		const double length = w == wallLeft || w == wallRight ? box.height() : box.width();
		force.walls[w] += length * dot(weight, box.foot(w, middle) - corner) * Box::outward(w);
	}
	return force;
}

} // namespace capfrac
