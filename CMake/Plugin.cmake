# The ParaView plugin GridFEM: server manager XML in front of the VTK module.

paraview_plugin_scan(
  PLUGIN_FILES ${PROJECT_SOURCE_DIR}/Plugin/paraview.plugin
  PROVIDES_PLUGINS plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
# The help of ParaView's window, where the tools for it are: ParaView's build rules take the pages of
# Plugin/Documentation in the place of those that they make of the panels.
find_program(CMARK_GFM cmark-gfm)
find_program(XMLPATTERNS NAMES xmlpatterns-qt5 xmlpatterns)
find_package(Qt5 QUIET COMPONENTS Help)
if (PARAVIEW_USE_QT AND CMARK_GFM AND XMLPATTERNS AND Qt5Help_FOUND)
  set(GRIDFEM_NO_HELP OFF)
else ()
  set(GRIDFEM_NO_HELP ON)
  message(STATUS "ParaView will have no help pages: they need cmark-gfm, xmlpatterns and Qt5Help")
endif ()
paraview_plugin_build(
  PLUGINS ${plugins}
  LIBRARY_SUBDIRECTORY ${PARAVIEW_PLUGIN_SUBDIR}
  PLUGINS_FILE_NAME gridfem.plugins.xml
  INSTALL_HEADERS OFF
  DISABLE_XML_DOCUMENTATION ${GRIDFEM_NO_HELP})

file(RELATIVE_PATH libraries
  /${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/GridFEM /${CMAKE_INSTALL_LIBDIR})
set_target_properties(GridFEM PROPERTIES INSTALL_RPATH "${GRIDFEM_ORIGIN}/${libraries}")
