# Handed to YADE's own CMakeLists.txt as CMAKE_PROJECT_INCLUDE, so that its source
# stays untouched: once all of its targets exist, leaves out classes that capfrac
# does not use and reads the headers of the core fewer times.
cmake_language(DEFER CALL capfrac_minimal_yade)

function(capfrac_minimal_yade)
	# Left out: other contact laws, rock, wires, liquid bridges. Kept are
	# capfrac's own needs and the engines that stress a sample.
	capfrac_filter_sources(pkg_dem INCLUDE
		CohesiveFrictionalContactLaw ElasticContactLaw ForceTorqueRecorder FrictPhys
		GlobalStiffnessTimeStepper Ig2_Box_Sphere_ScGeom Ig2_Facet_Sphere_ScGeom
		Ig2_Sphere_Sphere_ScGeom Ip2_ElastMat NewtonIntegrator PeriIsoCompressor ScGeom STLImporter
		TriaxialStressController UnbalancedForceCallbacks)
	capfrac_filter_sources(pkg_common EXCLUDE
		Cylinder Grid HydroForceEngine PFacet ResetRandomPosition SpatialQuickSortCollider TimeAverager)
	capfrac_filter_sources(pre_dem EXCLUDE SimpleShear TriaxialTest)
	# Nothing but yade.utils refers to these; beside it, their headers are read once.
	foreach(class common/Grid dem/CapillaryPhys dem/HertzMindlin dem/Tetra dem/ViscoelasticPM)
		target_sources(pre_dem PRIVATE ${PROJECT_SOURCE_DIR}/pkg/${class}.cpp)
	endforeach()

	# What runs in every time step (yade, pkg_common, pkg_dem) keeps -O2; the Python
	# bindings lose nothing at -O1 and compile faster.
	set(bindings pre_dem _utils wrapper _customConverters)
	foreach(target ${bindings} _log _math _minieigenHP _packObb _packPredicates _packSpheres _ymport WeightedAverage2d)
		target_compile_options(${target} PRIVATE -O1)
	endforeach()

	# The core's headers are read once for each level of optimization, as gcc wants
	# it; files that do not include them would only become slower.
	set(core <core/Omega.hpp> <core/Scene.hpp> <core/InteractionLoop.hpp> <core/Clump.hpp>)
	capfrac_share_headers("${core}" yade pkg_common pkg_dem)
	capfrac_share_headers("${core}" ${bindings})
	foreach(small core/main/pyboot.cpp lib/base/Logging.cpp lib/pyutil/gil.cpp)
		set_property(SOURCE ${PROJECT_SOURCE_DIR}/${small} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
	endforeach()
endfunction()

# capfrac_filter_sources(TARGET INCLUDE|EXCLUDE NAME...): keeps, or drops, NAME.cpp...
function(capfrac_filter_sources target mode)
	list(JOIN ARGN | names)
	get_target_property(sources ${target} SOURCES)
	list(FILTER sources ${mode} REGEX "/(${names})\\.cpp$")
	set_property(TARGET ${target} PROPERTY SOURCES ${sources})
endfunction()

# capfrac_share_headers(HEADERS TARGET...): one precompiled header for all the targets.
function(capfrac_share_headers headers first)
	target_precompile_headers(${first} PRIVATE ${headers})
	foreach(target ${ARGN})
		target_precompile_headers(${target} REUSE_FROM ${first})
	endforeach()
endfunction()
