# A Debian package of what is installed: cpack --config <build folder>/CPackConfig.cmake. Needs dpkg-dev and file.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The grainscope developers <developers@grainscope.invalid>" CACHE STRING
    "Who answers for the package: Name <address>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "micromechanics of granular flows inside LIGGGHTS")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "LIGGGHTS, a program for the discrete element method, with styles that measure
a granular flow at its contacts while it runs: stress, fabric, dissipation,
energy ledger, correlations and fields, of spheres and ellipsoids, on any
number of ranks. With tools that draw and summarise what was measured, pages
and examples.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin, python3-scipy, python3-matplotlib, python3-pandas, python3-yaml")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "povray, snakemake")
if(GRAINSCOPE_LIGGGHTS_LINK)  # the same /usr/bin/liggghts as Debian's own
  set(CPACK_DEBIAN_PACKAGE_PROVIDES liggghts)
  set(CPACK_DEBIAN_PACKAGE_CONFLICTS liggghts)
  set(CPACK_DEBIAN_PACKAGE_REPLACES liggghts)
endif()

find_program(GZIP gzip)
if(GZIP)  # Debian wants these two of every package
  string(TIMESTAMP PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
  configure_file(cmake/package/changelog.in "${CMAKE_BINARY_DIR}/installed/changelog" @ONLY)
  execute_process(COMMAND ${GZIP} -9nf "${CMAKE_BINARY_DIR}/installed/changelog")
  install(FILES "${CMAKE_BINARY_DIR}/installed/changelog.gz" cmake/package/copyright
          DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()
include(CPack)
