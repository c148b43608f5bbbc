// SPDX-License-Identifier: GPL-2.0-or-later
#include "LawNames.hpp"

#include "../laws/Conductance.hpp"
#include "../laws/EntryPressure.hpp"
#include "../laws/EquationOfState.hpp"

#include <boost/python.hpp>

namespace capfrac {

namespace py = boost::python;

namespace {

	template <class Row> void add(py::dict& families, const LawTable<Row>& table)
	{
		py::list rows;
		for (const auto& [name, doc] : table.listing())
			rows.append(py::make_tuple(name, doc));
		families[table.attribute()] = rows;
	}

	py::dict laws()
	{
		py::dict families;
		add(families, entryLaws());
		add(families, gasLaws());
		add(families, conductanceLaws());
		return families;
	}

} // namespace

void addLaws()
{
	py::def("laws", &laws,
	        "The laws that engines, models and case files can be told by name: a dict, attribute of the engines -> "
	        "list "
	        "of (name, doc),\n"
	        "for entryLaw, gasLaw and conductanceLaw. `doc` says in one line what the law is and where it holds.");
}

} // namespace capfrac
