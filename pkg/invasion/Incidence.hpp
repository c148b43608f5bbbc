// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Drainage.hpp"

namespace capfrac {

/// Throats of each domain, as one flat list (compressed rows).
struct Incidence {
	std::vector<int> start, throat;

	explicit Incidence(const DrainageNetwork& network)
	        : start(network.gas.size() + 1, 0)
	        , throat(2 * network.throats.size())
	{
		for (const Throat& t : network.throats)
			++start[t.left + 1], ++start[t.right + 1];
		for (std::size_t d = 0; d + 1 < start.size(); ++d)
			start[d + 1] += start[d];
		auto next = start;
		for (std::size_t t = 0; t < network.throats.size(); ++t) {
			throat[next[network.throats[t].left]++] = static_cast<int>(t);
			throat[next[network.throats[t].right]++] = static_cast<int>(t);
		}
	}
};

/// The domain on the other side of a throat.
inline int otherSide(const Throat& t, int domain) { return t.left == domain ? t.right : t.left; }

} // namespace capfrac
