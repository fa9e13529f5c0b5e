# CMake refuses Debian's packages of ParaView 5.13 and 6.1, because their package files name Python modules
# vtkX.so, and the packages call these files vtkX.cpython-<version>-<machine>.so. This makes a copy of the package
# files with the right names in the build folder and chooses it. Another ParaView that the caller has chosen, and
# package files with the right names, stay as they are.

# Makes the copy and sets ParaView_DIR to it.
function (gridfem_mend_debian_paraview)
  set(copy ${CMAKE_BINARY_DIR}/CMakeFiles/debian_paraview)
  foreach (choice IN ITEMS "${ParaView_DIR}" "${ParaView_ROOT}" "$ENV{ParaView_ROOT}" "$ENV{ParaView_DIR}"
      "${CMAKE_PREFIX_PATH}" "$ENV{CMAKE_PREFIX_PATH}")
    if (choice AND NOT choice STREQUAL copy)
      return ()
    endif ()
  endforeach ()
  file(GLOB modules /usr/lib/python3/dist-packages/paraview/modules/*.cpython-*.so)
  file(GLOB package /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*)
  list(LENGTH package count)
  if (NOT modules OR NOT count EQUAL 1)
    return ()
  endif ()
  list(GET modules 0 module)
  string(REGEX MATCH "[.]cpython-[^/]*[.]so$" suffix ${module})

  file(REMOVE_RECURSE ${copy})
  file(COPY ${package}/ DESTINATION ${copy})
  file(GLOB_RECURSE files RELATIVE ${copy} ${copy}/*.cmake)
  foreach (file IN LISTS files)
    # Paths begin at the folder of the file.
    get_filename_component(folder ${package}/${file} DIRECTORY)
    file(READ ${copy}/${file} text)
    string(REPLACE "\"\${CMAKE_CURRENT_LIST_FILE}\" PATH" "\"${package}/${file}\" PATH" text "${text}")
    string(REPLACE "\"\${CMAKE_CURRENT_LIST_DIR}\"" "\"${folder}\"" text "${text}")
    string(REPLACE "\${CMAKE_CURRENT_LIST_DIR}/../" "${folder}/../" text "${text}")
    if (file MATCHES "Python.*-targets-")
      string(REGEX REPLACE "(/dist-packages/[A-Za-z0-9_/]+)[.]so" "\\1${suffix}" text "${text}")
    endif ()
    file(WRITE ${copy}/${file} "${text}")
  endforeach ()
  set(ParaView_DIR ${copy} CACHE PATH "Folder of ParaView's package files" FORCE)
endfunction ()

gridfem_mend_debian_paraview()
