// SPDX-License-Identifier: GPL-2.0-or-later
#include "Refill.hpp"
#include "EntryPressure.hpp"
#include "Refusal.hpp"

#include <limits>
#include <sstream>

namespace capfrac {

namespace {

	// Written so that NaN fails every test.
	void checkBody(double radius, double tension, double contactAngle)
	{
		if (!(radius > 0)) refuse<EntryLawError>("radius of the largest sphere [m]", radius, "> 0");
		if (!(tension > 0)) refuse<EntryLawError>("interfacial tension [N/m]", tension, "> 0");
		if (!(contactAngle >= 0 && contactAngle < M_PI / 2))
			refuse<EntryLawError>("contact angle [rad]", contactAngle, "0 <= angle < pi/2 (water wets)");
	}

	bool inside(const CellPolygon& polygon, Vec2 p)
	{
		for (std::size_t k = 0; k < polygon.size(); ++k)
			if (cross(polygon[(k + 1) % polygon.size()] - polygon[k], p - polygon[k]) < 0) return false;
		return true;
	}

	/// The place on a wall between two grains that is as far from the one as from the other, by bisection: the
	/// difference of the two distances grows all the way from the foot of `a` to that of `b`. NaN where it has no
	/// root between them.
	PoreBody circleOnWall(const Disk& a, const Disk& b, Vec2 footA, Vec2 footB)
	{
		auto place = [&](double t) { return footA + t * (footB - footA); };
		auto from = [&](const Disk& disk, double t) { return norm(place(t) - disk.centre) - disk.radius; };
		double low = 0, high = 1;
		if (from(a, low) > from(b, low) || from(a, high) < from(b, high))
			return { std::numeric_limits<double>::quiet_NaN(), {} };
		for (int k = 0; k < 60; ++k) { // 2^-60 of the stretch is below round-off
			const double middle = 0.5 * (low + high);
			(from(a, middle) <= from(b, middle) ? low : high) = middle;
		}
		return { from(a, low), place(low) };
	}

} // namespace

PoreBody touchingCircle(const Disk& a, const Disk& b, const Disk& c)
{
	const Vec2 toB = b.centre - a.centre, toC = c.centre - a.centre;
	const double twice = cross(toB, toC);
	// toB.c = alphaB - s betaB, likewise for C.
	const double betaB = b.radius - a.radius, betaC = c.radius - a.radius;
	const double alphaB = 0.5 * (dot(toB, toB) - betaB * (b.radius + a.radius)),
	             alphaC = 0.5 * (dot(toC, toC) - betaC * (c.radius + a.radius));
	const Vec2 u = (1 / twice) * Vec2 { alphaB * toC.y - alphaC * toB.y, alphaC * toB.x - alphaB * toC.x };
	const Vec2 v = (1 / twice) * Vec2 { betaB * toC.y - betaC * toB.y, betaC * toB.x - betaB * toC.x };
	// In this form the root of the outer circle stays exact where v -> 0 (equal disks).
	const double p = dot(u, v) + a.radius, q = dot(u, u) - a.radius * a.radius;
	const double s = q / (p + std::sqrt(p * p + (1 - dot(v, v)) * q));
	return { s, a.centre + u - s * v };
}

double bodyRadius(double s, double r) { return inscribedRadius(2 * s, r); }

PoreBody poreBody(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box)
{
	std::vector<int> disks, walls;
	for (int v : mesh.cells[cell].vertex)
		(mesh.isWall(v) ? walls : disks).push_back(v);
	double sumOfRadii = 0;
	for (int i : disks)
		sumOfRadii += grains[i].radius;
	const double r = sumOfRadii / disks.size();
	PoreBody circle;
	if (walls.empty()) {
		circle = touchingCircle(grains[disks[0]], grains[disks[1]], grains[disks[2]]);
		if (!inside(cellPolygon(mesh, cell, grains, box), circle.centre)) return {};
	} else if (disks.size() == 2) {
		const int wall = mesh.wallOf(walls[0]);
		circle = circleOnWall(grains[disks[0]], grains[disks[1]], box.foot(wall, grains[disks[0]].centre),
		        box.foot(wall, grains[disks[1]].centre));
	} else {
		const Disk& grain = grains[disks[0]];
		circle.centre = box.foot(mesh.wallOf(walls[0]), box.foot(mesh.wallOf(walls[1]), grain.centre));
		circle.radius = norm(circle.centre - grain.centre) - grain.radius;
	}
	if (!(circle.radius > -r)) return {}; // NaN, too
	return { bodyRadius(circle.radius, r), circle.centre };
}

double refillPressure(double radius, double tension, double contactAngle)
{
	checkBody(radius, tension, contactAngle);
	return 2 * tension * std::cos(contactAngle) / radius;
}

double snapOffPressure(double radius, double tension, double contactAngle)
{
	checkBody(radius, tension, contactAngle);
	if (!(contactAngle + snapOffCorner < M_PI / 2))
		refuse<EntryLawError>("contact angle [rad]", contactAngle,
		        "< pi/4 with snap-off (films in corners of 45 degrees swell below that only)");
	return tension / radius * (std::cos(contactAngle) - std::sin(contactAngle) * std::tan(snapOffCorner));
}

} // namespace capfrac
