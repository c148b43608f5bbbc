// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Plain shapes of the two-dimensional model: points, disks and the box of four walls.
///
/// Why not Eigen's vectors: the engines are compiled with the alignment macros of the host YADE, the
/// kernels are not, so an Eigen type must not cross from one to the other. Two doubles always may.

#include <cmath>

namespace capfrac {

/// A point or a vector in the plane of the model [m] (or [N], as the function that returns it says).
struct Vec2 {
	double x = 0;
	double y = 0;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return { a.x + b.x, a.y + b.y }; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return { a.x - b.x, a.y - b.y }; }
inline Vec2 operator*(double s, Vec2 a) { return { s * a.x, s * a.y }; }
inline Vec2& operator+=(Vec2& a, Vec2 b) { return a = a + b; }
inline Vec2& operator-=(Vec2& a, Vec2 b) { return a = a - b; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// `a` turned counter-clockwise by a right angle.
inline Vec2 turned(Vec2 a) { return { -a.y, a.x }; }

/// A grain: a disk of unit thickness.
struct Disk {
	Vec2 centre;       ///< [m]
	double radius = 0; ///< [m], > 0
};

/// The four walls, in YADE's order of axes: two of x, then two of y.
enum Wall { wallLeft = 0, wallRight = 1, wallBottom = 2, wallTop = 3 };
constexpr int nWalls = 4;

/// The box of four walls that holds the sample. All in [m]; left < right, bottom < top.
struct Box {
	double left = 0, right = 0, bottom = 0, top = 0;

	double width() const { return right - left; }
	double height() const { return top - bottom; }
	double area() const { return width() * height(); }

	/// Distance of `p` from the wall [m], positive inside the box.
	double distance(int wall, Vec2 p) const
	{
		switch (wall) {
		case wallLeft:
			return p.x - left;
		case wallRight:
			return right - p.x;
		case wallBottom:
			return p.y - bottom;
		default:
			return top - p.y;
		}
	}

	/// The point of the wall nearest to `p` [m].
	Vec2 foot(int wall, Vec2 p) const
	{
		switch (wall) {
		case wallLeft:
			return { left, p.y };
		case wallRight:
			return { right, p.y };
		case wallBottom:
			return { p.x, bottom };
		default:
			return { p.x, top };
		}
	}

	/// Unit vector from the inside towards the wall [-].
	static Vec2 outward(int wall)
	{
		constexpr Vec2 normals[nWalls] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
		return normals[wall];
	}
};

} // namespace capfrac
