# What must be on the machine, each with the one line that cures its absence.

function(need found package)
  string(REPLACE ";" " " packages "${ARGN}")
  if(NOT ${found})
    message(FATAL_ERROR "${package} was not found. On Debian or Ubuntu: sudo apt-get install ${packages}")
  endif()
endfunction()

find_package(MPI QUIET COMPONENTS CXX)
need(MPI_CXX_FOUND "MPI (Open MPI)" libopenmpi-dev openmpi-bin)
find_package(Eigen3 3.3 QUIET NO_MODULE)
need(Eigen3_FOUND "Eigen 3" libeigen3-dev)
find_package(Boost QUIET)
need(Boost_FOUND "Boost (headers)" libboost-dev)
if(GRAINSCOPE_VTK)
  enable_language(C)
  find_package(VTK QUIET COMPONENTS CommonCore CommonDataModel CommonExecutionModel FiltersCore FiltersGeneral IOLegacy IOXML
               IOParallelXML ParallelCore ParallelMPI)
  need(VTK_FOUND "VTK (asked for by GRAINSCOPE_VTK)" libvtk9-dev)
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release or Debug" FORCE)
endif()
