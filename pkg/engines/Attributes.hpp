// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../laws/Options.hpp"

#include <any>
#include <tuple>

namespace capfrac {

/// The last values that were accepted, so that a refused assignment leaves an object as it was: YADE assigns
/// first and calls postLoad afterwards. `now` are references to the attributes (std::tie); `check` throws where
/// one of them is out of its range.
class Accepted {
public:
	template <class... Values, class Check> void guard(std::tuple<Values&...> now, Check check)
	{
		using Copy = std::tuple<Values...>;
		try {
			check();
		} catch (...) {
			if (const auto* last = std::any_cast<Copy>(&values)) now = *last;
			throw;
		}
		values = Copy(now);
	}

private:
	std::any values;
};

} // namespace capfrac
