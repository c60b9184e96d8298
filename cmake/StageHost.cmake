# Puts the source of LIGGGHTS (the host) in the build tree: a symlink per file, a mended copy where a mend applies, and
# the generated style_*.h lists that make our styles known to LIGGGHTS. The source itself is never written to.
# Sets HOST_STAGE (folder) and HOST_FILES (the .cpp files to compile).

# One stage per source: objects of an earlier LIGGGHTS_SOURCE_DIR, which may be newer than the files of this one, must
# not be used.
string(SHA1 source_key "${HOST_SOURCE}")
string(SUBSTRING "${source_key}" 0 8 source_key)
set(HOST_STAGE "${CMAKE_BINARY_DIR}/host-${source_key}")
set(MENDED_COPIES "${CMAKE_BINARY_DIR}/mends-${source_key}")
file(MAKE_DIRECTORY "${HOST_STAGE}")
file(GLOB staged RELATIVE "${HOST_SOURCE}" "${HOST_SOURCE}/*.h" "${HOST_SOURCE}/*.cpp")
list(FILTER staged EXCLUDE REGEX "^(style_|version_liggghts\\.h)")
set(vtk_dumps "")  # the headers of dump styles that are left out
if(NOT GRAINSCOPE_VTK)
  set(vtk_dumps ${staged})
  list(FILTER vtk_dumps INCLUDE REGEX "^dump_.*vt[km]\\.h$")
  list(FILTER staged EXCLUDE REGEX "^dump_.*vt[km]\\.(h|cpp)$")
endif()

# One mend: `old` becomes `new` in `file`, if `old` is found there. The mends that were made are listed, with `why`, at
# the end of the configure run.
set(HOST_MENDS "")
function(mend file old new why)
  if(NOT EXISTS "${HOST_SOURCE}/${file}")
    return()
  endif()
  if(file IN_LIST MENDED_FILES)
    set(from "${MENDED_COPIES}/${file}")
  else()
    set(from "${HOST_SOURCE}/${file}")
  endif()
  file(READ "${from}" text)
  string(FIND "${text}" "${old}" at)
  if(at EQUAL -1)
    return()
  endif()
  string(REPLACE "${old}" "${new}" text "${text}")
  file(WRITE "${MENDED_COPIES}/${file}" "${text}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${HOST_SOURCE}/${file}")
  set(MENDED_FILES ${MENDED_FILES} ${file} PARENT_SCOPE)
  set(HOST_MENDS ${HOST_MENDS} "${file}: ${why}" PARENT_SCOPE)
endfunction()

