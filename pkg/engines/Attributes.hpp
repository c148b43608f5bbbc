// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks of attributes, with one form of message: Class.attribute = value [unit], allowed: what.
/// Thrown from postLoad (a flag triggerPostLoad makes YADE call it at assignment) they arrive in Python as
/// ValueError.

#include <any>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>

namespace capfrac {

template <class Value>
[[noreturn]] void refuseAttribute(const std::string& name, const Value& value, const std::string& allowed)
{
	std::ostringstream text;
	text.precision(10);
	text << name << " = " << value << ", allowed: " << allowed;
	throw std::invalid_argument(text.str());
}

// Comparisons are written so that NaN is refused.

inline void requirePositive(const std::string& name, double value)
{
	if (!(value > 0) || value > 1e300) refuseAttribute(name, value, "finite and > 0");
}

inline void requireNotNegative(const std::string& name, double value)
{
	if (!(value >= 0) || value > 1e300) refuseAttribute(name, value, "finite and >= 0");
}

inline void requireFinite(const std::string& name, double value)
{
	if (!(value > -1e300 && value < 1e300)) refuseAttribute(name, value, "finite");
}

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
