# Run by cpack before it packs: what Debian's policy asks of a package and CMake does not do.

if (CPACK_GRIDFEM_NATIVE)
  message(FATAL_ERROR "This build is for the processor of this machine, and a package is for all. "
    "Turn GRIDFEM_NATIVE off, or use the preset `package`.")
endif ()

# Folders that all can read, whatever the umask of who packs.
execute_process(
  COMMAND find ${CPACK_TEMPORARY_INSTALL_DIRECTORY} -type d -exec chmod 755 {} +
  COMMAND_ERROR_IS_FATAL ANY)

# A changelog in Debian's form beside ours.
set(changelog ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/doc/gridfem/changelog)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # that of SOURCE_DATE_EPOCH where it is set
file(WRITE ${changelog} "gridfem (${CPACK_DEBIAN_PACKAGE_VERSION}) unstable; urgency=medium

  * What has changed is in CHANGELOG.md beside this file.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
file(CHMOD ${changelog} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
execute_process(COMMAND gzip -9nf ${changelog} COMMAND_ERROR_IS_FATAL ANY)