# One file for each kind of fault.
file(GLOB mends CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/cmake/mends/*.cmake")
foreach(file IN LISTS mends)
  include("${file}")
endforeach()

foreach(name IN LISTS staged)
  if(name IN_LIST MENDED_FILES)
    if(IS_SYMLINK "${HOST_STAGE}/${name}")
      file(REMOVE "${HOST_STAGE}/${name}")
    endif()
    configure_file("${MENDED_COPIES}/${name}" "${HOST_STAGE}/${name}" COPYONLY)
  else()
    file(CREATE_LINK "${HOST_SOURCE}/${name}" "${HOST_STAGE}/${name}" SYMBOLIC)
  endif()
endforeach()

# Rewrites a file only when its content changes, so that a second configure rebuilds nothing.
function(write_if_changed file text)
  if(EXISTS "${file}")
    file(READ "${file}" previous)
    if(previous STREQUAL text)
      return()
    endif()
  endif()
  file(WRITE "${file}" "${text}")
endfunction()

# style_<list>.h: every header named <prefix>*.h, the host's or ours, that carries <marker>. Of two styles of one name
# the host takes the last, but of two atom styles the first: either way ours.
list(TRANSFORM STYLE_FOLDERS APPEND "/*.h" OUTPUT_VARIABLE header_files)
file(GLOB our_headers ${header_files})
set(marked "")
foreach(name IN LISTS staged)
  if(name MATCHES "\\.h$")
    list(APPEND marked "${HOST_STAGE}/${name}")
  endif()
endforeach()
foreach(header IN LISTS marked our_headers)
  file(STRINGS "${header}" markers REGEX "[A-Z]_CLASS|_MODEL\\(|SPH_KERNEL")
  get_filename_component(name "${header}" NAME)
  set(markers_of_${name} "${markers}")
endforeach()
foreach(entry
    "ANGLE_CLASS angle_ angle" "ATOM_CLASS atom_vec_ atom" "BODY_CLASS body_ body" "BOND_CLASS bond_ bond"
    "COMMAND_CLASS - command" "COMPUTE_CLASS compute_ compute" "DIHEDRAL_CLASS dihedral_ dihedral"
    "DUMP_CLASS dump_ dump" "FIX_CLASS fix_ fix" "IMPROPER_CLASS improper_ improper" "INTEGRATE_CLASS - integrate"
    "KSPACE_CLASS - kspace" "MINIMIZE_CLASS min_ minimize"
    "PAIR_CLASS pair_ pair" "SURFACE_MODEL surface_model_ surface_model" "NORMAL_MODEL normal_model_ normal_model"
    "TANGENTIAL_MODEL tangential_model_ tangential_model" "COHESION_MODEL cohesion_model_ cohesion_model"
    "ROLLING_MODEL rolling_model_ rolling_model" "READER_CLASS reader_ reader" "REGION_CLASS region_ region"
    "CFD_DATACOUPLING_CLASS cfd_datacoupling_ cfd_datacoupling"
    "CFD_REGIONMODEL_CLASS cfd_regionmodel_ cfd_regionmodel" "LB_CLASS - lb" "SPH_KERNEL_CLASS sph_kernel_ sph_kernel"
    "MESHMODULE_CLASS mesh_module_ mesh_module" "MESHMOVER_CLASS mesh_mover_ mesh_mover")
  string(REPLACE " " ";" entry "${entry}")
  list(GET entry 0 marker)
  list(GET entry 1 prefix)
  list(GET entry 2 list)
  string(REPLACE "-" "" prefix "${prefix}")
  set(text "")
  set(headers ${marked} ${our_headers})
  if(list STREQUAL "atom")
    set(headers ${our_headers} ${marked})
  endif()
  foreach(header IN LISTS headers)
    get_filename_component(name "${header}" NAME)
    if(name MATCHES "^${prefix}" AND "${markers_of_${name}}" MATCHES "${marker}")
      string(APPEND text "#include \"${name}\"\n")
    endif()
  endforeach()
  write_if_changed("${HOST_STAGE}/style_${list}.h" "${text}")
endforeach()

# Their names, for the message that says what they need.
set(text "")
foreach(name IN LISTS vtk_dumps)
  file(STRINGS "${HOST_SOURCE}/${name}" lines REGEX "^ *DumpStyle\\(")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^ *DumpStyle\\(([^,]+),.*" "\"\\1\",\n" line "${line}")
    string(APPEND text "${line}")
  endforeach()
endforeach()
write_if_changed("${HOST_STAGE}/vtk_dump_names.h" "${text}")

set(whitelist "${CMAKE_SOURCE_DIR}/cmake/contact_models.whitelist")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${whitelist}" ${GRAINSCOPE_WHITELIST} ${our_headers})
file(STRINGS "${whitelist}" combinations REGEX "^GRAN_MODEL\\(")
set(GRAINSCOPE_WHITELIST "" CACHE FILEPATH "A file of further GRAN_MODEL(...) lines to compile")
if(GRAINSCOPE_WHITELIST)
  if(NOT EXISTS "${GRAINSCOPE_WHITELIST}")
    message(FATAL_ERROR "GRAINSCOPE_WHITELIST must name a file of GRAN_MODEL(...) lines, got '${GRAINSCOPE_WHITELIST}'")
  endif()
  file(STRINGS "${GRAINSCOPE_WHITELIST}" extra REGEX "^GRAN_MODEL\\(")
  list(APPEND combinations ${extra})
  list(REMOVE_DUPLICATES combinations)
endif()
string(REPLACE ";" "\n" combinations "${combinations}\n")
write_if_changed("${HOST_STAGE}/style_contact_model.h" "${combinations}")
file(STRINGS "${HOST_SOURCE}/version_liggghts.txt" host_version LIMIT_COUNT 1)
# Restart files carry this text; LIGGGHTS parses the number after the first word. (The word is not LIGGGHTS-PUBLIC: with
# that LIGGGHTS prints random remarks, through a dangling pointer, after every error.)
write_if_changed("${HOST_STAGE}/version_liggghts.h"
                 "#define LIGGGHTS_VERSION \"LIGGGHTS ${host_version} with grainscope ${PROJECT_VERSION}\"\n")

set(HOST_FILES ${staged})
list(FILTER HOST_FILES INCLUDE REGEX "\\.cpp$")
list(REMOVE_ITEM HOST_FILES main.cpp)
list(TRANSFORM HOST_FILES PREPEND "${HOST_STAGE}/")
