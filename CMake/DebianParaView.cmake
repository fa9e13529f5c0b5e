# CMake refuses Debian's packages of ParaView 5.13 and 6.1, because their package files name Python modules
# vtkX.so, and the packages call these files vtkX.cpython-<version>-<machine>.so. This makes a copy of the package
# files with the right names in the build folder and chooses it. Another ParaView that the caller has chosen, and
# package files with the right names, stay as they are.

# Sets `found` to whether find_package finds package files of ParaView in a prefix or a folder of package files.
# Those in the folder `package` do not count.
function (gridfem_has_paraview prefix package found)
  set(folders)
  foreach (place IN ITEMS "" /lib /lib/${CMAKE_LIBRARY_ARCHITECTURE} /lib64 /share)
    list(APPEND folders ${prefix}${place} ${prefix}${place}/[Pp]ara[Vv]iew*
      ${prefix}${place}/[Cc][Mm]ake ${prefix}${place}/cmake/[Pp]ara[Vv]iew*)
  endforeach ()
  list(TRANSFORM folders APPEND /paraview-config.cmake OUTPUT_VARIABLE files)
  list(TRANSFORM folders APPEND /ParaViewConfig.cmake)
  file(GLOB files ${files} ${folders})
  set(${found} FALSE PARENT_SCOPE)
  foreach (file IN LISTS files)
    get_filename_component(folder ${file} DIRECTORY)
    file(REAL_PATH ${folder} folder)
    if (NOT folder STREQUAL package)
      set(${found} TRUE PARENT_SCOPE)
    endif ()
  endforeach ()
endfunction ()

# Makes the copy of the package in the prefix `system` and sets ParaView_DIR to it.
function (gridfem_mend_debian_paraview system)
  set(copy ${CMAKE_BINARY_DIR}/CMakeFiles/debian_paraview)
  file(GLOB modules ${system}/lib/python3/dist-packages/paraview/modules/*.cpython-*.so)
  file(GLOB package ${system}/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*)
  list(LENGTH package count)
  if (NOT modules OR NOT count EQUAL 1)
    return ()
  endif ()
  file(REAL_PATH ${package} package)
  file(TO_CMAKE_PATH "$ENV{CMAKE_PREFIX_PATH}" prefixes)
  foreach (prefix IN LISTS ParaView_DIR ParaView_ROOT CMAKE_PREFIX_PATH prefixes ITEMS
      "$ENV{ParaView_ROOT}" "$ENV{ParaView_DIR}")
    if (prefix AND NOT prefix STREQUAL copy)
      gridfem_has_paraview(${prefix} ${package} found)
      if (found)
        return ()
      endif ()
    endif ()
  endforeach ()
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
  # A plain variable: the cache belongs to the project that finds this one.
  set(ParaView_DIR ${copy} PARENT_SCOPE)
endfunction ()

gridfem_mend_debian_paraview(/usr)
