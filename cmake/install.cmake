# Where Debian's packages put such things; debian/*.install says which package has what. A file of
# settings that is there already is kept. `installed`: everything that is, and nothing else.
include(GNUInstallDirs)
add_custom_target(installed DEPENDS cornerd cornerctl cornerd_client)

install(TARGETS cornerd cornerctl RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET cornerd-web)
  add_dependencies(installed cornerd-web)
  install(TARGETS cornerd-web RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

add_dependencies(installed cornerd-mqtt)
install(TARGETS cornerd-mqtt RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

install(TARGETS cornerd_client ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES src/client/connection.hpp src/client/request.hpp src/client/retry_delay.hpp
  src/client/subscription.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cornerd/client)
configure_file(src/client/cornerd-client.pc.in ${PROJECT_BINARY_DIR}/cornerd-client.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/cornerd-client.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(DIRECTORY config/maps/ DESTINATION ${CMAKE_INSTALL_DATADIR}/cornerd/maps
  FILES_MATCHING PATTERN "*.json")
install(DIRECTORY config/robots/ DESTINATION ${CMAKE_INSTALL_DATADIR}/cornerd/robots
  FILES_MATCHING PATTERN "*.json")
install(FILES config/cornerd.full.json systemd/realtime.conf DESTINATION ${CMAKE_INSTALL_DOCDIR})

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

foreach(settings cornerd.json mqtt.json)
  cornerd_follow_prefix(config/${settings})
  install(CODE "
    set(folder \"${CMAKE_INSTALL_FULL_SYSCONFDIR}/cornerd\")
    if(NOT EXISTS \"\$ENV{DESTDIR}\${folder}/${settings}\")
      file(INSTALL \"${PROJECT_BINARY_DIR}/${settings}\" DESTINATION \"\${folder}\")
    endif()")
endforeach()

cornerd_follow_prefix(systemd/cornerd.service)
cornerd_follow_prefix(systemd/cornerd-web.service)
cornerd_follow_prefix(systemd/cornerd-mqtt.service)
install(FILES ${PROJECT_BINARY_DIR}/cornerd.service ${PROJECT_BINARY_DIR}/cornerd-web.service
  ${PROJECT_BINARY_DIR}/cornerd-mqtt.service
  systemd/cornerd.socket systemd/cornerd-control.socket DESTINATION lib/systemd/system)
foreach(program cornerd cornerd-web cornerd-mqtt)
  install(FILES systemd/${program}.sysusers DESTINATION lib/sysusers.d RENAME ${program}.conf)
endforeach()
install(FILES systemd/61-cornerd.rules DESTINATION lib/udev/rules.d)
