// SPDX-License-Identifier: GPL-2.0-or-later
/// What GasInvasionEngine saves and reports: its logs for Python.

#include "GasInvasionEngine.hpp"
#include "Walls.hpp"

#include <core/Omega.hpp>

namespace yade {

namespace py = boost::python;

void GasInvasionEngine::preSave(GasInvasionEngine&)
{
	savedStart.clear();
	savedSnapped.assign(snapped.begin(), snapped.end());
	if (!prepared()) return;
	for (const auto& g : startGrains)
		savedStart.insert(savedStart.end(), { g.centre.x, g.centre.y, g.radius });
	savedStart.insert(savedStart.end(), { startBox.left, startBox.right, startBox.bottom, startBox.top });
}

/// What only carries the state into the file must not be there when an assignment calls postLoad().
void GasInvasionEngine::postSave(GasInvasionEngine&) { savedStart.clear(), savedSnapped.clear(); }

void GasInvasionEngine::postLoad(GasInvasionEngine&)
{
	guardAttributes();
	restore();
	goOnWhereChanged();
	if (savedStart.empty() || !startGrains.empty()) return;
	startGrains.clear();
	std::size_t k = 0;
	for (; k + 4 < savedStart.size(); k += 3)
		startGrains.push_back({ { savedStart[k], savedStart[k + 1] }, savedStart[k + 2] });
	startBox = { savedStart[k], savedStart[k + 1], savedStart[k + 2], savedStart[k + 3] };
	snapped.assign(savedSnapped.begin(), savedSnapped.end());
	postSave(*this);
}

py::dict GasInvasionEngine::pyEvents()
{
	py::list time, iteration, levels, pressure, throat, pore, x, y, entry, gap, growth, broken, opened, cells,
	        volume;
	for (std::size_t k = 0; k < eventBodies.size(); ++k) {
		const auto& n = eventNumbers[k];
		time.append(n[0]), pressure.append(n[1]), entry.append(n[2]), gap.append(n[3]), growth.append(n[4]),
		        volume.append(n[5]);
		iteration.append(eventCounts[k][0]), levels.append(eventCounts[k][1]), cells.append(eventCounts[k][2]);
		throat.append(py::make_tuple(eventThroats[k][0], eventThroats[k][1]));
		broken.append((eventThroats[k][2] & 1) != 0), opened.append((eventThroats[k][2] & 2) != 0);
		pore.append(py::make_tuple(eventBodies[k][0], eventBodies[k][1], eventBodies[k][2]));
		x.append(eventPlaces[k][0]), y.append(eventPlaces[k][1]);
	}
	py::dict d;
	d["time"] = time, d["iteration"] = iteration, d["level"] = levels, d["gasPressure"] = pressure,
	d["throat"] = throat, d["pore"] = pore;
	d["x"] = x, d["y"] = y, d["entryPressure"] = entry, d["gap"] = gap, d["gapGrowth"] = growth;
	d["bondBroken"] = broken, d["opened"] = opened, d["cells"] = cells, d["volume"] = volume;
	return d;
}

py::dict GasInvasionEngine::pyLevels()
{
	py::list pressure, gasSat, unbalancedForce, displacement, withRattlers, gasVolume, iteration, broken, atRest;
	for (std::size_t k = 0; k < levelNumbers.size(); ++k) {
		const auto& n = levelNumbers[k];
		pressure.append(n[0]), gasSat.append(n[1]), unbalancedForce.append(n[2]), displacement.append(n[3]);
		withRattlers.append(n[4]), gasVolume.append(n[5]);
		iteration.append(levelCounts[k][0]), broken.append(levelCounts[k][1]),
		        atRest.append(levelCounts[k][2] != 0);
	}
	py::dict d;
	d["pressure"] = pressure, d["gasSaturation"] = gasSat, d["brokenBonds"] = broken,
	d["displacement"] = displacement;
	d["displacementWithRattlers"] = withRattlers, d["unbalanced"] = unbalancedForce, d["atRest"] = atRest;
	d["iteration"] = iteration, d["gasVolume"] = gasVolume;
	return d;
}

void GasInvasionEngine::pySetCellPressures(const std::vector<Real>&)
{
	throw std::invalid_argument("setCellPressures: the pressures of this engine follow from gasPressure and "
	                            "waterPressure; use a PoreNetworkEngine");
}

py::list GasInvasionEngine::pyBonds()
{
	scene = Omega::instance().getScene().get();
	py::list pairs;
	for (std::size_t k = 0; k + 1 < savedBonds.size(); k += 2)
		if (bondBroken(savedBonds[k], savedBonds[k + 1]))
			pairs.append(py::make_tuple(savedBonds[k], savedBonds[k + 1]));
	return pairs;
}

py::tuple GasInvasionEngine::pyInletStretch(int nPores, Real centre)
{
	scene = Omega::instance().getScene().get();
	// A network of the present scene, aside: the stretch is asked for before there is an inlet.
	SceneReader fresh;
	const auto freshMesh = readScene(fresh);
	std::vector<double> freshGaps;
	Real smallest = fresh.grains[0].radius;
	for (const auto& g : fresh.grains)
		smallest = math::min(smallest, g.radius);
	for (const auto& edge : freshMesh.edges)
		freshGaps.push_back(capfrac::gap(freshMesh, edge.a, edge.b, fresh.grains, fresh.box));
	std::vector<std::uint8_t> open(freshGaps.size(), capfrac::freshEdge);
	capfrac::updateOpenEdges(open, freshGaps, mergeTolerance * smallest, mergeTolerance * smallest);
	const std::vector<capfrac::Phase> water(freshMesh.cells.size(), capfrac::Phase::water);
	const auto mode = poreMode == "domain" ? capfrac::PoreMode::domain : capfrac::PoreMode::triangle;
	const auto found = capfrac::findDomains(freshMesh, open, water, mode);
	const auto stretches = wallStretches(freshMesh, found, fresh, wallFromName("inletWall", inletWall));
	const int n = static_cast<int>(stretches.size());
	if (nPores < 1 || nPores > n)
		throw std::invalid_argument("nPores = " + std::to_string(nPores) + ", allowed: 1 … " + std::to_string(n)
		        + ", the number of pores along the " + inletWall + " wall");
	int best = 0;
	for (int first = 0; first + nPores <= n; ++first) {
		auto off = [&](int f) {
			return math::abs(0.5 * (stretches[f].from + stretches[f + nPores - 1].to) - centre);
		};
		if (off(first) < off(best)) best = first;
	}
	return py::make_tuple(stretches[best].from, stretches[best + nPores - 1].to);
}

Real GasInvasionEngine::pyNextEntryPressure()
{
	pyPrepare();
	return capfrac::nextEntryPressure(drainageNetwork());
}

} // namespace yade
