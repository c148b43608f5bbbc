// SPDX-License-Identifier: GPL-2.0-or-later
/// geometry/VoidGeometry: areas against closed forms, their sum against the box.

#include "Samples.hpp"
#include "geometry/VoidGeometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace capfrac {

namespace {

	using samples::oblong;
	using samples::Random;

	/// The textbook lens, by two arc cosines and Heron's formula, in long double because the arc cosine
	/// loses half of its digits at small overlaps.
	long double textbookLens(long double a, long double b, long double d)
	{
		if (d >= a + b) return 0;
		const long double kite = sqrtl((-d + a + b) * (d + a - b) * (d - a + b) * (d + a + b));
		return a * a * acosl((d * d + a * a - b * b) / (2 * d * a))
		        + b * b * acosl((d * d + b * b - a * a) / (2 * d * b)) - kite / 2;
	}

	long double textbookSegment(long double r, long double d)
	{
		return d >= r ? 0 : r * r * acosl(d / r) - d * sqrtl(r * r - d * d);
	}

	/// Box less disks plus overlaps, over all pairs, with no triangulation.
	double expectedVoid(const std::vector<Disk>& grains, const Box& box)
	{
		long double sum = static_cast<long double>(box.width()) * box.height();
		for (std::size_t i = 0; i < grains.size(); ++i) {
			sum -= acosl(-1) * grains[i].radius * grains[i].radius;
			for (std::size_t j = 0; j < i; ++j)
				sum += textbookLens(
				        grains[i].radius, grains[j].radius, norm(grains[i].centre - grains[j].centre));
			for (int w = 0; w < nWalls; ++w)
				sum += textbookSegment(grains[i].radius, box.distance(w, grains[i].centre));
		}
		return static_cast<double>(sum);
	}

	double voidSum(const std::vector<Disk>& grains, const Box& box)
	{
		const auto voids = voidAreas(triangulate(grains, box), grains, box);
		return std::accumulate(voids.begin(), voids.end(), 0.0);
	}

	void expectExactVoid(const std::vector<Disk>& grains, const Box& box)
	{
		const double expected = expectedVoid(grains, box);
		EXPECT_NEAR(voidSum(grains, box), expected, 1e-12 * expected);
		// The coordinates lose digits far out, but what is left of them is a sample like any other.
		for (Vec2 far : { Vec2 { 1e6, -3e5 }, Vec2 { -123.456, 7e3 } }) {
			const auto farGrains = samples::shifted(grains, far);
			const Box farBox = samples::shifted(box, far);
			const double farExpected = expectedVoid(farGrains, farBox);
			EXPECT_NEAR(voidSum(farGrains, farBox), farExpected, 1e-12 * farExpected);
		}
	}

} // namespace

TEST(LensArea, ClosedForms)
{
	// A handful of roundings of terms of at most 4 radii squared.
	const double few = 1e-14;
	EXPECT_NEAR(lensArea(1, 1, 1), 2 * M_PI / 3 - std::sqrt(3) / 2, few);
	EXPECT_NEAR(lensArea(1, 1, std::sqrt(2)), M_PI / 2 - 1, few);
	EXPECT_NEAR(lensArea(2, 2, 2), 4 * (2 * M_PI / 3 - std::sqrt(3) / 2), 4 * few);
	EXPECT_EQ(lensArea(1, 0.5, 1.5), 0);
	EXPECT_EQ(lensArea(1, 0.5, 7), 0);
	EXPECT_EQ(lensArea(2, 0.5, 1.5), M_PI / 4) << "one within the other, touching";
	EXPECT_EQ(lensArea(2, 0.5, 0), M_PI / 4) << "concentric";
	Random random(1);
	for (int i = 0; i < 200; ++i) {
		const double a = random.uniform(0.1, 1), b = random.uniform(0.1, 1);
		const double d = random.uniform(std::abs(a - b), a + b);
		EXPECT_NEAR(lensArea(a, b, d), static_cast<double>(textbookLens(a, b, d)), few);
		EXPECT_NEAR(lensArea(a, b, d), lensArea(b, a, d), few);
	}
}

