// SPDX-License-Identifier: GPL-2.0-or-later
/// What PoreNetworkEngine tells Python. Apart from the engine itself because none of it runs in the loop.

#include "PoreNetworkEngine.hpp"

#include <core/Omega.hpp>

namespace yade {

namespace py = boost::python;

namespace {

	py::tuple asTuple(capfrac::Vec2 v) { return py::make_tuple(v.x, v.y); }

	/// Reports are asked for from outside the loop, where `scene` may be that of an earlier O.
	Scene* currentScene() { return Omega::instance().getScene().get(); }

} // namespace

void PoreNetworkEngine::pyPrepare()
{
	scene = currentScene();
	if (!prepared()) checkStepOrder(*scene, *this);
	prepare();
	update();
}

py::dict PoreNetworkEngine::pyCells()
{
	pyPrepare();
	const auto voids = network->voids(), pressures = model().cellPressures(*network);
	const auto& mesh = network->mesh;
	const auto& contents = network->contents;
	const bool drained = model().drained();
	py::list vertices, polygons, phase, pressure, voidVolume, gas, water, domain, inlet, cutOff;
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const auto& v = mesh.cells[c].vertex;
		py::list polygon;
		for (capfrac::Vec2 corner :
		        capfrac::cellPolygon(mesh, static_cast<int>(c), network->grains, network->box))
			polygon.append(asTuple(corner));
		// What the cell holds now: its own phase follows the void, the other stays (see capfrac::followVoids).
		const bool isGas = contents.phase[c] == capfrac::Phase::gas, fills = isGas && !contents.held[c];
		vertices.append(py::make_tuple(network->idOf(v[0]), network->idOf(v[1]), network->idOf(v[2])));
		polygons.append(polygon);
		phase.append(isGas ? 1 : 0);
		pressure.append(pressures[c]);
		voidVolume.append(thickness * voids[c]);
		gas.append(thickness * (fills && drained ? voids[c] - contents.water[c] : contents.gas[c]));
		water.append(thickness * (fills || !drained ? contents.water[c] : voids[c] - contents.gas[c]));
		domain.append(network->domains.ofCell[c]);
		inlet.append(contents.source[c] != 0);
		cutOff.append(contents.held[c] != 0);
	}
	py::dict d;
	d["vertices"] = vertices, d["polygon"] = polygons, d["phase"] = phase, d["pressure"] = pressure;
	d["void"] = voidVolume, d["gas"] = gas, d["water"] = water, d["domain"] = domain, d["inlet"] = inlet,
	d["cutOff"] = cutOff;
	return d;
}

py::dict PoreNetworkEngine::pyThroats()
{
	pyPrepare();
	const auto& mesh = network->mesh;
	py::list ids, gap, open, cells, entry;
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto& edge = mesh.edges[e];
		ids.append(py::make_tuple(network->idOf(edge.a), network->idOf(edge.b)));
		gap.append(network->gaps[e]);
		open.append(network->openEdges[e] != 0);
		cells.append(py::make_tuple(edge.left, edge.right));
		entry.append(model().entryPressureOf(*network, static_cast<int>(e)));
	}
	py::dict d;
	d["ids"] = ids, d["gap"] = gap, d["open"] = open, d["cells"] = cells, d["entryPressure"] = entry;
	return d;
}

py::dict PoreNetworkEngine::pyForces()
{
	pyPrepare();
	model().beforeReport(*network);
	const auto forces = model().loads(*network);
	py::dict d;
	for (std::size_t i = 0; i < forces.grains.size(); ++i)
		d[reader->grainIds[i]] = asTuple(thickness * forces.grains[i]);
	for (int w = 0; w < capfrac::nWalls; ++w)
		d[reader->wallIds[w]] = asTuple(thickness * forces.walls[w]);
	return d;
}

py::dict PoreNetworkEngine::pyVolumes()
{
	pyPrepare();
	if (model().drained()) network->syncContents();
	const auto& books = network->books;
	const Real gas = thickness * network->contents.totalGas(), water = thickness * network->contents.totalWater();
	Real voidVolume = 0;
	for (double v : network->voids())
		voidVolume += thickness * v;
	py::dict d;
	d["void"] = voidVolume, d["gas"] = gas, d["water"] = water, d["gasIn"] = books.gasIn,
	d["waterIn"] = books.waterIn;
	d["initialVoid"] = books.initialVoid, d["initialWater"] = books.initialWater;
	const Real lost = math::abs(gas - books.gasIn) + math::abs(water - books.initialWater - books.waterIn);
	d["error"] = lost / books.initialVoid;
	return d;
}

void PoreNetworkEngine::checkCellPressures(const std::vector<Real>& pressures) const
{
	const std::size_t n = network->mesh.cells.size();
	if (pressures.size() != n)
		throw std::invalid_argument("pressures: " + std::to_string(pressures.size())
		        + " values, allowed: one for each of the " + std::to_string(n) + " cells");
	for (std::size_t c = 0; c < n; ++c)
		if (!std::isfinite(pressures[c]))
			throw std::invalid_argument("pressures: cell " + std::to_string(c) + " has "
			        + std::to_string(pressures[c]) + " Pa, allowed: finite");
}

void PoreNetworkEngine::pySetCellPressures(const std::vector<Real>& pressures)
{
	pyPrepare();
	checkCellPressures(pressures);
	fixed->ofCells = pressures;
}

} // namespace yade
