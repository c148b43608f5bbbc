// SPDX-License-Identifier: GPL-2.0-or-later
/// The Python module capfrac._laws: the names of the laws, and nothing else.
///
/// Case files are read before YADE is loaded, and before OpenMP: that takes its number of threads when it is loaded,
/// and keeps it. capfrac._kernels would load it by its solver. This module has none.

#include "LawNames.hpp"

#include <boost/python.hpp>

BOOST_PYTHON_MODULE(_laws)
{
	boost::python::docstring_options options(true, true, false);
	capfrac::addLaws();
}
