// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The one form in which the laws of the fluids refuse a number.

#include <sstream>
#include <string_view>

namespace capfrac {

/// Throws Error("what = value, allowed: allowed").
template <class Error> [[noreturn]] void refuse(std::string_view what, double value, std::string_view allowed)
{
	std::ostringstream text;
	text.precision(10);
	text << what << " = " << value << ", allowed: " << allowed;
	throw Error(text.str());
}

} // namespace capfrac
