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
	const auto voids = currentVoids(), pressures = cellPressures();
	py::list vertices, polygons, phase, pressure, voidVolume, gas, water, domain, inlet, cutOff;
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		const auto& v = mesh.cells[c].vertex;
		py::list polygon;
		for (capfrac::Vec2 corner : capfrac::cellPolygon(mesh, static_cast<int>(c), reader.grains, reader.box))
			polygon.append(asTuple(corner));
		// What the cell holds now: its own phase follows the void, the other stays (see capfrac::followVoids).
		const bool isGas = contents.phase[c] == capfrac::Phase::gas, fills = isGas && !contents.held[c];
		vertices.append(py::make_tuple(reader.bodyOf(v[0]), reader.bodyOf(v[1]), reader.bodyOf(v[2])));
		polygons.append(polygon);
		phase.append(isGas ? 1 : 0);
		pressure.append(pressures[c]);
		voidVolume.append(thickness * voids[c]);
		gas.append(thickness * (fills && drained() ? voids[c] - contents.water[c] : contents.gas[c]));
		water.append(thickness * (fills || !drained() ? contents.water[c] : voids[c] - contents.gas[c]));
		domain.append(domains.ofCell[c]);
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
	py::list ids, gap, open, cells, entry;
	for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
		const auto& edge = mesh.edges[e];
		ids.append(py::make_tuple(reader.bodyOf(edge.a), reader.bodyOf(edge.b)));
		gap.append(gaps[e]);
		open.append(openEdges[e] != 0);
		cells.append(py::make_tuple(edge.left, edge.right));
		entry.append(reportedEntryPressure(static_cast<int>(e)));
	}
	py::dict d;
	d["ids"] = ids, d["gap"] = gap, d["open"] = open, d["cells"] = cells, d["entryPressure"] = entry;
	return d;
}

py::dict PoreNetworkEngine::pyForces()
{
	pyPrepare();
	beforeReport();
	const auto forces = forcesOfFluids();
	py::dict d;
	for (std::size_t i = 0; i < forces.grains.size(); ++i)
		d[reader.grainIds[i]] = asTuple(thickness * forces.grains[i]);
	for (int w = 0; w < capfrac::nWalls; ++w)
		d[reader.wallIds[w]] = asTuple(thickness * forces.walls[w]);
	return d;
}

py::dict PoreNetworkEngine::pyVolumes()
{
	pyPrepare();
	syncContents();
	const Real gas = thickness * contents.totalGas(), water = thickness * contents.totalWater();
	py::dict d;
	Real voidVolume = 0;
	for (double v : currentVoids())
		voidVolume += thickness * v;
	d["void"] = voidVolume, d["gas"] = gas, d["water"] = water;
	d["gasIn"] = gasIn, d["waterIn"] = waterIn, d["initialVoid"] = initialVoid, d["initialWater"] = initialWater;
	d["error"] = (math::abs(gas - gasIn) + math::abs(water - initialWater - waterIn)) / initialVoid;
	return d;
}

void PoreNetworkEngine::pySetCellPressures(const std::vector<Real>& pressures)
{
	pyPrepare();
	if (pressures.size() != mesh.cells.size())
		throw std::invalid_argument("pressures: " + std::to_string(pressures.size())
		        + " values, allowed: one for each of the " + std::to_string(mesh.cells.size()) + " cells");
	for (std::size_t c = 0; c < pressures.size(); ++c)
		if (!std::isfinite(pressures[c]))
			throw std::invalid_argument("pressures: cell " + std::to_string(c) + " has "
			        + std::to_string(pressures[c]) + " Pa, allowed: finite");
	fixedPressures = pressures;
}

} // namespace yade
