// SPDX-License-Identifier: GPL-2.0-or-later
/// The Python module capfrac._engines: loading it adds the classes of this folder to YADE.

#include "GasLaws.hpp"
#include "GasSupplies.hpp"

#include <core/Omega.hpp>
#include <lib/factory/ClassFactory.hpp>
#include <lib/serialization/Serializable.hpp>

#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/python.hpp>

#define CAPFRAC_TEXT(r, data, name) BOOST_PP_STRINGIZE(name),
#define CAPFRAC_TEXTS(names) BOOST_PP_SEQ_FOR_EACH(CAPFRAC_TEXT, ~, names)

BOOST_PYTHON_MODULE(_engines)
{
	namespace py = boost::python;
	py::scope module;
	py::list classes;
	module.attr("classes") = classes;
	// YADE's own classes must be there before ours derive from them.
	py::object wrapper = py::import("yade.wrapper");
	py::scope inWrapper(wrapper);
	// Bases first. Omega::loadPlugins would do it for all classes, but wraps YADE's own a second time.
	for (const char* name : { "DiskMat", "WallMat", "Ip2_DiskMat_DiskMat_CohFrictPhys",
	             "Ip2_WallMat_DiskMat_CohFrictPhys", "Ig2_Wall_Sphere_ScGeom6D",
	             CAPFRAC_TEXTS(CAPFRAC_GAS_LAWS) CAPFRAC_TEXTS(CAPFRAC_GAS_SUPPLIES) "PoreNetworkEngine",
	             "SinglePhaseFlowEngine", "GasEngine", "GasInvasionEngine", "ViscousInvasionEngine",
	             "MeniscusCohesionEngine", "WallServoEngine" }) {
		auto instance =
		        YADE_PTR_DYN_CAST<yade::Serializable>(yade::ClassFactory::instance().createShared(name));
		instance->pyRegisterClass(wrapper);
		classes.append(name);
	}
}
