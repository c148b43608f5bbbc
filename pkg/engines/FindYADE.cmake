# Finds the host: an installed YADE and the source tree of exactly the same version.
#
# In:  YADE_PREFIX, YADE_SOURCE_DIR, YADE_SUFFIX (only where several are installed under one prefix)
# Out: target YADE::yade, YADE_VERSION, YADE_LIBRARY_DIR
#
# Compile definitions decide the layout of YADE's classes, so they are derived from the features that
# the installed YADE says it was built with. A feature that this file does not know stops the build:
# guessing would give a module that loads and then corrupts memory.

set(CAPFRAC_YADE_VERSIONS 2025.2.0)

set(YADE_PREFIX "" CACHE PATH "Where YADE is installed (for a distribution's package: /usr)")
set(YADE_SOURCE_DIR "" CACHE PATH "Source tree of the same version of YADE, for its headers")
set(YADE_SUFFIX "" CACHE STRING "Suffix of the YADE to take, where several are installed")

if(NOT YADE_PREFIX OR NOT YADE_SOURCE_DIR)
	message(FATAL_ERROR "YADE_PREFIX and YADE_SOURCE_DIR are not both set. Run scripts/bootstrap, which finds or builds a YADE, "
		"or pass -DYADE_PREFIX=<installed YADE> -DYADE_SOURCE_DIR=<its source>.")
endif()

