// SPDX-License-Identifier: GPL-2.0-or-later
/// What the engines of gas tell Python.

#include "../bindings/Tables.hpp"
#include "GasEngine.hpp"

#include <core/Omega.hpp>

#include <algorithm>

namespace yade {

namespace py = boost::python;

namespace {

	/// A ledger from masses [kg].
	py::dict ledger(Real initial, Real injected, Real sample, Real cutOff, Real reservoir)
	{
		py::dict d;
		d["initial"] = initial, d["supplied"] = injected - initial, d["injected"] = injected;
		d["sample"] = sample, d["cutOff"] = cutOff, d["reservoir"] = reservoir;
		d["error"] = injected == 0 ? 0 : math::abs(sample + reservoir - injected) / math::abs(injected);
		return d;
	}

	/// Sum of an amount over the cells of gas that do not hang on the inlet.
	Real sumOfCutOff(const capfrac::GasClusters& clusters, const std::vector<double>& amount)
	{
		Real sum = 0;
		for (std::size_t c = 0; c < clusters.ofCell.size(); ++c)
			if (clusters.ofCell[c] != 0) sum += amount[c];
		return sum;
	}

} // namespace

py::dict GasEngine::pyEvents() { return capfrac::eventTable(invasion().events); }
py::dict GasEngine::pyLevels() { return capfrac::levelTable(invasion().levels.closed); }
py::dict GasEngine::pyHistory() { return capfrac::historyTable(invasion().history.rows); }
py::dict GasEngine::pyImbibitionEvents() { return capfrac::returnTable(invasion().returns); }

py::dict GasEngine::pyGasLedger()
{
	pyPrepare();
	const auto& gas = invasion();
	const auto& books = gas.books;
	const auto& contents = network->contents;
	const auto clusters = gas.clusters(*network);
	if (!gas.drained() || (gas.gas.supply.gasCounted() && books.started))
		return ledger(books.initialMass, books.injectedMass, thickness * contents.totalGasMass(),
		        thickness * sumOfCutOff(clusters, contents.gasMass), books.reservoirMass);
	network->syncContents();
	const Real density = capfrac::datumDensity(gas.gas.supply);
	return ledger(0, density * network->books.gasIn, density * thickness * contents.totalGas(),
	        density * thickness * sumOfCutOff(clusters, contents.gas), 0);
}

Real GasEngine::pyRisePerPeriod()
{
	pyPrepare();
	return risePerPeriod();
}

void GasEngine::pySetCellPressures(const std::vector<Real>&)
{
	throw std::invalid_argument("setCellPressures: the pressures of this engine follow from gasPressure and "
	                            "waterPressure; use a PoreNetworkEngine");
}

py::list GasEngine::pyBonds()
{
	scene = Omega::instance().getScene().get();
	py::list pairs;
	for (const auto& [a, b] : census->bonds)
		if (census->bondBroken(*scene, a, b)) pairs.append(py::make_tuple(a, b));
	return pairs;
}

py::tuple GasEngine::pyInletStretch(int nPores, Real centre)
{
	scene = Omega::instance().getScene().get();
	// A network of the present scene, aside: the stretch is asked for before there is an inlet.
	SceneReader fresh;
	const auto made = freshNetwork(fresh);
	const auto [from, to] = capfrac::inletStretch(made, gasOptions().inlet, nPores, centre);
	return py::make_tuple(from, to);
}

Real GasEngine::pyNextEntryPressure()
{
	pyPrepare();
	return invasion().nextEntryPressure(*network);
}

py::list GasEngine::pyRattlersNow()
{
	pyPrepare();
	return capfrac::column(yade::rattlersNow(*scene, *reader), [](int id) { return id; });
}

py::dict GasEngine::pyDisplacements(bool atBreakthrough)
{
	pyPrepare();
	const auto& then = census->breakthrough;
	const auto all = atBreakthrough ? then.displacements : invasion().displacements(*network);
	const auto free = atBreakthrough ? then.rattlers : yade::rattlersNow(*scene, *reader);
	const std::vector<int> ids(reader->grainIds.begin(), reader->grainIds.begin() + all.size());
	const auto among = [](const std::vector<int>& found) {
		return [&found](int id) { return std::binary_search(found.begin(), found.end(), id); };
	};
	py::dict d;
	d["ids"] = capfrac::column(ids, [](int id) { return id; });
	d["displacement"] = capfrac::column(all, [](Real moved) { return moved; });
	d["rattlerAtStart"] = capfrac::column(ids, among(census->rattlers)),
	d["rattler"] = capfrac::column(ids, among(free));
	return d;
}

} // namespace yade
