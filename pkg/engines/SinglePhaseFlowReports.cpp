// SPDX-License-Identifier: GPL-2.0-or-later
/// What SinglePhaseFlowEngine reports to Python.

#include "SinglePhaseFlowEngine.hpp"
#include "Walls.hpp"

#include <core/Omega.hpp>

namespace yade {

namespace py = boost::python;

py::dict SinglePhaseFlowEngine::pyPores()
{
	pyPrepare();
	describePores();
	std::vector<Real> water(nPores, 0);
	std::vector<int> cells(nPores, 0);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
		water[poreOfCell[c]] += thickness * contents.water[c];
		++cells[poreOfCell[c]];
	}
	const auto cellPressure = cellPressures();
	std::vector<Real> pressures(nPores, waterPressure);
	for (std::size_t c = 0; c < mesh.cells.size(); ++c)
		pressures[poreOfCell[c]] = cellPressure[c];
	py::list x, y, pressure, volume, mass, number;
	for (int p = 0; p < nPores; ++p) {
		x.append(poreCentre[p].x), y.append(poreCentre[p].y);
		pressure.append(pressures[p]), volume.append(poreVolume[p]), mass.append(water[p]),
		        number.append(cells[p]);
	}
	py::dict d;
	d["x"] = x, d["y"] = y, d["pressure"] = pressure, d["volume"] = volume, d["water"] = mass, d["cells"] = number;
	return d;
}

py::dict SinglePhaseFlowEngine::pyInflow()
{
	py::dict d;
	for (int w = 0; w < capfrac::nWalls; ++w)
		d[std::string(wallName(w))] = wallInflow[w];
	return d;
}

Real SinglePhaseFlowEngine::pyTimeStepLimit()
{
	pyPrepare();
	describePores();
	return capfrac::explicitTimeStepLimit(flowNetwork());
}

void SinglePhaseFlowEngine::pySetCellPressures(const std::vector<Real>& pressures)
{
	pyPrepare();
	if (!std::isfinite(bulkModulus))
		throw std::invalid_argument("setCellPressures: an incompressible fluid has no pressures of its own; "
		                            "prescribe them at boundaries");
	PoreNetworkEngine::pySetCellPressures(pressures);
	const auto voids = currentVoids();
	for (std::size_t c = 0; c < contents.water.size(); ++c)
		contents.water[c] = capfrac::massAt(fixedPressures[c], voids[c], bulkModulus);
	initialWater = thickness * contents.totalWater() - waterIn; // a new beginning of the books
	cellPressure = fixedPressures;
	fixedPressures.clear();
}

} // namespace yade
