// SPDX-License-Identifier: GPL-2.0-or-later
/// The Python module capfrac._kernels: drainage and entry pressures of networks that are given as arrays.
///
/// The very code that GasInvasionEngine calls, for networks without a scene. Arrays come in through Python's
/// buffer protocol: that is the same for every version of NumPy, which Boost.Python's own arrays are not.

#include "Buffer.hpp"
#include "LawNames.hpp"
#include "Models.hpp"

#include "../laws/EntryPressure.hpp"
#include "../invasion/Drainage.hpp"

namespace {

namespace py = boost::python;

capfrac::DrainageNetwork networkOf(py::object left, py::object right, py::object entryPressure, py::object x,
        py::object y, py::object gas, py::object outlet)
{
	using capfrac::Buffer;
	const Buffer<int> from("left", left), to("right", right);
	const Buffer<double> entry("entryPressure", entryPressure), atX("x", x), atY("y", y);
	const Buffer<std::uint8_t> isGas("gas", gas), isOutlet("outlet", outlet);
	const std::size_t nThroats = from.size(), nPores = isGas.size();
	to.requireSize(nThroats, "one for each throat");
	entry.requireSize(nThroats, "one for each throat");
	atX.requireSize(nThroats, "one for each throat");
	atY.requireSize(nThroats, "one for each throat");
	isOutlet.requireSize(nPores, "one for each pore");

	capfrac::DrainageNetwork network;
	network.throats.reserve(nThroats);
	const auto pore = [&](const Buffer<int>& side, std::size_t t) {
		if (side[t] < 0 || side[t] >= static_cast<int>(nPores))
			side.refuse(t, "a pore, 0 … " + std::to_string(static_cast<long>(nPores) - 1));
		return side[t];
	};
	for (std::size_t t = 0; t < nThroats; ++t) {
		// NaN has no place in the order of invasion.
		if (!(entry[t] == entry[t])) entry.refuse(t, "numbers [Pa]");
		network.throats.push_back(
		        { static_cast<int>(t), pore(from, t), pore(to, t), entry[t], { atX[t], atY[t] } });
		if (from[t] == to[t]) to.refuse(t, "another pore than left");
	}
	network.gas.assign(isGas.begin(), isGas.end());
	network.outlet.assign(isOutlet.begin(), isOutlet.end());
	network.injected = network.gas; // all gas at the start is injected
	return network;
}

py::tuple drain(py::object left, py::object right, py::object entryPressure, py::object x, py::object y, py::object gas,
        py::object outlet, double capillaryPressure, bool trapping, bool untilOutlet, int maxSteps)
{
	if (maxSteps < 1) throw std::invalid_argument("maxSteps [-] = " + std::to_string(maxSteps) + ", allowed: >= 1");
	if (!(capillaryPressure == capillaryPressure))
		throw std::invalid_argument("capillaryPressure [Pa] = nan, allowed: a number or infinity");
	const auto network = networkOf(left, right, entryPressure, x, y, gas, outlet);
	const auto drainage = capfrac::drain(network, capillaryPressure, trapping, maxSteps, untilOutlet);
	py::list throats, pores, trapped;
	for (const auto& step : drainage.steps) {
		throats.append(step.throat);
		pores.append(step.domain);
	}
	for (int d : drainage.trapped)
		trapped.append(d);
	return py::make_tuple(throats, pores, trapped);
}

py::list entryPressures(py::object gap, py::object radius, double tension, double contactAngle, const std::string& law)
{
	const capfrac::Buffer<double> gaps("gap", gap), radii("radius", radius);
	radii.requireSize(gaps.size(), "one for each gap");
	const auto which = capfrac::entryLawFromName(law);
	py::list found;
	for (std::size_t t = 0; t < gaps.size(); ++t) {
		try {
			found.append(capfrac::entryPressure(which, gaps[t], radii[t], tension, contactAngle));
		} catch (const capfrac::EntryLawError& e) {
			throw std::invalid_argument("throat " + std::to_string(t) + ": " + e.what());
		}
	}
	return found;
}

} // namespace

BOOST_PYTHON_MODULE(_kernels)
{
	py::docstring_options options(true, true, false);
	py::def("drain", &drain,
	        (py::arg("left"), py::arg("right"), py::arg("entryPressure"), py::arg("x"), py::arg("y"),
	                py::arg("gas"), py::arg("outlet"), py::arg("capillaryPressure"), py::arg("trapping") = false,
	                py::arg("untilOutlet") = false, py::arg("maxSteps") = std::numeric_limits<int>::max()),
	        "Quasi-static drainage of a network at one capillary pressure: (throats, pores, trapped), lists of "
	        "int.\n\n"
	        "Throats 0 … n-1: `left` and `right`, the pores on their sides (int32); `entryPressure` [Pa], `x` and "
	        "`y` [m] (float64), the place\n"
	        "deciding between equal entry pressures. Pores 0 … m-1: `gas` and `outlet` (uint8, 1: yes). All gas at "
	        "the start is injected gas.\n"
	        "Gas advances through the throat with the lowest entry pressure that it touches, as long as that is at "
	        "most `capillaryPressure`\n"
	        "[Pa], infinity allowed. `trapping`: water without a way to an outlet stays. `untilOutlet`: end with "
	        "the first pore that is an\n"
	        "outlet (breakthrough). `maxSteps` [-]: end after so many. `throats` and `pores`: what was passed and "
	        "entered, in the order of\n"
	        "invasion; `trapped`: pores of water without an outlet afterwards (only with trapping).\n\n"
	        "ValueError naming the array and the entry at fault: sizes that differ, pores that are not there, a "
	        "throat from a pore to itself, NaN.\n"
	        "TypeError for arrays of another kind. Time and memory go like n log n and n: a million pores take a "
	        "second or two.");
	py::def("entryPressures", &entryPressures,
	        (py::arg("gap"), py::arg("radius"), py::arg("tension"), py::arg("contactAngle") = 0.0,
	                py::arg("law") = "inscribedSphere"),
	        "Entry pressures of throats [Pa], a list of float, by a law of GasInvasionEngine.\n\n"
	        "`gap` of each pair of grains [m] (float64; negative: overlap) and mean `radius` [m], `tension` [N/m], "
	        "`contactAngle` [rad]; `law`:\n"
	        "a name in laws()['entryLaw']. ValueError naming the throat and what is allowed.");
	capfrac::addLaws();
	capfrac::addModels();
}
