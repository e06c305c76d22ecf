# Debian's packages, as header-only targets: a cross build then needs no package of the board's
# architecture, and the daemon no shared library but the C library.

find_path(CORNERD_EIGEN_DIR Eigen/Core PATHS /usr/include/eigen3 REQUIRED NO_CMAKE_FIND_ROOT_PATH)
add_library(cornerd_eigen INTERFACE)
target_include_directories(cornerd_eigen SYSTEM INTERFACE ${CORNERD_EIGEN_DIR})

find_path(CORNERD_JSON_DIR nlohmann/json.hpp PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
add_library(cornerd_json INTERFACE)

find_path(CORNERD_SPDLOG_DIR spdlog/spdlog.h PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
find_package(Threads REQUIRED)
add_library(cornerd_spdlog INTERFACE)
target_compile_definitions(cornerd_spdlog INTERFACE SPDLOG_HEADER_ONLY SPDLOG_FMT_EXTERNAL
                                                    FMT_HEADER_ONLY)
target_link_libraries(cornerd_spdlog INTERFACE Threads::Threads)

find_path(CORNERD_CLI11_DIR CLI/CLI.hpp PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
add_library(cornerd_cli11 INTERFACE)

# cornerd-web alone; its headers need no library of Boost.
find_path(CORNERD_BOOST_DIR boost/beast.hpp PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH)
add_library(cornerd_boost INTERFACE)
target_link_libraries(cornerd_boost INTERFACE Threads::Threads)

# cornerd-mqtt, the fleet commands of cornerctl and cornerd-web: libmosquitto's header alone. The library is opened
# at run time (src/mqtt/mosquitto_library.cpp), so that a robot without a broker needs no package of it.
find_path(CORNERD_MOSQUITTO_DIR mosquitto.h PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)
add_library(cornerd_mosquitto INTERFACE)
target_link_libraries(cornerd_mosquitto INTERFACE ${CMAKE_DL_LIBS} Threads::Threads)

# Shared libraries that the tools link where they are found. A cross build goes without them.
find_package(PNG QUIET)
set(CORNERD_PNG ${PNG_FOUND})
if(NOT CMAKE_CROSSCOMPILING)
  find_package(yaml-cpp QUIET)
endif()
set(CORNERD_YAML ${yaml-cpp_FOUND})
# Drawn plans: SVG and DXF (src/plan).
if(NOT CMAKE_CROSSCOMPILING)
  find_package(pugixml QUIET)
  find_path(CORNERD_DXFLIB_DIR dxflib/dl_dxf.h)
  find_library(CORNERD_DXFLIB_LIBRARY dxflib)
endif()
set(CORNERD_PUGIXML ${pugixml_FOUND})
if(CORNERD_DXFLIB_DIR AND CORNERD_DXFLIB_LIBRARY)
  set(CORNERD_DXFLIB ${CORNERD_DXFLIB_LIBRARY})
endif()

if(CORNERD_BUILD_TESTS)
  # From Debian's sources, so that sanitized and ARM builds get a library built like themselves.
  set(INSTALL_GTEST OFF CACHE BOOL "" FORCE)
  add_subdirectory(/usr/src/googletest ${CMAKE_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
  foreach(library gtest gtest_main gmock gmock_main)
    target_link_libraries(${library} PUBLIC $<BUILD_INTERFACE:cornerd_sanitizer>)
    target_compile_options(${library} PRIVATE -O0)
    get_target_property(directories ${library} INTERFACE_INCLUDE_DIRECTORIES)
    set_target_properties(${library} PROPERTIES
      INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${directories}")
  endforeach()
endif()