TEST(LensArea, SmallOverlapsKeepTheirDigits)
{
	// To leading order the lens of overlap u is 2/3 of chord x u, the chord 2 sqrt(2 u ab/(a+b)); the next
	// order is u/(4 r) of it at most for radii >= r. Round-off of eps r^2 against a lens of ~2 u sqrt(u r)
	// is 1.1e-7 at u = 1e-6 r, and a few of these come together.
	const double a = 1, b = 0.6, u = 1e-6;
	const double chord = 2 * std::sqrt(2 * u * a * b / (a + b));
	EXPECT_NEAR(lensChord(a, b, a + b - u), chord, 2e-6 * chord);
	EXPECT_NEAR(lensArea(a, b, a + b - u), 2.0 / 3 * chord * u, 2e-6 * chord * u);
}

TEST(SegmentArea, ClosedForms)
{
	const double few = 1e-14;
	EXPECT_NEAR(segmentArea(1, 0), M_PI / 2, few);
	EXPECT_NEAR(segmentArea(1, std::sqrt(0.5)), M_PI / 4 - 0.5, few);
	EXPECT_NEAR(segmentArea(1, -0.3) + segmentArea(1, 0.3), M_PI, few) << "the two sides of one chord";
	EXPECT_EQ(segmentArea(1, 1), 0);
	EXPECT_EQ(segmentArea(1, 1.5), 0);
	EXPECT_EQ(segmentArea(2, -2), 4 * M_PI);
}

TEST(Chords, ClosedForms)
{
	// Relative error of the root of a product of two factors of order one.
	EXPECT_NEAR(segmentChord(1, 0.6), 1.6, 1e-15);
	EXPECT_NEAR(segmentChord(1, -0.6), 1.6, 1e-15);
	EXPECT_EQ(segmentChord(1, 1), 0);
	EXPECT_EQ(segmentChord(1, -1.1), 0);
	EXPECT_NEAR(lensChord(5, 5, 8), 6, 1e-14) << "two triangles 3-4-5";
	EXPECT_NEAR(lensChord(13, 15, 14), 24, 1e-13) << "triangle 13-14-15 has the height 12 on 14";
	EXPECT_EQ(lensChord(1, 2, 3), 0);
	EXPECT_EQ(lensChord(1, 3, 2), 0) << "touching from within";
}

TEST(Chords, AreTheDerivativesOfTheAreas)
{
	// Central difference of step h: h^2/6 of the third derivative of the area, below 100/r here (overlaps
	// above r/50), makes 2e-11; round-off eps r^2 / h makes 3e-11 with its factors.
	const double h = 1e-6, tolerance = 1e-9;
	Random random(2);
	for (int i = 0; i < 200; ++i) {
		const double a = random.uniform(0.5, 1), b = random.uniform(0.5, 1);
		const double d = random.uniform(std::abs(a - b) + 0.02, a + b - 0.02);
		EXPECT_NEAR((lensArea(a, b, d - h) - lensArea(a, b, d + h)) / (2 * h), lensChord(a, b, d), tolerance);
		const double w = random.uniform(-a + 0.02, a - 0.02);
		EXPECT_NEAR((segmentArea(a, w - h) - segmentArea(a, w + h)) / (2 * h), segmentChord(a, w), tolerance);
	}
}

