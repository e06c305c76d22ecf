# `--target deb`: the package of this build, for the architecture that it was built for, in the build
# folder. What it depends on is found out by dpkg-shlibdeps.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cornerd)
set(CPACK_PACKAGE_CONTACT "The cornerd authors <cornerd@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "tells a robot where it is, from one scan of a cheap lidar")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"cornerd reads an RPLidar A1 on a serial port, finds the corners and wall ends
of the room in every scan, recognises their pattern in a map of the building
as a star tracker recognises stars, and publishes the robot's pose, with an
honest covariance, on a UNIX socket. cornerctl watches, records, replays,
simulates and draws.")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_STRIP_FILES ON)
# The settings go to /etc, beside the prefix.
set(CPACK_SET_DESTDIR ON)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# systemd makes the user.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "systemd")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(CMAKE_CROSSCOMPILING)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${CORNERD_DEBIAN_ARCHITECTURE})
  # Where Debian's cross compiler has the board's C library.
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS /usr/${CMAKE_LIBRARY_ARCHITECTURE}/lib)
endif()

set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/cmake/debian/conffiles ${PROJECT_SOURCE_DIR}/cmake/debian/postinst
    ${PROJECT_SOURCE_DIR}/cmake/debian/prerm ${PROJECT_SOURCE_DIR}/cmake/debian/postrm)

include(CPack)

add_custom_target(deb
  COMMAND ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
          -B ${PROJECT_BINARY_DIR}
  DEPENDS cornerd cornerctl
  USES_TERMINAL VERBATIM)
if(TARGET man_pages)
  add_dependencies(deb man_pages)
endif()
