// SPDX-License-Identifier: GPL-2.0-or-later
#include "Models.hpp"

#include "Buffer.hpp"
#include "Options.hpp"
#include "Tables.hpp"

namespace capfrac {

namespace py = boost::python;

namespace {

	std::vector<Disk> disksOf(py::object x, py::object y, py::object radius)
	{
		const Buffer<double> atX("x", x), atY("y", y), r("radius", radius);
		atY.requireSize(atX.size(), "as many as x");
		r.requireSize(atX.size(), "as many as x");
		std::vector<Disk> disks(atX.size());
		for (std::size_t i = 0; i < disks.size(); ++i)
			disks[i] = { { atX[i], atY[i] }, r[i] };
		return disks;
	}

	Box boxOf(py::object box)
	{
		if (py::len(box) != 4)
			throw std::invalid_argument(
			        "box: " + std::to_string(py::len(box)) + " values, allowed: left, right, bottom, top");
		const auto at = [&](int k) { return py::extract<double>(box[k])(); };
		return { at(0), at(1), at(2), at(3) };
	}

	py::list listOf(const std::vector<double>& values)
	{
		return column(values, [](double value) { return value; });
	}

	/// A sample: its network, and a model of the fluids in it. Grains are where the caller says.
	template <class Model> class Sample {
	public:
		Sample(py::object x, py::object y, py::object radius, py::object box, py::dict options)
		{
			readOptions(options);
			network.build(disksOf(x, y, radius), boxOf(box));
			model.start(network, now);
		}
		void advance(double dt)
		{
			now.dt = dt;
			network.follow(network.grains, network.box, model);
			model.advance(network, GrainAnswer(), now);
			now.time += dt, ++now.iteration;
		}
		void move(py::object x, py::object y, py::object radius, py::object box)
		{
			const auto disks = disksOf(x, y, radius);
			if (disks.size() != network.grains.size())
				throw std::invalid_argument("x: " + std::to_string(disks.size()) + " values, allowed: "
				        + std::to_string(network.grains.size()) + ", the number of grains");
			network.follow(disks, boxOf(box), model);
		}
		void set(py::dict options) { readOptions(options); }
		py::list pressures() { return listOf(model.cellPressures(network)); }
		py::list voids() { return listOf(network.voids()); }
		py::list phases()
		{
			return column(network.contents.phase, [](Phase phase) { return static_cast<int>(phase); });
		}
		py::list vertices()
		{
			return column(network.mesh.cells, [](const Cell& cell) { return asTuple(cell.vertex); });
		}
		py::tuple loads()
		{
			model.beforeReport(network);
			const auto forces = model.loads(network);
			const auto pair = [](Vec2 f) { return py::make_tuple(f.x, f.y); };
			return py::make_tuple(column(forces.grains, pair), column(forces.walls, pair));
		}
		py::dict ledger()
		{
			if (model.drained()) network.syncContents();
			const auto& books = network.books;
			const double w = network.options.thickness;
			py::dict d;
			d["gas"] = w * network.contents.totalGas(), d["water"] = w * network.contents.totalWater();
			d["gasIn"] = books.gasIn, d["waterIn"] = books.waterIn;
			d["initialVoid"] = books.initialVoid, d["initialWater"] = books.initialWater;
			d["gasMass"] = w * network.contents.totalGasMass();
			return d;
		}
		Model model;
		PoreNetwork network;
		Moment now;

	private:
		void readOptions(const py::dict& options);
	};

	template <> void Sample<SinglePhase>::readOptions(const py::dict& options)
	{
		OptionTable table;
		addNetwork(table, network.options);
		addFlow(table, model.flow.options);
		table.add("waterPressure", model.initialPressure);
		table.read(options);
		checkOptions(network.options), checkOptions(model.flow.options);
	}

	template <> void Sample<DrainedInvasion>::readOptions(const py::dict& options)
	{
		OptionTable table;
		addNetwork(table, network.options);
		addGas(table, model.gas, model.gasPressure);
		addDrained(table, model.options);
		table.read(options);
		checkOptions(network.options), checkOptions(model.gas), checkOptions(model.options, model.gas);
	}

