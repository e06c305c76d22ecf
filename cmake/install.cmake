# Where Debian's packages put such things. A file of settings that is there already is kept.
include(GNUInstallDirs)

install(TARGETS cornerd cornerctl RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

install(DIRECTORY config/maps/ DESTINATION ${CMAKE_INSTALL_DATADIR}/cornerd/maps
  FILES_MATCHING PATTERN "*.json")
install(FILES config/cornerd.full.json DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES systemd/realtime.conf DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(CODE "
  set(settings \"\$ENV{DESTDIR}${CMAKE_INSTALL_FULL_SYSCONFDIR}/cornerd\")
  if(NOT EXISTS \"\${settings}/cornerd.json\")
    file(INSTALL \"${PROJECT_SOURCE_DIR}/config/cornerd.json\" DESTINATION \"\${settings}\")
  endif()")

# The unit names /usr/bin and /etc; it follows another prefix.
file(READ systemd/cornerd.service unit)
string(REPLACE "/usr/bin/" "${CMAKE_INSTALL_FULL_BINDIR}/" unit "${unit}")
string(REPLACE "/etc/" "${CMAKE_INSTALL_FULL_SYSCONFDIR}/" unit "${unit}")
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/cornerd.service CONTENT "${unit}" @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS systemd/cornerd.service)
install(FILES ${PROJECT_BINARY_DIR}/cornerd.service DESTINATION lib/systemd/system)
install(FILES systemd/cornerd.sysusers DESTINATION lib/sysusers.d RENAME cornerd.conf)
install(FILES systemd/60-cornerd.rules DESTINATION lib/udev/rules.d)
