# Whether our styles fit this host, before anything is built: compiles cmake/host_probe.cpp against the staged headers,
# and refuses other forks in one sentence that says what they lack. Four seconds; kept until a header changes, wherever
# they lie: -D HOST_PROBE_PASSED from another build folder's cache saves them.

set(probe "${CMAKE_BINARY_DIR}/probe")
set(text "")
set(probe_key "${CMAKE_CXX_COMPILER} ${CMAKE_CXX_FLAGS}")
foreach(header IN LISTS our_headers)
  get_filename_component(name "${header}" NAME)
  if(markers_of_${name} MATCHES "_CLASS")  # a style's
    string(APPEND text "#include \"${name}\"\n")
  endif()
endforeach()
write_if_changed("${probe}/our_headers.h" "${text}")
file(GLOB probed "${HOST_STAGE}/*.h" src/*/*.h cmake/host_probe.cpp)
foreach(file IN LISTS probed)
  file(SHA1 "${file}" sum)
  get_filename_component(name "${file}" NAME)
  string(APPEND probe_key "${name} ${sum}\n")
endforeach()
string(SHA1 probe_key "${probe_key}")

function(compile_host_probe result output)
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  set(folders "${probe}" "${HOST_STAGE}" ${SOURCE_FOLDERS})
  try_compile(compiled "${probe}" SOURCES "${CMAKE_SOURCE_DIR}/cmake/host_probe.cpp"
    CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${folders}"
    COMPILE_DEFINITIONS -w -DSUPERQUADRIC_ACTIVE_FLAG -DNONSPHERICAL_ACTIVE_FLAG
    LINK_LIBRARIES MPI::MPI_CXX Eigen3::Eigen OUTPUT_VARIABLE said CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON)
  set(${result} "${compiled}" PARENT_SCOPE)
  unset(compiled CACHE)
  set(${output} "${said}" PARENT_SCOPE)
endfunction()

# What is missing, as the probe names it; or else the compiler's first complaint.
function(what_host_lacks output result)
  string(REPLACE ";" "," output "${output}")
  string(REGEX MATCHALL "host probe: [^|\n\"]*\\|" lacking "${output}")
  list(REMOVE_DUPLICATES lacking)
  list(TRANSFORM lacking REPLACE "host probe: (.*)\\|" "\\1")
  list(JOIN lacking "; " lacking)
  if(NOT lacking)
    string(REGEX MATCH "[^/\n]*error:[^\n]*" lacking "${output}")
    set(lacking "its headers do not compile with ours: ${lacking}")
  endif()
  set(${result} "${lacking}" PARENT_SCOPE)
endfunction()

if(NOT HOST_PROBE_PASSED STREQUAL probe_key)
  compile_host_probe(fits output)
  if(NOT fits)
    set(fork LIGGGHTS)
    if(EXISTS "${HOST_SOURCE}/version_liggghts_branch.txt")
      file(STRINGS "${HOST_SOURCE}/version_liggghts_branch.txt" fork LIMIT_COUNT 1)
    endif()
    set(given "LIGGGHTS source")
    if(LIGGGHTS_SOURCE_DIR)
      set(given LIGGGHTS_SOURCE_DIR)
    endif()
    file(WRITE "${probe}/output.txt" "${output}")
    what_host_lacks("${output}" lacking)
    message(FATAL_ERROR "${given}: '${HOST_SOURCE}' (${fork} ${host_version}) is not supported: ${lacking}. "
                        "doc/hosts.md lists the hosts that are.")
  endif()
  set(HOST_PROBE_PASSED "${probe_key}" CACHE INTERNAL "Compiler and headers of the host that the probe passed with")
endif()
