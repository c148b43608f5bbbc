// SPDX-License-Identifier: GPL-2.0-or-later
#include "Samples.hpp"

#include <algorithm>
#include <numeric>

namespace capfrac::samples {

namespace {

	/// Radii between 1 and `ratio`, scaled so that the disks fill `fraction` of the box; largest first.
	std::vector<double> radiiFor(Random& random, int n, const Box& box, double ratio, double fraction)
	{
		std::vector<double> radii(n);
		double area = 0;
		for (double& r : radii) {
			r = random.uniform(1, ratio);
			area += M_PI * r * r;
		}
		const double scale = std::sqrt(fraction * box.area() / area);
		for (double& r : radii)
			r *= scale;
		std::sort(radii.rbegin(), radii.rend());
		return radii;
	}

	/// Distance of the surfaces of two grains.
	double between(const Disk& a, const Disk& b) { return norm(b.centre - a.centre) - a.radius - b.radius; }

	/// Whether any pair, or any grain and a wall, is nearly in contact.
	bool nearContact(const std::vector<Disk>& grains, const Box& box, double tooClose)
	{
		for (std::size_t i = 0; i < grains.size(); ++i) {
			for (int w = 0; w < nWalls; ++w)
				if (std::abs(box.distance(w, grains[i].centre) - grains[i].radius) < tooClose)
					return true;
			for (std::size_t j = i + 1; j < grains.size(); ++j)
				if (std::abs(between(grains[i], grains[j])) < tooClose) return true;
		}
		return false;
	}

} // namespace

double Random::uniform(double low, double high) { return low + (high - low) * ((engine() + 0.5) / 4294967296.0); }

std::vector<int> Random::permutation(int n)
{
	std::vector<int> order(n);
	std::iota(order.begin(), order.end(), 0);
	for (int i = n - 1; i > 0; --i)
		std::swap(order[i], order[below(i + 1)]);
	return order;
}

std::vector<Disk> looseSample(Random& random, int n, const Box& box, double ratio)
{
	std::vector<Disk> grains;
	for (double r : radiiFor(random, n, box, ratio, n < 4 ? 0.2 : 0.35))
		for (;;) {
			const Vec2 at { random.uniform(box.left + 1.01 * r, box.right - 1.01 * r),
				random.uniform(box.bottom + 1.01 * r, box.top - 1.01 * r) };
			const Disk grain { at, r };
			if (std::any_of(grains.begin(), grains.end(),
			            [&](const Disk& g) { return between(g, grain) < 0.01 * r; }))
				continue;
			grains.push_back(grain);
			break;
		}
	return renumbered(grains, random.permutation(n));
}

std::vector<Disk> packedSample(Random& random, int n, const Box& box, double ratio)
{
	std::vector<Disk> grains;
	for (double r : radiiFor(random, n, box, ratio, 0.86))
		grains.push_back(
		        { { random.uniform(box.left + r, box.right - r), random.uniform(box.bottom + r, box.top - r) },
		                r });
	for (int sweep = 0; sweep < 400; ++sweep)
		for (int i = 0; i < n; ++i) {
			Disk& g = grains[i];
			for (int j = 0; j < i; ++j) {
				const double overlap = -between(g, grains[j]);
				if (overlap <= 0) continue;
				const Vec2 away =
				        (1 / norm(g.centre - grains[j].centre)) * (g.centre - grains[j].centre);
				g.centre += 0.25 * overlap * away;
				grains[j].centre -= 0.25 * overlap * away;
			}
			for (int w = 0; w < nWalls; ++w)
				g.centre -=
				        std::max(0.0, 0.5 * (g.radius - box.distance(w, g.centre))) * Box::outward(w);
		}
	return renumbered(grains, random.permutation(n));
}

std::vector<Disk> overlappingSample(Random& random, int columns, const Box& box, double awayFromContact)
{
	const double spacing = box.width() / columns;
	const int rows = static_cast<int>(std::lround(box.height() / spacing));
	for (;;) {
		std::vector<Disk> grains;
		for (int row = 0; row < rows; ++row)
			for (int column = 0; column < columns; ++column) {
				const Vec2 at { box.left + (column + 0.5) * spacing,
					box.bottom + (row + 0.5) * spacing };
				const Vec2 jitter { random.uniform(-0.07, 0.07), random.uniform(-0.07, 0.07) };
				grains.push_back({ at + spacing * jitter, random.uniform(0.4, 0.56) * spacing });
			}
		if (!nearContact(grains, box, awayFromContact * spacing))
			return renumbered(grains, random.permutation(columns * rows));
	}
}

std::vector<Disk> shifted(std::vector<Disk> grains, Vec2 by)
{
	for (Disk& g : grains)
		g.centre += by;
	return grains;
}

Box shifted(const Box& box, Vec2 by)
{
	return { box.left + by.x, box.right + by.x, box.bottom + by.y, box.top + by.y };
}

std::vector<Disk> renumbered(const std::vector<Disk>& grains, const std::vector<int>& order)
{
	std::vector<Disk> result;
	for (int i : order)
		result.push_back(grains[i]);
	return result;
}

} // namespace capfrac::samples
