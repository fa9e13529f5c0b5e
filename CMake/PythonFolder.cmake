# Sets `folder` to the folder for Python packages below a prefix: one that the interpreter has on its path, if there
# is one below this prefix.
function (gridfem_python_folder python prefix folder)
  execute_process(
    COMMAND ${python} -c "import site; print(*site.getsitepackages(), sep=';')"
    OUTPUT_VARIABLE places OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  file(TO_CMAKE_PATH "${places}" places)
  foreach (place IN LISTS places)
    cmake_path(RELATIVE_PATH place BASE_DIRECTORY ${prefix} OUTPUT_VARIABLE below)
    if (below MATCHES "^[Ll]ib") # what is in local/ below /usr belongs to another prefix
      set(${folder} ${below} PARENT_SCOPE)
      return ()
    endif ()
  endforeach ()
  set(${folder} lib/python3/dist-packages PARENT_SCOPE)
endfunction ()
