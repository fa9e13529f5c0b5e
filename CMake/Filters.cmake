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
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  INSTALL_EXPORT GridFEM
  INSTALL_HEADERS ON
  CMAKE_DESTINATION ${GRIDFEM_CMAKE_DESTINATION}
  HEADERS_DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/GridFEM
  TARGETS_COMPONENT runtime
  HEADERS_COMPONENT development)

if (TARGET VTK::WrappingPythonCore)
  set(folder lib/python3/dist-packages)
  find_package(Python3 QUIET COMPONENTS Interpreter)
  if (Python3_Interpreter_FOUND)
    include(CMake/PythonFolder.cmake)
    gridfem_python_folder(${Python3_EXECUTABLE} ${CMAKE_INSTALL_PREFIX} folder)
  endif ()
  set(GRIDFEM_PYTHON_DESTINATION ${folder} CACHE STRING "Folder of the Python package, below the prefix")
  message(STATUS "Folder of the Python package below the prefix: ${GRIDFEM_PYTHON_DESTINATION}")
  # A path that is the same everywhere.
  if (UNIX AND NOT GRIDFEM_PYTHON_DESTINATION STREQUAL lib/python3/dist-packages)
    file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/lib/python3 ${PROJECT_BINARY_DIR}/${GRIDFEM_PYTHON_DESTINATION})
    file(CREATE_LINK ${PROJECT_BINARY_DIR}/${GRIDFEM_PYTHON_DESTINATION}
      ${PROJECT_BINARY_DIR}/lib/python3/dist-packages SYMBOLIC)
  endif ()
  vtk_module_wrap_python(
    MODULES ${modules}
    PYTHON_PACKAGE gridfem
    TARGET GridFEM::Python
    COMPONENT runtime # not that of the package without VTK
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
