// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <typeinfo>

namespace yade {

/// A dynamic_cast that is looked up once for each class that it meets in a row: contacts of a scene are mostly of one
/// class, and there are thousands of them in a step. For one loop on one thread.
template <class Wanted, class Base> class CastOnce {
public:
	const Wanted* operator()(const Base* object)
	{
		if (!object) return nullptr;
		const std::type_info* met = &typeid(*object);
		if (met != known) {
			const auto* cast = dynamic_cast<const Wanted*>(object);
			known = met, isOne = cast != nullptr;
			offset = isOne ? bytes(cast) - bytes(object) : 0;
		}
		return isOne ? reinterpret_cast<const Wanted*>(bytes(object) + offset) : nullptr;
	}

private:
	static const char* bytes(const void* object) { return static_cast<const char*>(object); }
	const std::type_info* known = nullptr;
	std::ptrdiff_t offset = 0;
	bool isOne = false;
};

} // namespace yade
