// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Arrays from Python through the buffer protocol, checked.

#include <boost/python.hpp>

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

namespace capfrac {

/// What NumPy and the array module call a type of numbers: characters of the struct module, and the name for messages.
template <class Number> struct BufferFormat;
template <> struct BufferFormat<int> {
	static constexpr const char *codes = "il", *name = "int32";
};
template <> struct BufferFormat<double> {
	static constexpr const char *codes = "d", *name = "float64";
};
template <> struct BufferFormat<std::uint8_t> {
	static constexpr const char *codes = "B?", *name = "uint8";
};

/// A one-dimensional contiguous array of Python, read only, held while this object lives.
/// The constructor throws TypeError (in Python's way) where `object` is none, or holds numbers of another kind.
template <class Number> class Buffer {
public:
	Buffer(const char* name_, const boost::python::object& object)
	        : name(name_)
	{
		if (PyObject_GetBuffer(object.ptr(), &view, PyBUF_FORMAT | PyBUF_C_CONTIGUOUS) != 0) {
			PyErr_Clear();
			refuseKind("something that is no contiguous array");
		}
		const std::string format = view.format ? view.format : "B";
		if (view.ndim == 1 && view.itemsize == sizeof(Number) && format.size() == 1
		        && std::string(BufferFormat<Number>::codes).find(format) != std::string::npos)
			return;
		const std::string found = std::to_string(view.ndim) + "-dimensional array of '" + format + "'";
		PyBuffer_Release(&view);
		refuseKind(found);
	}
	~Buffer() { PyBuffer_Release(&view); }
	Buffer(const Buffer&) = delete;
	Buffer& operator=(const Buffer&) = delete;

	std::size_t size() const { return static_cast<std::size_t>(view.len) / sizeof(Number); }
	const Number* begin() const { return static_cast<const Number*>(view.buf); }
	const Number* end() const { return begin() + size(); }
	Number operator[](std::size_t k) const { return begin()[k]; }

	void requireSize(std::size_t n, const std::string& allowed) const
	{
		if (size() != n)
			throw std::invalid_argument(name + ": " + std::to_string(size())
			        + " values, allowed: " + std::to_string(n) + ", " + allowed);
	}
	[[noreturn]] void refuse(std::size_t k, const std::string& allowed) const
	{
		std::ostringstream text;
		text << name << "[" << k << "] = " << begin()[k] << ", allowed: " << allowed;
		throw std::invalid_argument(text.str());
	}

private:
	[[noreturn]] void refuseKind(const std::string& found) const
	{
		PyErr_SetString(PyExc_TypeError,
		        (name + ": " + found + ", allowed: a one-dimensional contiguous array of "
		                + BufferFormat<Number>::name)
		                .c_str());
		throw boost::python::error_already_set();
	}

	std::string name;
	Py_buffer view {};
};

} // namespace capfrac
