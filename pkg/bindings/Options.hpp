// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Options of the models from a dict of Python, by the names that the engines' attributes have.

#include "../model/DrainedInvasion.hpp"
#include "../model/ViscousInvasion.hpp"

#include <boost/python.hpp>

#include <functional>
#include <map>

namespace capfrac {

/// What each name of a dict sets.
class OptionTable {
public:
	/// A name that sets a number, a text or a bool of a struct of options.
	template <class Value> void add(const std::string& name, Value& target)
	{
		setters[name] = [&target](const boost::python::object& given) {
			target = boost::python::extract<Value>(given)();
		};
	}
	/// A name that is set by a function of the object.
	void add(const std::string& name, std::function<void(const boost::python::object&)> set)
	{
		setters[name] = set;
	}
	/// Sets what the dict gives. Throws std::invalid_argument for a name that is none, with those that there are.
	void read(const boost::python::dict& given) const;

private:
	std::map<std::string, std::function<void(const boost::python::object&)>> setters;
};

/// The tables of the structs' options; the structs must live as long as the table.
void addNetwork(OptionTable& table, NetworkOptions& options);
void addFlow(OptionTable& table, FlowOptions& options);
void addGas(OptionTable& table, GasOptions& options, double& gasPressure);
void addDrained(OptionTable& table, DrainedOptions& options);
void addViscous(OptionTable& table, ViscousOptions& options);

} // namespace capfrac
