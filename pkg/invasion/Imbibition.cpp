// SPDX-License-Identifier: GPL-2.0-or-later
#include "Imbibition.hpp"

#include "../network/UnionFind.hpp"
#include "Incidence.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

namespace capfrac {

namespace {

	/// Which gas hangs on an exit while domains are refilled and throats snap off.
	class HangingGas {
	public:
		HangingGas(const ImbibitionNetwork& from, const Incidence& of)
		        : network(from)
		        , incidence(of)
		        , snapped(from.throats.size())
		        , seenBy(from.gas.size(), -1)
		{
			for (std::size_t t = 0; t < snapped.size(); ++t)
				snapped[t] = network.throats[t].snapped;
			hangs = connectedGas(network, network.exit);
		}

		bool operator()(int domain) const { return hangs[domain]; }
		bool open(int throat) const { return !snapped[throat]; }

		void snap(int throat)
		{
			snapped[throat] = 1;
			settle({ network.throats[throat].left, network.throats[throat].right });
		}

		void refill(int domain)
		{
			hangs[domain] = 0;
			std::vector<int> around;
			for (int k = incidence.start[domain]; k < incidence.start[domain + 1]; ++k) {
				const int other = otherSide(network.throats[incidence.throat[k]], domain);
				if (open(incidence.throat[k]) && hangs[other]) around.push_back(other);
			}
			settle(around);
		}

	private:
		struct Search {
			std::vector<int> found; ///< in the order of a breadth-first search
			std::size_t next = 0;
			bool running() const { return next < found.size(); }
		};

		/// Finds out which of `seeds`, domains of what was one piece with an exit, still are.
		void settle(const std::vector<int>& seeds)
		{
			std::vector<Search> searches;
			for (int d : seeds) {
				if (seenBy[d] >= firstSearch) continue;
				seenBy[d] = firstSearch + static_cast<int>(searches.size());
				searches.push_back({ { d }, 0 });
			}
			const int outside = static_cast<int>(searches.size()); // stands for what lies beyond the exits
			UnionFind pieces(outside + 1);
			for (int s = 0; s < outside; ++s)
				if (network.exit[searches[s].found[0]]) pieces.join(s, outside);
			while (undecided(searches, pieces))
				for (int s = 0; s < outside; ++s)
					if (searches[s].running()) expand(searches, s, pieces);
			for (int s = 0; s < outside; ++s)
				if (cutOff(searches, pieces, s))
					for (int d : searches[s].found)
						hangs[d] = 0;
			firstSearch += outside;
		}

		void expand(std::vector<Search>& searches, int s, UnionFind& pieces)
		{
			const int d = searches[s].found[searches[s].next++];
			for (int k = incidence.start[d]; k < incidence.start[d + 1]; ++k) {
				const int other = otherSide(network.throats[incidence.throat[k]], d);
				if (!open(incidence.throat[k]) || !hangs[other]) continue;
				if (seenBy[other] >= firstSearch) {
					pieces.join(s, seenBy[other] - firstSearch);
					continue;
				}
				seenBy[other] = firstSearch + s;
				searches[s].found.push_back(other);
				if (network.exit[other]) pieces.join(s, static_cast<int>(searches.size()));
			}
		}

		/// Whether a piece was searched to its end and has no exit.
		bool cutOff(const std::vector<Search>& searches, UnionFind& pieces, int s) const
		{
			if (pieces.find(s) == pieces.find(static_cast<int>(searches.size()))) return false;
			for (std::size_t other = 0; other < searches.size(); ++other)
				if (pieces.find(static_cast<int>(other)) == pieces.find(s) && searches[other].running())
					return false;
			return true;
		}

		bool undecided(const std::vector<Search>& searches, UnionFind& pieces) const
		{
			// The pieces made up one with an exit: as soon as all others have none, the last one has it.
			std::vector<int> open;
			const int outside = static_cast<int>(searches.size());
			bool exitFound = false;
			for (int s = 0; s < outside; ++s) {
				if (pieces.find(s) == pieces.find(outside))
					exitFound = true;
				else if (!cutOff(searches, pieces, s))
					open.push_back(pieces.find(s));
			}
			std::sort(open.begin(), open.end());
			open.erase(std::unique(open.begin(), open.end()), open.end());
			return open.size() > (exitFound ? 0 : 1);
		}

