// SPDX-License-Identifier: GPL-2.0-or-later
#include "Tables.hpp"

namespace capfrac {

namespace py = boost::python;

#define CAPFRAC_COLUMN(name, value) d[name] = column(rows, [](const auto& row) { return value; })

py::dict eventTable(const std::vector<InvasionEvent>& rows)
{
	py::dict d;
	CAPFRAC_COLUMN("time", row.time);
	CAPFRAC_COLUMN("iteration", row.iteration);
	CAPFRAC_COLUMN("level", row.level);
	CAPFRAC_COLUMN("gasPressure", row.gasPressure);
	CAPFRAC_COLUMN("throat", asTuple(row.throat));
	CAPFRAC_COLUMN("pore", asTuple(row.pore));
	CAPFRAC_COLUMN("x", row.place.x);
	CAPFRAC_COLUMN("y", row.place.y);
	CAPFRAC_COLUMN("entryPressure", row.entryPressure);
	CAPFRAC_COLUMN("gap", row.gap);
	CAPFRAC_COLUMN("gapGrowth", row.gapGrowth);
	CAPFRAC_COLUMN("bondBroken", row.bondBroken);
	CAPFRAC_COLUMN("opened", row.opened);
	CAPFRAC_COLUMN("cells", row.cells);
	CAPFRAC_COLUMN("volume", row.volume);
	return d;
}

py::dict returnTable(const std::vector<ReturnEvent>& rows)
{
	static const char* kinds[] = { "refill", "snapOff", "reopening" };
	py::dict d;
	CAPFRAC_COLUMN("kind", kinds[static_cast<int>(row.kind)]);
	CAPFRAC_COLUMN("time", row.time);
	CAPFRAC_COLUMN("iteration", row.iteration);
	CAPFRAC_COLUMN("level", row.level);
	CAPFRAC_COLUMN("gasPressure", row.gasPressure);
	CAPFRAC_COLUMN("threshold", row.threshold);
	CAPFRAC_COLUMN("throat", asTuple(row.throat));
	CAPFRAC_COLUMN("pore", asTuple(row.pore));
	CAPFRAC_COLUMN("x", row.place.x);
	CAPFRAC_COLUMN("y", row.place.y);
	CAPFRAC_COLUMN("cells", row.cells);
	CAPFRAC_COLUMN("volume", row.volume);
	return d;
}

py::dict levelTable(const std::vector<Level>& rows)
{
	py::dict d;
	CAPFRAC_COLUMN("pressure", row.pressure);
	CAPFRAC_COLUMN("gasSaturation", row.saturation);
	CAPFRAC_COLUMN("brokenBonds", row.brokenBonds);
	CAPFRAC_COLUMN("displacement", row.displacement);
	CAPFRAC_COLUMN("displacementWithRattlers", row.displacementWithRattlers);
	CAPFRAC_COLUMN("unbalanced", row.unbalanced);
	CAPFRAC_COLUMN("atRest", row.atRest);
	CAPFRAC_COLUMN("iteration", row.iteration);
	CAPFRAC_COLUMN("gasVolume", row.gasVolume);
	return d;
}

py::dict historyTable(const std::vector<HistoryRow>& rows)
{
	py::dict d;
	CAPFRAC_COLUMN("time", row.time);
	CAPFRAC_COLUMN("iteration", row.iteration);
	CAPFRAC_COLUMN("gasPressure", row.gasPressure);
	CAPFRAC_COLUMN("connectedVolume", row.connectedVolume);
	CAPFRAC_COLUMN("mass", row.mass);
	CAPFRAC_COLUMN("gasSaturation", row.saturation);
	CAPFRAC_COLUMN("brokenBonds", row.brokenBonds);
	CAPFRAC_COLUMN("level", row.level);
	return d;
}

#undef CAPFRAC_COLUMN

py::dict poreTable(const PoreNetwork& network, const PoreFlow& flow, const std::vector<double>& cellPressure)
{
	std::vector<double> water(flow.nPores, 0), pressure(flow.nPores, 0);
	std::vector<int> cells(flow.nPores, 0);
	for (std::size_t c = 0; c < cellPressure.size(); ++c) {
		const int p = flow.poreOfCell[c];
		water[p] += network.options.thickness * network.contents.water[c];
		pressure[p] = cellPressure[c];
		++cells[p];
	}
	const auto same = [](auto value) { return value; };
	py::dict d;
	d["x"] = column(flow.poreCentre, [](Vec2 centre) { return centre.x; });
	d["y"] = column(flow.poreCentre, [](Vec2 centre) { return centre.y; });
	d["pressure"] = column(pressure, same), d["volume"] = column(flow.poreVolume, same);
	d["water"] = column(water, same), d["cells"] = column(cells, same);
	return d;
}

} // namespace capfrac
