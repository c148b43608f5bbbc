// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the models have recorded, as dicts of lists for Python.

#include "../model/EventLog.hpp"
#include "../model/PoreFlow.hpp"
#include "../supply/Levels.hpp"

#include <boost/python.hpp>

namespace capfrac {

/// A column: `value` of each row of a table.
template <class Rows, class Value> boost::python::list column(const Rows& rows, Value value)
{
	boost::python::list list;
	for (const auto& row : rows)
		list.append(value(row));
	return list;
}

template <std::size_t n> boost::python::tuple asTuple(const std::array<int, n>& ids)
{
	boost::python::list list;
	for (int id : ids)
		list.append(id);
	return boost::python::tuple(list);
}

boost::python::dict eventTable(const std::vector<InvasionEvent>& events);
boost::python::dict returnTable(const std::vector<ReturnEvent>& events);
boost::python::dict levelTable(const std::vector<Level>& levels);
boost::python::dict historyTable(const std::vector<HistoryRow>& rows);
/// The pores of a flow, with the pressures of their cells [Pa].
boost::python::dict poreTable(
        const PoreNetwork& network, const PoreFlow& flow, const std::vector<double>& cellPressure);

} // namespace capfrac
