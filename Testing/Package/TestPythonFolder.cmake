# Usage: cmake -DSOURCE=<project> -DPYTHON=<python3> -P TestPythonFolder.cmake
# Below a prefix of the interpreter, its packages are on the path.
cmake_minimum_required(VERSION 3.20)
include(${SOURCE}/CMake/PythonFolder.cmake)

execute_process(COMMAND ${PYTHON} -c "import site; print(*site.getsitepackages(), sep=';')"
  OUTPUT_VARIABLE places OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
foreach (place IN LISTS places)
  string(REGEX REPLACE "/[Ll]ib.*" "" prefix ${place})
  gridfem_python_folder(${PYTHON} ${prefix} folder)
  if (NOT "${prefix}/${folder}" IN_LIST places)
    message(FATAL_ERROR "Below ${prefix} the package would be in ${folder}, where Python does not look")
  endif ()
endforeach ()

gridfem_python_folder(${PYTHON} ${SOURCE} folder)
if (NOT folder MATCHES "^lib/.*-packages$")
  message(FATAL_ERROR "Elsewhere the package would be in ${folder}")
endif ()
