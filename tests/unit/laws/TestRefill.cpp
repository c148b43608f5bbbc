// SPDX-License-Identifier: GPL-2.0-or-later
/// laws/Refill: widest places of cells, and the pressures below which water comes back.

#include "Samples.hpp"
#include "laws/EntryPressure.hpp"
#include "laws/Refill.hpp"

#include <gtest/gtest.h>

namespace capfrac {

namespace {

	using samples::oblong;

	/// Distance of a point to the nearest disk or mirror image of one.
	double room(Vec2 p, const std::vector<Disk>& grains, const Box& box)
	{
		double nearest = 1e9;
		for (const Disk& g : grains) {
			nearest = std::min(nearest, norm(p - g.centre) - g.radius);
			for (int w = 0; w < nWalls; ++w) {
				const Vec2 image = 2 * box.foot(w, g.centre) - g.centre;
				nearest = std::min(nearest, norm(p - image) - g.radius);
			}
		}
		return nearest;
	}

} // namespace

TEST(TouchingCircle, TouchesThreeUnequalDisks)
{
	samples::Random random(5);
	for (int k = 0; k < 200; ++k) {
		const Disk a { { 0, 0 }, random.uniform(0.5, 1) },
		        b { { random.uniform(1.9, 2.5), 0 }, random.uniform(0.5, 1) },
		        c { { random.uniform(0.5, 1.5), random.uniform(1.8, 2.5) }, random.uniform(0.5, 1) };
		const auto circle = touchingCircle(a, b, c);
		for (const Disk& disk : { a, b, c }) // a few roundings of numbers of order one
			EXPECT_NEAR(norm(circle.centre - disk.centre), circle.radius + disk.radius, 1e-13);
	}
}

TEST(TouchingCircle, EqualDisksHaveTheCircumcentre)
{
	const auto circle = touchingCircle({ { 0, 0 }, 1 }, { { 2, 0 }, 1 }, { { 1, std::sqrt(3) }, 1 });
	EXPECT_NEAR(circle.radius, 2 / std::sqrt(3) - 1, 1e-15);
	EXPECT_NEAR(circle.centre.y, 1 / std::sqrt(3), 1e-15);
}

TEST(BodyRadius, ClosedForms)
{
	// The centre of mass of the triangle is 2 r/sqrt(3) off its corners; the square's is sqrt(2) r.
	EXPECT_NEAR(bodyRadius(2 / std::sqrt(3) - 1, 1), std::sqrt(7.0 / 3) - 1, 1e-15);
	EXPECT_NEAR(bodyRadius(std::sqrt(2) - 1, 1), std::sqrt(3) - 1, 1e-15);
	EXPECT_EQ(bodyRadius(0.05, 1.5), inscribedRadius(0.1, 1.5)) << "a throat is the body between two grains";
}

/// On random packs the circle is as large as the room there is, and what is said to be outside of the cell is.
TEST(PoreBody, IsTheWidestPlaceOfTheCell)
{
	int nBodies = 0, nNone = 0;
	for (unsigned seed = 1; seed <= 5; ++seed) {
		samples::Random random(seed);
		const auto grains = samples::looseSample(
		        random, 30, oblong, 1.001); // nearly equal: the power and the touching circle are one
		const auto mesh = triangulate(grains, oblong);
		for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
			const auto body = poreBody(mesh, c, grains, oblong);
			double r = 0;
			int n = 0;
			for (int v : mesh.cells[c].vertex)
				if (!mesh.isWall(v)) r += grains[v].radius, ++n;
			r /= n;
			if (body.radius == 0) {
				++nNone;
				continue;
			}
			++nBodies;
			// Radii differ by a thousandth: so may the circle of the three and the room at its centre.
			EXPECT_NEAR(body.radius, bodyRadius(room(body.centre, grains, oblong), r), 2e-3 * r)
			        << "cell " << c << " seed " << seed;
		}
	}
	EXPECT_GT(nBodies, 100);
	EXPECT_GT(nNone, 20);
}

TEST(PoreBody, AtWallsGrainsMeetTheirImages)
{
	const Box box { 0, 6, 0, 4 };
	const std::vector<Disk> grains { { { 1.5, 1 }, 1 }, { { 4.2, 1.2 }, 0.8 } };
	const auto mesh = triangulate(grains, box);
	int nWall = 0, nCorner = 0;
	for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
		const auto body = poreBody(mesh, c, grains, box);
		int disks = 0;
		for (int v : mesh.cells[c].vertex)
			disks += !mesh.isWall(v);
		if (disks == 1) {
			++nCorner;
			const bool left = body.centre.x == 0;
			const Disk& g = grains[left ? 0 : 1];
			EXPECT_NEAR(body.radius, bodyRadius(norm(body.centre - g.centre) - g.radius, g.radius), 1e-14);
		} else if (body.radius > 0) {
			++nWall;
			const double s = norm(body.centre - grains[0].centre) - 1;
			EXPECT_NEAR(s, norm(body.centre - grains[1].centre) - 0.8, 1e-14);
			EXPECT_TRUE(body.centre.y == 0 || body.centre.y == 4);
			EXPECT_NEAR(body.radius, bodyRadius(s, 0.9), 1e-14);
		}
	}
	EXPECT_EQ(nWall, 2);
	EXPECT_EQ(nCorner, 4);
}

TEST(ImbibitionPressures, AgainstTheEntryPressure)
{
	const double entry = inscribedSphereEntryPressure(0, 1e-3, 0.05, 0), rIn = inscribedRadius(0, 1e-3);
	EXPECT_DOUBLE_EQ(refillPressure(rIn, 0.05, 0), entry) << "in a straight pore there is no hysteresis";
	EXPECT_DOUBLE_EQ(snapOffPressure(rIn, 0.05, 0), 0.5 * entry);
	// cos 30 - sin 30 = (sqrt(3) - 1)/2, of twice cos 30 = sqrt(3).
	EXPECT_NEAR(snapOffPressure(rIn, 0.05, M_PI / 6) / inscribedSphereEntryPressure(0, 1e-3, 0.05, M_PI / 6),
	        (std::sqrt(3) - 1) / (2 * std::sqrt(3)), 1e-15);
	EXPECT_NEAR(snapOffPressure(rIn, 0.05, M_PI / 4 - 1e-9), 0, 1e-6) << "the end of the law";
}

TEST(ImbibitionPressures, RefuseWhatTheyAreNotFor)
{
	EXPECT_THROW(snapOffPressure(1e-3, 0.05, M_PI / 4), EntryLawError);
	EXPECT_THROW(snapOffPressure(0, 0.05, 0), EntryLawError);
	EXPECT_THROW(refillPressure(1e-3, 0, 0), EntryLawError);
	EXPECT_THROW(refillPressure(1e-3, 0.05, M_PI / 2), EntryLawError);
	EXPECT_THROW(refillPressure(std::nan(""), 0.05, 0), EntryLawError);
}

} // namespace capfrac