		const ImbibitionNetwork& network;
		const Incidence& incidence;
		std::vector<std::uint8_t> hangs, snapped;
		std::vector<int> seenBy; ///< the search that last came to a domain; those below firstSearch are over
		int firstSearch = 0;
	};

	/// The cascade as it goes on.
	class Cascade {
	public:
		Cascade(const ImbibitionNetwork& from, double pressure, bool withFilms)
		        : network(from)
		        , capillaryPressure(pressure)
		        , films(withFilms)
		        , incidence(from)
		        , gas(from.gas)
		        , hanging(from, incidence)
		        , feeds(from.gas.size(), 0)
		        , touched(from.gas.size(), 0)
		        , queue([this](const ImbibitionStep& a, const ImbibitionStep& b) { return key(a) < key(b); })
		{
			const auto fed = connectedWater(network);
			for (int d = 0; d < static_cast<int>(gas.size()); ++d) {
				if (gas[d] && network.outlet[d]) touch(d);
				if (!gas[d] && (films || fed[d])) feed(d);
			}
			for (int t = 0; t < static_cast<int>(network.throats.size()); ++t) {
				if (network.throats[t].snapped && films) touchSides(t);
				if (mayStillSnap(t) && network.snapOff[t] > capillaryPressure) queue.push({ -1, t });
			}
		}

		std::vector<ImbibitionStep> run(int maxSteps)
		{
			std::vector<ImbibitionStep> steps;
			while (!queue.empty() && static_cast<int>(steps.size()) < maxSteps) {
				const auto step = queue.top();
				queue.pop();
				if (step.domain >= 0 ? !hanging(step.domain) : !mayStillSnap(step.throat)) continue;
				steps.push_back(step);
				if (step.domain >= 0) {
					gas[step.domain] = 0;
					hanging.refill(step.domain);
					feed(step.domain);
				} else {
					hanging.snap(step.throat);
					if (films) touchSides(step.throat);
				}
			}
			return steps;
		}

		std::vector<int> trapped() const
		{
			std::vector<int> found;
			for (int d = 0; d < static_cast<int>(gas.size()); ++d)
				if (gas[d] && !hanging(d)) found.push_back(d);
			return found;
		}

	private:
		/// What decides which step is next: the threshold, then the place from the left and from below.
		std::tuple<double, double, double, int> key(const ImbibitionStep& step) const
		{
			const bool domain = step.domain >= 0;
			const Vec2 at = domain ? network.place[step.domain] : network.throats[step.throat].position;
			return { domain ? network.refill[step.domain] : network.snapOff[step.throat], -at.x, -at.y,
				domain };
		}

		bool mayStillSnap(int t) const
		{
			return hanging.open(t) && hanging(network.throats[t].left) && hanging(network.throats[t].right);
		}

		/// Water has come to a domain of gas.
		void touch(int d)
		{
			if (touched[d] || network.exit[d]) return;
			touched[d] = 1;
			if (network.refill[d] > capillaryPressure) queue.push({ d, -1 });
		}

		void touchSides(int throat)
		{
			for (int d : { network.throats[throat].left, network.throats[throat].right })
				if (gas[d]) touch(d);
		}

		/// A domain of water hangs on the reservoir, and with it all water that it touches.
		void feed(int first)
		{
			std::vector<int> stack;
			if (!feeds[first]) feeds[first] = 1, stack.push_back(first);
			while (!stack.empty()) {
				const int d = stack.back();
				stack.pop_back();
				for (int k = incidence.start[d]; k < incidence.start[d + 1]; ++k) {
					const int other = otherSide(network.throats[incidence.throat[k]], d);
					if (gas[other])
						touch(other);
					else if (!feeds[other])
						feeds[other] = 1, stack.push_back(other);
				}
			}
		}

		const ImbibitionNetwork& network;
		double capillaryPressure;
		bool films;
		Incidence incidence;
		std::vector<std::uint8_t> gas;
		HangingGas hanging;
		std::vector<std::uint8_t> feeds, touched;
		std::priority_queue<ImbibitionStep, std::vector<ImbibitionStep>,
		        std::function<bool(const ImbibitionStep&, const ImbibitionStep&)>>
		        queue;
	};

} // namespace

Imbibition imbibe(const ImbibitionNetwork& network, double capillaryPressure, bool films, int maxSteps)
{
	Cascade cascade(network, capillaryPressure, films);
	Imbibition imbibition;
	imbibition.steps = cascade.run(maxSteps);
	imbibition.trapped = cascade.trapped();
	return imbibition;
}

} // namespace capfrac
