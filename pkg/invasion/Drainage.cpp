// SPDX-License-Identifier: GPL-2.0-or-later
#include "Drainage.hpp"

#include "../network/UnionFind.hpp"
#include "Incidence.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace capfrac {

namespace {

	/// Marks what can be reached from `seed` through the domains that `inside` and the throats that `passes`
	/// accepts (explicit stack).
	template <class Inside, class Passes> std::vector<std::uint8_t> reach(const DrainageNetwork& network,
	        const Incidence& incidence, std::vector<std::uint8_t> seed, Inside inside, Passes passes)
	{
		std::vector<int> stack;
		for (std::size_t d = 0; d < seed.size(); ++d) {
			seed[d] = seed[d] && inside(static_cast<int>(d));
			if (seed[d]) stack.push_back(static_cast<int>(d));
		}
		while (!stack.empty()) {
			const int d = stack.back();
			stack.pop_back();
			for (int k = incidence.start[d]; k < incidence.start[d + 1]; ++k) {
				const Throat& t = network.throats[incidence.throat[k]];
				const int other = otherSide(t, d);
				if (seed[other] || !inside(other) || !passes(t)) continue;
				seed[other] = 1;
				stack.push_back(other);
			}
		}
		return seed;
	}

	/// Invasion without regard to trapping. `absorb`: gas that is met joins in.
	std::vector<DrainageStep> invade(const DrainageNetwork& network, const Incidence& incidence,
	        double capillaryPressure, bool absorb, int maxSteps, bool untilOutlet)
	{
		// The entry pressure is kept beside the throat: networks of a million throats fit no cache, and looking
		// it up took a third of the time.
		struct Waiting {
			double entryPressure;
			int throat;
		};
		auto later = [&](const Waiting& s, const Waiting& t) {
			if (s.entryPressure != t.entryPressure) return s.entryPressure > t.entryPressure;
			const Vec2 p = network.throats[s.throat].position, q = network.throats[t.throat].position;
			return std::tie(p.x, p.y) > std::tie(q.x, q.y);
		};
		std::priority_queue<Waiting, std::vector<Waiting>, decltype(later)> front(later);
		std::vector<std::uint8_t> full = network.gas, injected = network.injected,
		                          opened(network.throats.size(), 0);

		// The throats of a domain that was entered; and, with it, of gas that it meets.
		std::vector<int> stack;
		auto expose = [&](int entered) {
			stack.push_back(entered);
			while (!stack.empty()) {
				const int domain = stack.back();
				stack.pop_back();
				for (int k = incidence.start[domain]; k < incidence.start[domain + 1]; ++k) {
					const Throat& t = network.throats[incidence.throat[k]];
					const int other = otherSide(t, domain);
					if (!full[other] || (t.snapped && !opened[incidence.throat[k]])) {
						if (t.entryPressure <= capillaryPressure)
							front.push({ t.entryPressure, incidence.throat[k] });
					} else if (absorb && !injected[other]) {
						injected[other] = 1;
						stack.push_back(other);
					}
				}
			}
		};
		for (std::size_t d = 0; d < full.size(); ++d)
			if (network.injected[d]) expose(static_cast<int>(d));

		std::vector<DrainageStep> steps;
		while (!front.empty() && static_cast<int>(steps.size()) < maxSteps) {
			const int throat = front.top().throat;
			const Throat& t = network.throats[throat];
			front.pop();
			if (full[t.left] && full[t.right]) {
				if (!t.snapped || opened[throat]) continue;
				opened[throat] = 1;
				steps.push_back({ throat, -1 });
				for (int side : { t.left, t.right })
					if (absorb && !injected[side]) {
						injected[side] = 1;
						expose(side);
					}
				continue;
			}
			const int entered = full[t.left] ? t.right : t.left;
			full[entered] = injected[entered] = 1;
			steps.push_back({ throat, entered });
			// An outlet is never trapped, so what comes later decides neither on this step nor on those
			// before it.
			if (untilOutlet && network.outlet[entered]) break;
			expose(entered);
		}
		return steps;
	}

