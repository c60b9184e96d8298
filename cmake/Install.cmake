# What is installed, so that the prefix can be moved as a whole: nothing in it knows where it is.

include(GNUInstallDirs)

# Libraries in a folder that the loader does not know by itself (conda, Spack, modules) are looked for there, and before
# that beside the program, where a copy of such an environment has them.
set(rpath "")
foreach(library IN LISTS MPI_CXX_LIBRARIES FFTW_MPI_LIBRARY FFTW_LIBRARY)
  get_filename_component(library "${library}" REALPATH)
  get_filename_component(folder "${library}" DIRECTORY)
  if(EXISTS "${library}" AND NOT folder IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
    list(APPEND rpath "$ORIGIN/../lib" "${folder}")
  endif()
endforeach()
list(REMOVE_DUPLICATES rpath)
set_target_properties(grainscope PROPERTIES INSTALL_RPATH "${rpath}")
install(TARGETS grainscope RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(GRAINSCOPE_LIGGGHTS_LINK)
  file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/installed")
  file(CREATE_LINK grainscope "${CMAKE_BINARY_DIR}/installed/liggghts" SYMBOLIC)
  install(FILES "${CMAKE_BINARY_DIR}/installed/liggghts" DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(PROGRAMS tools/grainscope-tools DESTINATION ${CMAKE_INSTALL_BINDIR})

# Beside each other as in the source tree, since their links and tools/ go from one to another.
set(share ${CMAKE_INSTALL_DATADIR}/grainscope)
install(FILES README.md ARCHITECTURE.md CONTRIBUTING.md CHANGELOG.md CITATION.cff .zenodo.json LICENSE
        DESTINATION ${share})
install(DIRECTORY doc DESTINATION ${share})
install(DIRECTORY examples tools DESTINATION ${share} USE_SOURCE_PERMISSIONS
        PATTERN __pycache__ EXCLUDE PATTERN out EXCLUDE)
install(FILES bench/README.md DESTINATION ${share}/bench)
install(FILES tests/README.md DESTINATION ${share}/tests)