	template <> void Sample<ViscousInvasion>::readOptions(const py::dict& options)
	{
		OptionTable table;
		addNetwork(table, network.options);
		addFlow(table, model.flow.options);
		addGas(table, model.gas, model.gasPressure);
		addViscous(table, model.options);
		table.read(options);
		checkOptions(network.options), checkOptions(model.gas), checkOptions(model.flow.options);
		checkOptions(model.options);
	}

	template <class Model> using SampleClass = py::class_<Sample<Model>, boost::noncopyable>;

	template <class Model> SampleClass<Model> sampleClass(const char* name, const char* doc)
	{
		using S = Sample<Model>;
		SampleClass<Model> made(name, doc,
		        py::init<py::object, py::object, py::object, py::object, py::dict>(
		                (py::arg("x"), py::arg("y"), py::arg("radius"), py::arg("box"), py::arg("options")),
		                "Disks at `x`, `y` of `radius` [m] (float64) in a `box` (left, right, bottom, top) "
		                "[m]; `options` by "
		                "the names of the engine's attributes. ValueError naming what is wrong."));
		made.def("advance", &S::advance, (py::arg("dt")),
		            "One step of `dt` [s]; the grains stay where they are.")
		        .def("move", &S::move, (py::arg("x"), py::arg("y"), py::arg("radius"), py::arg("box")),
		                "Grains and walls somewhere else; contents follow, and the triangulation where it has "
		                "to.")
		        .def("set", &S::set, (py::arg("options")), "Options from now on.")
		        .def("pressures", &S::pressures, "Pressure of each cell [Pa].")
		        .def("voids", &S::voids, "Void of each cell [m^2].")
		        .def("phases", &S::phases, "Phase of each cell: 0 water, 1 gas.")
		        .def("vertices", &S::vertices, "Grains (and walls, n ... n+3) of each cell, three each.")
		        .def("loads", &S::loads, "Forces of the fluids per thickness on grains and walls, pairs [N/m].")
		        .def("ledger", &S::ledger,
		                "Books of both fluids [m^3], and the mass of the gas in the sample [kg].")
		        .add_property(
		                "time", +[](S& s) { return s.now.time; }, "Time so far [s].")
		        .add_property(
		                "nRemeshes", +[](S& s) { return s.network.counts.remeshes; },
		                "How often the triangulation had to change [-].");
		return made;
	}

	template <class Model> void addGasOf(SampleClass<Model> made)
	{
		using S = Sample<Model>;
		made.def(
		            "events", +[](S& s) { return eventTable(s.model.events); },
		            "The invasions, a dict of lists as of the "
		            "engine.")
		        .def(
		                "nextEntryPressure", +[](S& s) { return s.model.nextEntryPressure(s.network); },
		                "The lowest entry pressure that the injected gas meets [Pa].")
		        .def(
		                "injectedMass", +[](S& s) { return s.model.injectedMass(s.network); },
		                "Gas injected so far [kg].")
		        .add_property(
		                "gasPressure", +[](S& s) { return s.model.gasPressure; }, "Pressure of the gas [Pa].")
		        .add_property(
		                "gasSaturation", +[](S& s) { return s.model.gasSaturation; },
		                "Share of the void that holds gas [-].")
		        .add_property(
		                "breakthroughPressure", +[](S& s) { return s.model.breakthrough.pressure; },
		                "Gas pressure when gas first reached the outlet [Pa]; NaN before.");
	}

} // namespace

void addModels()
{
	sampleClass<SinglePhase>("SinglePhase", "One viscous fluid between grains: the model of SinglePhaseFlowEngine.")
	        .add_property(
	                "massDefect", +[](Sample<SinglePhase>& s) { return s.model.record.massDefect; },
	                "Sum of in - out - stored over all steps [m^3]: round-off.");
	addGasOf<DrainedInvasion>(sampleClass<DrainedInvasion>(
	        "DrainedInvasion", "Gas invades drained water: the model of GasInvasionEngine."));
	addGasOf<ViscousInvasion>(sampleClass<ViscousInvasion>(
	        "ViscousInvasion", "Gas invades viscous water: the model of ViscousInvasionEngine."));
}

} // namespace capfrac