	/// Takes the steps into trapped water out again and lists that water.
	///
	/// Domains are put back in the reverse order of their invasion while a union-find keeps track of what
	/// water hangs together: a step was into trapped water when its domain, put back, has no outlet (the
	/// two-step method of Masson 2016, doi:10.1016/j.cageo.2016.02.003). Leaving such a step out cannot
	/// change a later one, because what lies behind it is trapped with it.
	void keepTrapped(const DrainageNetwork& network, const Incidence& incidence, Drainage& drainage, int maxSteps)
	{
		const int nDomains = static_cast<int>(network.gas.size());
		std::vector<std::uint8_t> water(nDomains);
		for (int d = 0; d < nDomains; ++d)
			water[d] = !network.gas[d];
		for (const auto& step : drainage.steps)
			if (step.domain >= 0) water[step.domain] = 0;

		const int outside = nDomains; // one more member stands for everything beyond the outlet
		UnionFind clusters(nDomains + 1);
		auto putBack = [&](int d) {
			if (network.outlet[d]) clusters.join(d, outside);
			for (int k = incidence.start[d]; k < incidence.start[d + 1]; ++k) {
				const int other = otherSide(network.throats[incidence.throat[k]], d);
				if (water[other]) clusters.join(d, other);
			}
		};
		for (int d = 0; d < nDomains; ++d)
			if (water[d]) putBack(d);

		std::vector<DrainageStep> kept;
		for (auto step = drainage.steps.rbegin(); step != drainage.steps.rend(); ++step) {
			if (step->domain < 0) { // between gas and gas: no water to be trapped
				kept.push_back(*step);
				continue;
			}
			water[step->domain] = 1;
			putBack(step->domain);
			if (clusters.find(step->domain) == clusters.find(outside)) kept.push_back(*step);
		}
		std::reverse(kept.begin(), kept.end());
		if (static_cast<int>(kept.size()) > maxSteps) kept.resize(maxSteps);
		drainage.steps = std::move(kept);

		// What is left of the water after the kept steps, and has no outlet, is trapped.
		auto gas = network.gas;
		for (const auto& step : drainage.steps)
			if (step.domain >= 0) gas[step.domain] = 1;
		const auto drained = reach(
		        network, incidence, network.outlet, [&](int d) { return gas[d] == 0; },
		        [](const Throat&) { return true; });
		for (int d = 0; d < nDomains; ++d)
			if (!gas[d] && !drained[d]) drainage.trapped.push_back(d);
	}

} // namespace

std::vector<std::uint8_t> connectedGas(const DrainageNetwork& network, const std::vector<std::uint8_t>& seed)
{
	return reach(
	        network, Incidence(network), seed, [&](int d) { return network.gas[d] != 0; },
	        [](const Throat& t) { return !t.snapped; });
}

std::vector<std::uint8_t> connectedWater(const DrainageNetwork& network)
{
	return reach(
	        network, Incidence(network), network.outlet, [&](int d) { return network.gas[d] == 0; },
	        [](const Throat&) { return true; });
}

Drainage drain(const DrainageNetwork& network, double capillaryPressure, bool trapping, int maxSteps, bool untilOutlet)
{
	const Incidence incidence(network);
	Drainage drainage;
	// What is trapped is known only when the whole avalanche is: its steps are counted afterwards.
	drainage.steps = invade(network, incidence, capillaryPressure, !trapping,
	        trapping ? std::numeric_limits<int>::max() : maxSteps, untilOutlet);
	if (trapping) keepTrapped(network, incidence, drainage, maxSteps);
	return drainage;
}

double nextEntryPressure(const DrainageNetwork& network)
{
	double lowest = std::numeric_limits<double>::infinity();
	auto meets = [&](const Throat& t, int from, int to) {
		return network.injected[from] && (!network.gas[to] || (t.snapped && !network.injected[to]));
	};
	for (const Throat& t : network.throats)
		if (meets(t, t.left, t.right) || meets(t, t.right, t.left)) lowest = std::min(lowest, t.entryPressure);
	return lowest;
}

} // namespace capfrac
