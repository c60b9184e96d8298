# What must be installed. Everything that is missing is reported at once, with its name in each packaging system.

set(GRAINSCOPE_FFTW AUTO CACHE STRING
    "FFTW 3 with MPI, for `method mesh` of compute velocity/correlation: AUTO (if it is found), ON or OFF")
set_property(CACHE GRAINSCOPE_FFTW PROPERTY STRINGS AUTO ON OFF)
if(NOT GRAINSCOPE_FFTW MATCHES "^(AUTO|ON|OFF)$")
  message(FATAL_ERROR "GRAINSCOPE_FFTW must be AUTO, ON or OFF, got '${GRAINSCOPE_FFTW}'")
endif()

# Vectors of gcc's that older versions do not know, and std::to_chars of numbers.
foreach(compiler "GNU 12" "Clang 14")
  string(REPLACE " " ";" compiler "${compiler}")
  list(GET compiler 0 id)
  list(GET compiler 1 version)
  if(CMAKE_CXX_COMPILER_ID STREQUAL id AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS version)
    message(FATAL_ERROR "The C++ compiler must be gcc 12 or clang 14 or newer, got ${id} ${CMAKE_CXX_COMPILER_VERSION} "
                        "(${CMAKE_CXX_COMPILER}): configure anew with -DCMAKE_CXX_COMPILER=<a newer one>. "
                        "Debian: g++, conda: cxx-compiler, Spack: gcc@12:. doc/cluster.md says more.")
  endif()
endforeach()

set(missing "")
set(packages "")
# need(FOUND_VARIABLE "what it is" DEBIAN name... CONDA name... SPACK name...)
macro(need found what)
  cmake_parse_arguments(NEED "" "" "DEBIAN;CONDA;SPACK" ${ARGN})
  if(NOT ${found})
    list(JOIN NEED_DEBIAN " " in_debian)
    list(JOIN NEED_CONDA " " in_conda)
    list(JOIN NEED_SPACK " " in_spack)
    string(APPEND missing "\n  ${what}. Debian: ${in_debian}, conda: ${in_conda}, Spack: ${in_spack}.")
    list(APPEND packages ${NEED_DEBIAN})
  endif()
endmacro()
# Ends the configure step if anything is missing.
macro(require_all_found)
  if(missing)
    list(JOIN packages " " packages)
    message(FATAL_ERROR "Not found:${missing}\nOn Debian or Ubuntu: sudo apt-get install ${packages}\nWithout root: "
                        "doc/cluster.md. What is installed elsewhere is found with -DCMAKE_PREFIX_PATH=<its folder>.")
  endif()
endmacro()

if(GRAINSCOPE_HOST)
  if(GRAINSCOPE_STATIC_RUNTIME)
    set(MPI_CXX_SKIP_MPICXX ON)  # no C++ bindings of MPI, whose library has the shared C++ runtime
  endif()
  find_package(MPI QUIET COMPONENTS CXX)
  need(MPI_CXX_FOUND "MPI, which lets processors work together" DEBIAN libopenmpi-dev openmpi-bin CONDA openmpi
       SPACK openmpi)
endif()
find_package(Eigen3 3.3 QUIET NO_MODULE)
need(Eigen3_FOUND "Eigen 3, headers for matrices" DEBIAN libeigen3-dev CONDA eigen SPACK eigen)
# Only headers are used, so one of them is looked for: CMake 3.30 and later warn of the module behind
# find_package(Boost).
find_path(Boost_INCLUDE_DIR boost/math/special_functions/beta.hpp
          HINTS ${BOOST_ROOT} ${Boost_ROOT} ENV BOOST_ROOT ENV Boost_ROOT PATH_SUFFIXES include)
need(Boost_INCLUDE_DIR "Boost headers" DEBIAN libboost-dev CONDA libboost-headers SPACK boost)
if(GRAINSCOPE_HOST AND GRAINSCOPE_FFTW)
  find_path(FFTW_INCLUDE_DIR fftw3-mpi.h)
  find_library(FFTW_LIBRARY fftw3)
  find_library(FFTW_MPI_LIBRARY fftw3_mpi)
  if(FFTW_INCLUDE_DIR AND FFTW_LIBRARY AND FFTW_MPI_LIBRARY)
    set(FFTW_FOUND TRUE)
  endif()
  if(NOT GRAINSCOPE_FFTW STREQUAL "AUTO")
    need(FFTW_FOUND "FFTW 3 with MPI (asked for by GRAINSCOPE_FFTW)" DEBIAN libfftw3-dev libfftw3-mpi-dev
         CONDA "fftw=*=mpi_openmpi_*" SPACK "fftw+mpi")
  endif()
endif()
if(GRAINSCOPE_VTK)
  enable_language(C)
  find_package(VTK QUIET COMPONENTS CommonCore CommonDataModel CommonExecutionModel FiltersCore FiltersGeneral IOLegacy
               IOXML IOParallelXML ParallelCore ParallelMPI)
  need(VTK_FOUND "VTK (for GRAINSCOPE_VTK)" DEBIAN libvtk9-dev CONDA vtk SPACK "vtk+mpi")
endif()
if(GRAINSCOPE_TESTS)
  find_package(GTest QUIET)
  need(GTest_FOUND "GoogleTest (for the tests; -DGRAINSCOPE_TESTS=OFF does without)" DEBIAN libgtest-dev CONDA gtest
       SPACK googletest)
endif()
require_all_found()
if(GRAINSCOPE_HOST AND FFTW_FOUND)
  message(STATUS "FFTW with MPI: ${FFTW_MPI_LIBRARY}")
elseif(GRAINSCOPE_HOST)
  message(STATUS "FFTW with MPI: none, so `method mesh` of compute velocity/correlation is left out. "
                 "Debian: libfftw3-dev libfftw3-mpi-dev, conda: fftw=*=mpi_openmpi_*, Spack: fftw+mpi.")
  set(FFTW_INCLUDE_DIR "")
  set(FFTW_LIBRARY "")
  set(FFTW_MPI_LIBRARY "")
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release or Debug" FORCE)
endif()