TEST(VoidArea, SingleCells)
{
	const std::vector<Disk> one { { { 1, 2 }, 0.5 } };
	const Box box { 0, 4, 0, 3 };
	const auto alone = triangulate(one, box);
	for (int c = 0; c < 4; ++c) {
		const auto& v = alone.cells[c].vertex;
		const double width = v[1] == 1 + wallLeft || v[2] == 1 + wallLeft ? 1 : 3;
		const double height = v[1] == 1 + wallBottom || v[2] == 1 + wallBottom ? 2 : 1;
		EXPECT_NEAR(voidArea(alone, c, one, box), width * height - M_PI / 16, 1e-14);
		const Vec2 centre = cellCentre(alone, c, one, box);
		EXPECT_NEAR(std::abs(centre.x - 1), width / 2, 1e-15);
		EXPECT_NEAR(std::abs(centre.y - 2), height / 2, 1e-15);
	}

	// Three grains of radius 1/2 in contact: the cell between them holds sqrt(3)/4 less half a disk.
	const std::vector<Disk> three { { { -0.5, 0 }, 0.5 }, { { 0.5, 0 }, 0.5 }, { { 0, std::sqrt(3) / 2 }, 0.5 } };
	const Box around { -3, 3, -3, 3 };
	const auto mesh = triangulate(three, around);
	ASSERT_EQ(mesh.cells[0].vertex, (std::array<int, 3> { 0, 1, 2 }));
	EXPECT_NEAR(voidArea(mesh, 0, three, around), std::sqrt(3) / 4 - M_PI / 8, 1e-15);
	const int below = mesh.nGrains + wallBottom;
	const auto atWall = std::find_if(mesh.cells.begin(), mesh.cells.end(), [=](const Cell& c) {
		return c.vertex == std::array<int, 3> { 0, below, 1 };
	});
	ASSERT_NE(atWall, mesh.cells.end());
	const int rectangle = static_cast<int>(atWall - mesh.cells.begin()); // 1 x 3 less two quarters of a disk
	EXPECT_NEAR(voidArea(mesh, rectangle, three, around), 3 - M_PI / 8, 1e-14);
	EXPECT_NEAR(gap(mesh, 0, 1, three, around), 0, 1e-15);
	EXPECT_NEAR(gap(mesh, 0, below, three, around), 2.5, 1e-15);
}

/// 1e-12 of the void: some 2n cells, each rounded by about 20 eps of its size, whose sum is the box.
TEST(VoidArea, SumIsBoxLessDisksPlusOverlaps)
{
	for (unsigned seed = 1; seed <= 5; ++seed) {
		Random random(seed);
		for (double ratio : { 1.0, 2.0, 10.0 })
			expectExactVoid(samples::looseSample(random, 100, oblong, ratio), oblong);
		for (double ratio : { 1.0, 1.67, 2.0 })
			expectExactVoid(samples::packedSample(random, 60, oblong, ratio), oblong);
		expectExactVoid(samples::overlappingSample(random, 6, oblong, 0), oblong);
	}
	expectExactVoid({ { { 3, 0 }, 0.5 } }, oblong);
	expectExactVoid({ { { 1.75, 0 }, 0.5 } }, oblong);      // through the left wall
	expectExactVoid({ { { 1.75, -1.75 }, 0.25 } }, oblong); // touching two walls
}

TEST(VoidArea, ScalesWithTheSquareOfTheLengthBitForBit)
{
	Random random(9);
	auto grains = samples::overlappingSample(random, 6, oblong, 0);
	const auto before = voidAreas(triangulate(grains, oblong), grains, oblong);
	const double scale = 1.0 / 1024; // a power of two rounds nothing: metres to about millimetres
	const Box box { scale * oblong.left, scale * oblong.right, scale * oblong.bottom, scale * oblong.top };
	for (Disk& g : grains)
		g = { scale * g.centre, scale * g.radius };
	const auto after = voidAreas(triangulate(grains, box), grains, box);
	ASSERT_EQ(after.size(), before.size());
	for (std::size_t c = 0; c < after.size(); ++c)
		EXPECT_EQ(after[c], scale * scale * before[c]);
}

namespace {

