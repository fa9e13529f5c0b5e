# The ParaView plugin GridFEM: server manager XML in front of the VTK module.

paraview_plugin_scan(
  PLUGIN_FILES ${PROJECT_SOURCE_DIR}/Plugin/paraview.plugin
  PROVIDES_PLUGINS plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
paraview_plugin_build(
  PLUGINS ${plugins}
  LIBRARY_SUBDIRECTORY ${PARAVIEW_PLUGIN_SUBDIR}
  PLUGINS_FILE_NAME gridfem.plugins.xml
  INSTALL_HEADERS OFF
  DISABLE_XML_DOCUMENTATION ON) # would need Qt's help tools

file(RELATIVE_PATH libraries
  /${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/GridFEM /${CMAKE_INSTALL_LIBDIR})
set_target_properties(GridFEM PROPERTIES INSTALL_RPATH "${GRIDFEM_ORIGIN}/${libraries}")