execute_process(COMMAND ${CAPFRAC_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/read_yade_config.py ${YADE_PREFIX} ${YADE_SUFFIX}
	OUTPUT_VARIABLE yade_config ERROR_VARIABLE yade_error RESULT_VARIABLE yade_failed OUTPUT_STRIP_TRAILING_WHITESPACE)
if(yade_failed)
	message(FATAL_ERROR "YADE_PREFIX=${YADE_PREFIX}: ${yade_error}")
endif()
list(GET yade_config 0 YADE_VERSION)
list(GET yade_config 1 yade_library_folder)
set(YADE_LIBRARY_DIR ${yade_library_folder} CACHE INTERNAL "Library folder of the host")
list(GET yade_config 2 yade_features)
string(REPLACE "," ";" yade_features "${yade_features}")

if(NOT YADE_VERSION IN_LIST CAPFRAC_YADE_VERSIONS)
	message(FATAL_ERROR "The YADE in ${YADE_PREFIX} is version ${YADE_VERSION}; capfrac supports ${CAPFRAC_YADE_VERSIONS}. "
		"Unset YADE_PREFIX and YADE_SOURCE_DIR and run scripts/bootstrap, which builds one of that version.")
endif()

# The source says its version in the name of its changelog's first entry or of its folder.
get_filename_component(yade_source_name ${YADE_SOURCE_DIR} NAME)
set(yade_source_version "")
foreach(yade_changelog ChangeLog RELEASE)
	if(NOT yade_source_version AND EXISTS ${YADE_SOURCE_DIR}/${yade_changelog})
		file(STRINGS ${YADE_SOURCE_DIR}/${yade_changelog} yade_line REGEX "20[0-9][0-9]\\.[0-9]" LIMIT_COUNT 1)
		string(REGEX MATCH "20[0-9][0-9]\\.[0-9]+(\\.[0-9]+|[a-z])?" yade_source_version "${yade_line}")
	endif()
endforeach()
if(NOT EXISTS ${YADE_SOURCE_DIR}/core/Engine.hpp)
	message(FATAL_ERROR "YADE_SOURCE_DIR=${YADE_SOURCE_DIR} is not a source tree of YADE (core/Engine.hpp is missing).")
endif()
if(NOT yade_source_version STREQUAL YADE_VERSION AND NOT yade_source_name MATCHES "${YADE_VERSION}")
	message(FATAL_ERROR "The source in ${YADE_SOURCE_DIR} is version '${yade_source_version}', the YADE in ${YADE_PREFIX} is ${YADE_VERSION}. "
		"Headers and binary must be of the same version: get the source of ${YADE_VERSION}, or unset both and run scripts/bootstrap.")
endif()

set(yade_definitions BOOST_LOG_DYN_LINK MAX_LOG_LEVEL=5 YADE_ODEINT YADE_REAL_BIT=64 YADE_REAL_DEC=15)
set(yade_options -ftrack-macro-expansion=0)
set(yade_harmless MPC VTK GTS GL2PS LBMFLOW POTENTIAL_PARTICLES POTENTIAL_BLOCKS PFVFLOW LINSOLV TWOPHASEFLOW THERMAL PARTIALSAT
	USEFUL_ERRORS CHOLMOD_GPU PROFILING)
foreach(feature ${yade_features})
	if(feature STREQUAL "LOGGER")
		list(APPEND yade_definitions YADE_BOOST_LOG)
	elseif(feature STREQUAL "OPENMP")
		list(APPEND yade_definitions YADE_OPENMP)
		list(APPEND yade_options -fopenmp)
	elseif(feature STREQUAL "QT5")
		list(APPEND yade_definitions YADE_OPENGL YADE_QT5)
	elseif(feature STREQUAL "FEMLIKE")
		list(APPEND yade_definitions YADE_FEM)
	elseif(feature STREQUAL "MPI")
		list(APPEND yade_definitions YADE_MPI)
		execute_process(COMMAND mpicxx --showme:compile OUTPUT_VARIABLE yade_mpi RESULT_VARIABLE yade_failed OUTPUT_STRIP_TRAILING_WHITESPACE)
		if(yade_failed)
			message(FATAL_ERROR "The YADE in ${YADE_PREFIX} was built with MPI, but there is no mpicxx: install libopenmpi-dev.")
		endif()
		separate_arguments(yade_mpi UNIX_COMMAND "${yade_mpi}")
		list(APPEND yade_options ${yade_mpi})
	elseif(feature STREQUAL "CGAL")
		list(APPEND yade_definitions YADE_CGAL CGAL_DISABLE_ROUNDING_MATH_CHECK)
		list(APPEND yade_options -frounding-math)
	elseif(feature MATCHES "^(COMPLEX_MP|MPFR|LS_DEM|SPH|DEFORM|LIQMIGRATION|MASK_ARBITRARY)$")
		list(APPEND yade_definitions YADE_${feature})
	elseif(NOT feature IN_LIST yade_harmless AND NOT feature STREQUAL "VECTORIZE")
		message(FATAL_ERROR "The YADE in ${YADE_PREFIX} was built with the feature ${feature}, of which capfrac does not know what it changes. "
			"Unset YADE_PREFIX and YADE_SOURCE_DIR and run scripts/bootstrap, which builds a YADE that fits.")
	endif()
endforeach()
if(NOT "VECTORIZE" IN_LIST yade_features)
	list(APPEND yade_definitions EIGEN_DONT_VECTORIZE EIGEN_DONT_ALIGN EIGEN_DISABLE_UNALIGNED_ARRAY_ASSERT)
endif()
if(NOT "COMPLEX_MP" IN_LIST yade_features)
	# A build without high-precision types; there is no feature of its own for them.
	list(APPEND yade_definitions YADE_DISABLE_REAL_MULTI_HP)
endif()

find_package(Eigen3 CONFIG REQUIRED)
find_package(Boost 1.74 REQUIRED COMPONENTS python log serialization iostreams)
set(Python3_EXECUTABLE ${CAPFRAC_PYTHON})
find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)

add_library(YADE::yade INTERFACE IMPORTED)
target_include_directories(YADE::yade SYSTEM INTERFACE ${YADE_SOURCE_DIR} ${Python3_INCLUDE_DIRS})
target_compile_definitions(YADE::yade INTERFACE ${yade_definitions})
target_compile_options(YADE::yade INTERFACE ${yade_options})
target_link_directories(YADE::yade INTERFACE ${YADE_LIBRARY_DIR})
target_link_libraries(YADE::yade INTERFACE yade pkg_common pkg_dem Eigen3::Eigen Boost::python Boost::log Boost::serialization Boost::iostreams)
message(STATUS "Host: YADE ${YADE_VERSION} in ${YADE_LIBRARY_DIR} (${yade_features})")
