# The VTK module GridFEM::Filters and its Python package `gridfem`.

vtk_module_scan(
  MODULE_FILES ${PROJECT_SOURCE_DIR}/Filters/VTK/vtk.module
  PROVIDES_MODULES modules
  REQUEST_MODULES GridFEM::Filters
  HIDE_MODULES_FROM_CACHE ON
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${modules}
  PACKAGE GridFEM
  INSTALL_EXPORT GridFEM
  INSTALL_HEADERS ON
  CMAKE_DESTINATION ${GRIDFEM_CMAKE_DESTINATION}
  HEADERS_DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/GridFEM
  TARGETS_COMPONENT runtime
  HEADERS_COMPONENT development)

if (TARGET VTK::WrappingPythonCore)
  set(GRIDFEM_PYTHON_DESTINATION lib/python3/dist-packages CACHE STRING
    "Folder of the Python package, below the prefix")
  vtk_module_wrap_python(
    MODULES ${modules}
    PYTHON_PACKAGE gridfem
    TARGET GridFEM::Python
    BUILD_STATIC OFF
    INSTALL_HEADERS OFF
    MODULE_DESTINATION ${GRIDFEM_PYTHON_DESTINATION}
    CMAKE_DESTINATION ${GRIDFEM_CMAKE_DESTINATION})
  file(RELATIVE_PATH libraries
    /${GRIDFEM_PYTHON_DESTINATION}/gridfem /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(vtkGridFEMFiltersPython PROPERTIES INSTALL_RPATH
    "${GRIDFEM_ORIGIN}/${libraries}")
  foreach (file IN ITEMS __init__ _inputs _messages _with_vtk)
    set(source ${PROJECT_SOURCE_DIR}/Filters/Python/${file}.py)
    configure_file(${source}
      ${PROJECT_BINARY_DIR}/${GRIDFEM_PYTHON_DESTINATION}/gridfem/${file}.py COPYONLY)
    install(FILES ${source} DESTINATION ${GRIDFEM_PYTHON_DESTINATION}/gridfem)
  endforeach ()
endif ()