	/// Moments of the void by counting points of a grid, `n` to a side of the box; a point is in the void when no
	/// disk covers it.
	VoidMoments counted(const Triangulation& mesh, int cell, const std::vector<Disk>& grains, const Box& box, int n)
	{
		const auto polygon = cellPolygon(mesh, cell, grains, box);
		const double dx = box.width() / n, dy = box.height() / n;
		VoidMoments sum;
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j) {
				const Vec2 p { box.left + (i + 0.5) * dx, box.bottom + (j + 0.5) * dy };
				bool inside = true;
				for (std::size_t k = 0; inside && k < polygon.size(); ++k)
					inside = cross(polygon[(k + 1) % polygon.size()] - polygon[k], p - polygon[k])
					        >= 0;
				for (std::size_t g = 0; inside && g < grains.size(); ++g)
					inside = norm(p - grains[g].centre) >= grains[g].radius;
				if (!inside) continue;
				sum.area += dx * dy;
				sum.first += dx * dy * (p - Vec2 { box.left, box.bottom });
			}
		return sum;
	}

} // namespace

TEST(VoidMoments, AreThoseOfThePointsThatNoDiskCovers)
{
	samples::Random random(21);
	const auto grains = samples::looseSample(random, 12, samples::oblong, 2);
	const auto mesh = triangulate(grains, samples::oblong);
	for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
		const auto exact = voidMoments(mesh, c, grains, samples::oblong),
		           found = counted(mesh, c, grains, samples::oblong, 600);
		EXPECT_EQ(exact.area, voidArea(mesh, c, grains, samples::oblong)) << "cell " << c;
		// Grid points next to a border of some 5 m, spaced 6 mm, fall on either side of it at random: 6e-3
		// sqrt(5 * 6e-3) = 1e-3; arms of up to 4 m.
		EXPECT_NEAR(exact.area, found.area, 3e-3);
		EXPECT_NEAR(exact.first.x, found.first.x, 8e-3);
		EXPECT_NEAR(exact.first.y, found.first.y, 8e-3);
	}
}

TEST(VoidMoments, AddUpToTheBoxLessTheDisksPlusTheirOverlaps)
{
	samples::Random random(22);
	for (double away : { 0.0, 1e-3 }) {
		const auto grains = samples::overlappingSample(random, 6, samples::oblong, away);
		const auto mesh = triangulate(grains, samples::oblong);
		const Box& box = samples::oblong;
		const Vec2 corner { box.left, box.bottom };
		VoidMoments sum;
		Vec2 expected { 0.5 * box.area() * box.width(), 0.5 * box.area() * box.height() };
		for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
			const auto one = voidMoments(mesh, c, grains, box);
			EXPECT_EQ(one.area, voidArea(mesh, c, grains, box)) << "cell " << c;
			sum.area += one.area, sum.first += one.first;
		}
		for (const Disk& g : grains)
			expected -= M_PI * g.radius * g.radius * (g.centre - corner);
		for (const Edge& e : mesh.edges) {
			const Disk& a = grains[e.a];
			if (mesh.isWall(e.b)) { // a segment: its area at the centre and two thirds of the half chord
				                // cubed outwards
				const double d = box.distance(mesh.wallOf(e.b), a.centre),
				             h = 0.5 * segmentChord(a.radius, d);
				expected += segmentArea(a.radius, d) * (a.centre - corner)
				        + 2 * h * h * h / 3 * Box::outward(mesh.wallOf(e.b));
				continue;
			}
			// A lens: the moments of its two segments along the axis cancel.
			const Disk& b = grains[e.b];
			const double d = norm(b.centre - a.centre),
			             ha = (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d);
			if (d >= a.radius + b.radius) continue;
			expected += segmentArea(a.radius, ha) * (a.centre - corner)
			        + segmentArea(b.radius, d - ha) * (b.centre - corner);
		}
		// Some hundred terms of up to 10 m^3.
		EXPECT_NEAR(sum.first.x, expected.x, 1e-12);
		EXPECT_NEAR(sum.first.y, expected.y, 1e-12);
	}
}

} // namespace capfrac
