// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks of options, with one form of message: name [unit] = value, allowed: what. The names are those of the engines'
/// attributes, so that engine and case file say the same sentence. In Python they arrive as ValueError.

#include <sstream>
#include <stdexcept>
#include <string>

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

inline bool isPositive(double value) { return value > 0 && value <= 1e300; }

inline void requirePositive(const std::string& name, double value)
{
	if (!isPositive(value)) refuseAttribute(name, value, "finite and > 0");
}

inline void requireNotNegative(const std::string& name, double value)
{
	if (!(value >= 0) || value > 1e300) refuseAttribute(name, value, "finite and >= 0");
}

inline void requireFinite(const std::string& name, double value)
{
	if (!(value > -1e300 && value < 1e300)) refuseAttribute(name, value, "finite");
}

} // namespace capfrac
