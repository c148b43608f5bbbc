// SPDX-License-Identifier: GPL-2.0-or-later
#include "Inlet.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace capfrac {

namespace {

	std::pair<double, double> wallEnds(const PoreNetwork& network, const InletOptions& inlet)
	{
		const int wall = wallFromName("inletWall", inlet.wall);
		const auto& box = network.box;
		if (wall == wallBottom || wall == wallTop) return { box.left, box.right };
		return { box.bottom, box.top };
	}

	std::string textOf(Vec2 p)
	{
		std::ostringstream text;
		text.precision(10);
		text << p.x << " " << p.y;
		return text.str();
	}

	/// A point in a grain stands for the pore beside it, but not all of them may: then the inlet is not where it
	/// was meant to be.
	void checkPoints(const PoreNetwork& network, const std::vector<Vec2>& points)
	{
		const auto& box = network.box;
		for (const auto& p : points)
			if (!(p.x > box.left && p.x < box.right && p.y > box.bottom && p.y < box.top))
				refuseAttribute("inletPoints [m]", textOf(p), "points inside the box");
		const auto& grains = network.grains;
		const auto holder = [&](Vec2 p) {
			return std::find_if(grains.begin(), grains.end(),
			        [&](const auto& grain) { return norm(grain.centre - p) < grain.radius; });
		};
		if (std::any_of(points.begin(), points.end(), [&](Vec2 p) { return holder(p) == grains.end(); }))
			return;
		const auto grain = holder(points.front());
		std::ostringstream allowed;
		allowed << "a point in the void, at least one; this one lies in "
		        << network.nameOf(static_cast<int>(grain - grains.begin())) << ", of radius " << grain->radius
		        << " m at (" << grain->centre.x << ", " << grain->centre.y << ") m";
		refuseAttribute("inletPoints [m]", textOf(points.front()), allowed.str());
	}

} // namespace

void reachWallEnds(const PoreNetwork& network, InletOptions& inlet)
{
	const auto [low, high] = wallEnds(network, inlet);
	if (inlet.from == -std::numeric_limits<double>::infinity()) inlet.from = low;
	if (inlet.to == std::numeric_limits<double>::infinity()) inlet.to = high;
}

void checkInlet(const PoreNetwork& network, const InletOptions& inlet)
{
	if (!inlet.points.empty()) return checkPoints(network, inlet.points);
	const auto [low, high] = wallEnds(network, inlet);
	std::ostringstream allowed;
	allowed << low << " … " << high << " m, the extent of the " << inlet.wall << " wall";
	if (!(inlet.to > inlet.from))
		refuseAttribute("no inlet: inletTo [m]", inlet.to, "> inletFrom (or give inletPoints)");
	// Half a gap of slack: a stretch found by inletStretch() may end on the wall's end.
	const double slack = 1e-9 * (high - low);
	if (!(inlet.from >= low - slack)) refuseAttribute("inletFrom [m]", inlet.from, allowed.str());
	if (!(inlet.to <= high + slack))
		refuseAttribute("the inlet is wider than its wall: inletTo [m]", inlet.to, allowed.str());
}

std::vector<int> inletDomains(const PoreNetwork& network, const InletOptions& inlet)
{
	std::set<int> found;
	for (const auto& p : inlet.points)
		found.insert(network.domainAt(p));
	if (inlet.points.empty())
		for (const auto& stretch : network.stretches(wallFromName("inletWall", inlet.wall)))
			if (stretch.middle() >= inlet.from && stretch.middle() <= inlet.to)
				found.insert(stretch.domain);
	return { found.begin(), found.end() };
}

double inletWidth(const PoreNetwork& network, const InletOptions& inlet, const std::vector<int>& domains)
{
	double width = 0;
	if (inlet.points.empty())
		for (const auto& stretch : network.stretches(wallFromName("inletWall", inlet.wall)))
			if (std::binary_search(domains.begin(), domains.end(), stretch.domain))
				width += stretch.to - stretch.from;
	return width;
}

Vec2 middleOf(const PoreNetwork& network, const InletOptions& inlet)
{
	if (!inlet.points.empty()) {
		Vec2 sum;
		for (const auto& p : inlet.points)
			sum += p;
		const double n = static_cast<double>(inlet.points.size());
		return { sum.x / n, sum.y / n };
	}
	const double middle = 0.5 * (inlet.from + inlet.to);
	return network.box.foot(wallFromName("inletWall", inlet.wall), { middle, middle });
}

std::pair<double, double> inletStretch(const PoreNetwork& network, const InletOptions& inlet, int nPores, double centre)
{
	const auto stretches = network.stretches(wallFromName("inletWall", inlet.wall));
	const int n = static_cast<int>(stretches.size());
	if (nPores < 1 || nPores > n)
		throw std::invalid_argument("nPores = " + std::to_string(nPores) + ", allowed: 1 … " + std::to_string(n)
		        + ", the number of pores along the " + inlet.wall + " wall");
	const auto off = [&](int first) {
		return std::abs(0.5 * (stretches[first].from + stretches[first + nPores - 1].to) - centre);
	};
	int best = 0;
	for (int first = 0; first + nPores <= n; ++first)
		if (off(first) < off(best)) best = first;
	return { stretches[best].from, stretches[best + nPores - 1].to };
}

} // namespace capfrac
