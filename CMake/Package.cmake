# find_package(GridFEM), from the build tree and installed, and the Debian package.

include(CMakePackageConfigHelpers)
configure_package_config_file(${PROJECT_SOURCE_DIR}/CMake/GridFEMConfig.cmake.in
  ${PROJECT_BINARY_DIR}/${GRIDFEM_CMAKE_DESTINATION}/GridFEMConfig.cmake
  INSTALL_DESTINATION ${GRIDFEM_CMAKE_DESTINATION})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/${GRIDFEM_CMAKE_DESTINATION}/GridFEMConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
file(COPY ${PROJECT_SOURCE_DIR}/CMake/DebianParaView.cmake
  DESTINATION ${PROJECT_BINARY_DIR}/${GRIDFEM_CMAKE_DESTINATION})
install(FILES
  ${PROJECT_SOURCE_DIR}/CMake/DebianParaView.cmake
  ${PROJECT_BINARY_DIR}/${GRIDFEM_CMAKE_DESTINATION}/GridFEMConfig.cmake
  ${PROJECT_BINARY_DIR}/${GRIDFEM_CMAKE_DESTINATION}/GridFEMConfigVersion.cmake
  DESTINATION ${GRIDFEM_CMAKE_DESTINATION})

install(EXPORT GridFEMCore
  NAMESPACE GridFEM::
  FILE GridFEMCore-targets.cmake
  DESTINATION ${GRIDFEM_CMAKE_DESTINATION})
export(EXPORT GridFEMCore
  NAMESPACE GridFEM::
  FILE ${PROJECT_BINARY_DIR}/${GRIDFEM_CMAKE_DESTINATION}/GridFEMCore-targets.cmake)

set(GRIDFEM_DOC_DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gridfem) # of the name of Debian's package
install(FILES LICENSE DESTINATION ${GRIDFEM_DOC_DESTINATION} RENAME copyright)
install(FILES README.md CHANGELOG.md DESTINATION ${GRIDFEM_DOC_DESTINATION})

set(CPACK_GENERATOR DEB)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/CMake/Debian.cmake)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_NAME gridfem)
set(CPACK_PACKAGE_VENDOR "GridFEM developers")
# As the tools of Debian do.
set(CPACK_PACKAGE_CONTACT "GridFEM developers <gridfem@example.org>")
if (DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif ()
set(CPACK_GRIDFEM_NATIVE ${GRIDFEM_NATIVE}) # for Debian.cmake
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Laplace-Beltrami problems on triangle meshes for ParaView")
set(CPACK_PACKAGE_DESCRIPTION
"Filters that solve equations on the surface of a mesh: they smooth, sharpen,
stitch, fill in and interpolate functions given there, measure distances along
the surface, let heat and the surface itself flow, and compute eigenfunctions.
A plugin for ParaView, a Python package, and C++ libraries with their headers.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Each Debian has its own package, and an upgrade to the next Debian replaces it.
set(CPACK_DEBIAN_PACKAGE_VERSION ${PROJECT_VERSION})
if (EXISTS /etc/os-release)
  file(STRINGS /etc/os-release release REGEX "^VERSION_ID=")
  string(REGEX REPLACE "[^0-9.]" "" release "${release}")
  if (release)
    string(APPEND CPACK_DEBIAN_PACKAGE_VERSION "+deb${release}")
  endif ()
endif ()
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# For packages that link to these libraries; cpack would name those of glibc-hwcaps once more.
set(shlibs)
foreach (target gridfem_core gridfem_parallel Filters)
  if (TARGET ${target})
    get_target_property(version ${target} SOVERSION)
    string(REGEX REPLACE "^Filters$" vtkGridFEMFilters library ${target})
    string(APPEND shlibs "lib${library} ${version} gridfem (= ${CPACK_DEBIAN_PACKAGE_VERSION})\n")
  endif ()
endforeach ()
file(WRITE ${PROJECT_BINARY_DIR}/shlibs ${shlibs})
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/CMake/triggers # of the loader's cache
  ${PROJECT_BINARY_DIR}/shlibs)
set(CPACK_DEBIAN_PACKAGE_DEPENDS python3) # which knows the folder of the Python package
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-paraview, python3-numpy") # of the Python package
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview-dev, libeigen3-dev, libopenmpi-dev") # of who compiles with the headers
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # pins the ParaView that the plugin was built for
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
include(CPack)
