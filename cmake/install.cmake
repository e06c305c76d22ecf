# Where Debian's packages put such things. A file of settings that is there already is kept.
include(GNUInstallDirs)

install(TARGETS cornerd cornerctl RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

install(DIRECTORY config/maps/ DESTINATION ${CMAKE_INSTALL_DATADIR}/cornerd/maps
  FILES_MATCHING PATTERN "*.json")
install(DIRECTORY config/robots/ DESTINATION ${CMAKE_INSTALL_DATADIR}/cornerd/robots
  FILES_MATCHING PATTERN "*.json")
# Not among the system's modules: the package would need Python.
install(FILES src/client/cornerd.py DESTINATION ${CMAKE_INSTALL_DATADIR}/cornerd)
install(FILES config/cornerd.full.json DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES systemd/realtime.conf DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_file(cmake/debian/changelog ${PROJECT_BINARY_DIR}/debian/changelog @ONLY)
foreach(file ${PROJECT_BINARY_DIR}/debian/changelog CHANGELOG.md)
  get_filename_component(name ${file} NAME)
  execute_process(COMMAND gzip -9nc ${file} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/debian/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${PROJECT_BINARY_DIR}/debian/${name}.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
endforeach()
install(FILES cmake/debian/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})

# cornerd_follow_prefix(FILE): a copy in the build folder, its paths those of this installation.
function(cornerd_follow_prefix file)
  get_filename_component(name ${file} NAME)
  file(READ ${PROJECT_SOURCE_DIR}/${file} text)
  string(REPLACE "/usr/bin/" "${CMAKE_INSTALL_FULL_BINDIR}/" text "${text}")
  string(REPLACE "/usr/share/" "${CMAKE_INSTALL_FULL_DATADIR}/" text "${text}")
  string(REPLACE "/etc/" "${CMAKE_INSTALL_FULL_SYSCONFDIR}/" text "${text}")
  file(WRITE ${PROJECT_BINARY_DIR}/${name} "${text}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
endfunction()

cornerd_follow_prefix(config/cornerd.json)
install(CODE "
  set(settings \"${CMAKE_INSTALL_FULL_SYSCONFDIR}/cornerd\")
  if(NOT EXISTS \"\$ENV{DESTDIR}\${settings}/cornerd.json\")
    file(INSTALL \"${PROJECT_BINARY_DIR}/cornerd.json\" DESTINATION \"\${settings}\")
  endif()")

cornerd_follow_prefix(systemd/cornerd.service)
install(FILES ${PROJECT_BINARY_DIR}/cornerd.service DESTINATION lib/systemd/system)
install(FILES systemd/cornerd.socket systemd/cornerd-control.socket DESTINATION lib/systemd/system)
install(FILES systemd/cornerd.sysusers DESTINATION lib/sysusers.d RENAME cornerd.conf)
install(FILES systemd/61-cornerd.rules DESTINATION lib/udev/rules.d)
