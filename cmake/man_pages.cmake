# Manual pages, made from the programs' --help, the full config and the protocol's README. A cross build runs the
# programs in the emulator of its toolchain file, and makes no pages without one. Builds that are never installed
# have no pages.
if(CORNERD_SANITIZE)
  return()
endif()
if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  message(WARNING "no manual pages: set CMAKE_CROSSCOMPILING_EMULATOR to make them in a cross build")
  return()
endif()

set(cornerd_pages)
# cornerd_man_page(PAGE DEPENDS file... COMMAND script arguments...)
function(cornerd_man_page page)
  cmake_parse_arguments(arg "" "" "DEPENDS;COMMAND" ${ARGN})
  set(output ${PROJECT_BINARY_DIR}/man/${page}.gz)
  string(REGEX REPLACE ".*\\." "" section ${page})
  add_custom_command(OUTPUT ${output}
    COMMAND ${PROJECT_SOURCE_DIR}/cmake/man_page ${output} ${PROJECT_VERSION} ${arg_COMMAND}
    DEPENDS ${PROJECT_SOURCE_DIR}/cmake/man_page ${PROJECT_SOURCE_DIR}/cmake/man/${page} ${arg_DEPENDS}
    VERBATIM)
  install(FILES ${output} DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section})
  set(cornerd_pages ${cornerd_pages} ${output} PARENT_SCOPE)
endfunction()

cornerd_man_page(cornerd.8 DEPENDS cornerd
  COMMAND program ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:cornerd>)
if(TARGET cornerd-web)
  cornerd_man_page(cornerd-web.8 DEPENDS cornerd-web
    COMMAND program ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:cornerd-web>)
endif()
cornerd_man_page(cornerd-mqtt.8 DEPENDS cornerd-mqtt
  COMMAND program ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:cornerd-mqtt>)
cornerd_man_page(cornerctl.1 DEPENDS cornerctl
  COMMAND program ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:cornerctl>)
cornerd_man_page(cornerd.json.5 DEPENDS ${PROJECT_SOURCE_DIR}/config/cornerd.full.json
  COMMAND settings ${PROJECT_SOURCE_DIR}/config/cornerd.full.json)
cornerd_man_page(cornerd-protocol.7
  DEPENDS ${PROJECT_SOURCE_DIR}/src/message/protocol.md ${PROJECT_SOURCE_DIR}/cmake/man/markdown.awk
  COMMAND protocol ${PROJECT_SOURCE_DIR}/src/message/protocol.md)
add_custom_target(man_pages ALL DEPENDS ${cornerd_pages})
add_dependencies(installed man_pages)
