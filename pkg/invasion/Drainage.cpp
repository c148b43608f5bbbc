#include "Drainage.hpp"

#include "../network/UnionFind.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace capfrac {

namespace {

	/// Throats of each domain, as one flat list (compressed rows).
	struct Incidence {
		std::vector<int> start, throat;

		Incidence(const DrainageNetwork& network)
		        : start(network.gas.size() + 1, 0)
		        , throat(2 * network.throats.size())
		{
			for (const Throat& t : network.throats)
				++start[t.left + 1], ++start[t.right + 1];
			for (std::size_t d = 0; d + 1 < start.size(); ++d)
				start[d + 1] += start[d];
			auto next = start;
			for (std::size_t t = 0; t < network.throats.size(); ++t) {
				throat[next[network.throats[t].left]++]  = static_cast<int>(t);
				throat[next[network.throats[t].right]++] = static_cast<int>(t);
			}
		}
	};

	int otherSide(const Throat& t, int domain) { return t.left == domain ? t.right : t.left; }

	/// Marks what can be reached from `seed` through the domains that `inside` accepts (explicit stack).
	template <class Inside> std::vector<std::uint8_t> reach(const DrainageNetwork& network, std::vector<std::uint8_t> seed, Inside inside)
	{
		const Incidence  incidence(network);
		std::vector<int> stack;
		for (std::size_t d = 0; d < seed.size(); ++d) {
			seed[d] = seed[d] && inside(static_cast<int>(d));
			if (seed[d]) stack.push_back(static_cast<int>(d));
		}
		while (!stack.empty()) {
			const int d = stack.back();
			stack.pop_back();
			for (int k = incidence.start[d]; k < incidence.start[d + 1]; ++k) {
				const int other = otherSide(network.throats[incidence.throat[k]], d);
				if (seed[other] || !inside(other)) continue;
				seed[other] = 1;
				stack.push_back(other);
			}
		}
		return seed;
	}

	/// Invasion without regard to trapping. `absorb`: gas that is met joins in.
	std::vector<DrainageStep> invade(const DrainageNetwork& network, const Incidence& incidence, double capillaryPressure, bool absorb, int maxSteps)
	{
		auto later = [&](int s, int t) {
			const Throat &p = network.throats[s], &q = network.throats[t];
			return std::tie(p.entryPressure, p.position.x, p.position.y) > std::tie(q.entryPressure, q.position.x, q.position.y);
		};
		std::priority_queue<int, std::vector<int>, decltype(later)> front(later);
		std::vector<std::uint8_t>                                   full = network.gas, injected = network.injected;

		// The throats of a domain that was entered; and, with it, of gas that it meets.
		std::vector<int> stack;
		auto             expose = [&](int entered) {
			stack.push_back(entered);
			while (!stack.empty()) {
				const int domain = stack.back();
				stack.pop_back();
				for (int k = incidence.start[domain]; k < incidence.start[domain + 1]; ++k) {
					const Throat& t     = network.throats[incidence.throat[k]];
					const int     other = otherSide(t, domain);
					if (!full[other]) {
						if (t.entryPressure <= capillaryPressure) front.push(incidence.throat[k]);
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
			const int     throat = front.top();
			const Throat& t      = network.throats[throat];
			front.pop();
			if (full[t.left] && full[t.right]) continue;
			const int entered = full[t.left] ? t.right : t.left;
			full[entered]     = injected[entered] = 1;
			steps.push_back({ throat, entered });
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
		const int                 nDomains = static_cast<int>(network.gas.size());
		std::vector<std::uint8_t> water(nDomains);
		for (int d = 0; d < nDomains; ++d)
			water[d] = !network.gas[d];
		for (const auto& step : drainage.steps)
			water[step.domain] = 0;

		const int outside = nDomains; // one more member stands for everything beyond the outlet
		UnionFind clusters(nDomains + 1);
		auto      putBack = [&](int d) {
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
			water[step->domain] = 1;
			putBack(step->domain);
			if (clusters.find(step->domain) == clusters.find(outside)) kept.push_back(*step);
		}
		std::reverse(kept.begin(), kept.end());
		if (static_cast<int>(kept.size()) > maxSteps) kept.resize(maxSteps);
		drainage.steps = std::move(kept);

		// What is left of the water after the kept steps, and has no outlet, is trapped.
		DrainageNetwork after = network;
		for (const auto& step : drainage.steps)
			after.gas[step.domain] = 1;
		const auto drained = connectedWater(after);
		for (int d = 0; d < nDomains; ++d)
			if (!after.gas[d] && !drained[d]) drainage.trapped.push_back(d);
	}

} // namespace

std::vector<std::uint8_t> connectedGas(const DrainageNetwork& network, const std::vector<std::uint8_t>& seed)
{
	return reach(network, seed, [&](int d) { return network.gas[d] != 0; });
}

std::vector<std::uint8_t> connectedWater(const DrainageNetwork& network)
{
	return reach(network, network.outlet, [&](int d) { return network.gas[d] == 0; });
}

Drainage drain(const DrainageNetwork& network, double capillaryPressure, bool trapping, int maxSteps)
{
	const Incidence incidence(network);
	Drainage        drainage;
	// What is trapped is known only when the whole avalanche is: its steps are counted afterwards.
	drainage.steps = invade(network, incidence, capillaryPressure, !trapping, trapping ? std::numeric_limits<int>::max() : maxSteps);
	if (trapping) keepTrapped(network, incidence, drainage, maxSteps);
	return drainage;
}

double nextEntryPressure(const DrainageNetwork& network)
{
	double lowest = std::numeric_limits<double>::infinity();
	for (const Throat& t : network.throats)
		if ((network.injected[t.left] && !network.gas[t.right]) || (network.injected[t.right] && !network.gas[t.left]))
			lowest = std::min(lowest, t.entryPressure);
	return lowest;
}

} // namespace capfrac
