# The ParaView plugin GridFEM: server manager XML in front of the VTK module.

paraview_plugin_scan(
  PLUGIN_FILES ${PROJECT_SOURCE_DIR}/Plugin/paraview.plugin
  PROVIDES_PLUGINS plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
# The help of ParaView's window. ParaView's own rules make pages of the panels, and none with Qt 6 in 5.13, so
# that the plugin hands over the pages of Plugin/Documentation by itself.
find_program(CMARK_GFM cmark-gfm)
if (NOT PARAVIEW_QT_MAJOR_VERSION)
  set(PARAVIEW_QT_MAJOR_VERSION 5) # ParaView 5.11 does not tell
endif ()
find_package(Qt${PARAVIEW_QT_MAJOR_VERSION} QUIET COMPONENTS Help OPTIONAL_COMPONENTS Tools Widgets)
set(GRIDFEM_HELP OFF)
if (PARAVIEW_USE_QT AND CMARK_GFM AND Qt${PARAVIEW_QT_MAJOR_VERSION}Help_FOUND)
  set(GRIDFEM_HELP ON)
elseif (PARAVIEW_USE_QT)
  message(STATUS
    "ParaView will have no help pages: they need cmark-gfm and Qt${PARAVIEW_QT_MAJOR_VERSION}Help")
endif ()
# What the plugin adds to the window, and its choices for filters that the user makes there.
set(GRIDFEM_WINDOW OFF)
if (PARAVIEW_USE_QT AND Qt${PARAVIEW_QT_MAJOR_VERSION}Widgets_FOUND AND TARGET ParaView::pqApplicationComponents)
  set(GRIDFEM_WINDOW ON)
elseif (PARAVIEW_USE_QT)
  message(STATUS "The window will have no examples, sections and words to search for, and new filters only their "
    "defaults: the rest needs Qt${PARAVIEW_QT_MAJOR_VERSION}Widgets")
endif ()
paraview_plugin_build(
  PLUGINS ${plugins}
  LIBRARY_SUBDIRECTORY ${PARAVIEW_PLUGIN_SUBDIR}
  PLUGINS_FILE_NAME gridfem.plugins.xml
  INSTALL_HEADERS OFF
  DISABLE_XML_DOCUMENTATION ON)

file(RELATIVE_PATH libraries
  /${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/GridFEM /${CMAKE_INSTALL_LIBDIR})
set_target_properties(GridFEM PROPERTIES INSTALL_RPATH "${GRIDFEM_ORIGIN}/${libraries}")

# A path to the plugin that is the same for every version of ParaView.
file(CREATE_LINK ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${PARAVIEW_PLUGIN_SUBDIR} ${PROJECT_BINARY_DIR}/paraview
  SYMBOLIC)
