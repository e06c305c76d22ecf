# Programs of GoogleTest cases. CTest runs a program at once rather than a case at once: starting it
# 1,700 times takes longer than most cases do. Each run writes its cases to cases/NAME.xml in the build
# folder, and tests/run counts them there.

# What `tests/run` builds, what `tests/run tsan` does: the layers with threads of their own, and what
# `tests/run arm` does.
add_custom_target(short_tests)
add_custom_target(threaded_tests)
add_custom_target(board_tests)

# What most tests include. Not where sources are compiled one by one: there each shows what it needs.
if(CMAKE_UNITY_BUILD)
  file(CONFIGURE OUTPUT test_headers.cpp CONTENT "")
  add_library(test_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/test_headers.cpp)
  target_link_libraries(test_headers PRIVATE cornerd_eigen cornerd_sanitizer cornerd_warnings gmock
    gtest)
  target_compile_options(test_headers PRIVATE -O0)
  target_precompile_headers(test_headers PRIVATE <gmock/gmock.h> <gtest/gtest.h> <Eigen/Core>
    <nlohmann/json.hpp> <algorithm> <cmath> <filesystem> <fstream> <sstream> <string> <thread> <vector>)
endif()

# cornerd_add_test_run(NAME PROGRAM FILTER LABELS label... SHARDS n): a run of a program's cases, in
# n processes.
function(cornerd_add_test_run name program filter)
  cmake_parse_arguments(arg "SERIAL" "SHARDS;COST" "LABELS" ${ARGN})
  if(NOT arg_SHARDS)
    set(arg_SHARDS 1)
  endif()
  math(EXPR last "${arg_SHARDS} - 1")
  foreach(shard RANGE ${last})
    set(test ${name})
    set(environment "")
    if(arg_SHARDS GREATER 1)
      string(APPEND test ".${shard}")
      set(environment "GTEST_TOTAL_SHARDS=${arg_SHARDS};GTEST_SHARD_INDEX=${shard}")
    endif()
    add_test(NAME ${test} COMMAND ${program} --gtest_filter=${filter}
      --gtest_output=xml:${CMAKE_BINARY_DIR}/cases/${test}.xml)
    set_tests_properties(${test} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 1200
      ENVIRONMENT "${environment}")
    if(arg_SERIAL)
      set_tests_properties(${test} PROPERTIES RUN_SERIAL ON)
    endif()
    if(arg_COST)
      set_tests_properties(${test} PROPERTIES COST ${arg_COST})
    endif()
  endforeach()
endfunction()

# cornerd_add_test_program(NAME SOURCES file... LINK target... [LABELS label...] [SHARDS n] [COST n]
#   [LONG pattern...] [ALONE pattern...] [NATIVE pattern...])
# A program of GoogleTest cases.
#   LABELS  `long`: only `tests/run all` builds and runs it. `slow`: besides, not in sanitized and
#           emulated builds, since it tests algorithms and neither memory nor the board.
#           `host`: not in emulated builds, since a board has no use for it.
#           `threads`: the thread sanitizer runs it.
#           `realtime`: it waits for clocks and lines, and more of them run at once, after all others.
#   LONG    cases that only `tests/run all` runs, each pattern in processes of its own
#   ALONE   cases that run while nothing else does
#   NATIVE  cases of minutes of simulated scans, whose code others call as well: not in sanitized and
#           emulated builds, which take fifty times as long
#   SHARDS  the number of processes that share cases; COST: the larger, the sooner it starts
function(cornerd_add_test_program name)
  cmake_parse_arguments(arg "" "SHARDS;COST" "SOURCES;LINK;LABELS;LONG;ALONE;NATIVE" ${ARGN})
  if("host" IN_LIST arg_LABELS AND CMAKE_CROSSCOMPILING)
    return()
  endif()
  if("slow" IN_LIST arg_LABELS)
    if(CMAKE_CROSSCOMPILING OR CORNERD_SANITIZE)
      return()
    endif()
    list(APPEND arg_LABELS long)
  endif()
  # They replace operator new, which the thread sanitizer does itself.
  if(CORNERD_SANITIZE MATCHES "thread")
    list(FILTER arg_SOURCES EXCLUDE REGEX "allocation")
  endif()
  cornerd_add_executable(${name} SOURCES ${arg_SOURCES} LINK ${arg_LINK} gmock gtest gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  # What is tested is optimised, in its library; most of a test's time is its compilation.
  target_compile_options(${name} PRIVATE -O0)
  if(CMAKE_UNITY_BUILD)
    target_precompile_headers(${name} REUSE_FROM test_headers)
  endif()
  # A source that replaces operator new must not be seen by code that calls it.
  foreach(source ${arg_SOURCES})
    if(source MATCHES "allocation")
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  target_include_directories(${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${name} PRIVATE CORNERD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if("threads" IN_LIST arg_LABELS)
    add_dependencies(threaded_tests ${name})
  endif()
  if(NOT "long" IN_LIST arg_LABELS)
    add_dependencies(short_tests ${name})
  endif()
  add_dependencies(board_tests ${name})
  if((CMAKE_CROSSCOMPILING OR CORNERD_SANITIZE) AND NOT arg_SHARDS)
    set(arg_SHARDS 2)
  endif()

  list(JOIN arg_ALONE ":" alone)
  string(JOIN ":" apart ${arg_LONG} ${arg_ALONE})
  if(CMAKE_CROSSCOMPILING OR CORNERD_SANITIZE)
    string(JOIN ":" apart ${apart} ${arg_NATIVE})
  endif()
  cornerd_add_test_run(${name} ${name} "-${apart}" LABELS ${arg_LABELS} SHARDS ${arg_SHARDS}
    COST ${arg_COST})
  set(number 0)
  foreach(pattern IN LISTS arg_LONG)
    cornerd_add_test_run(${name}.long.${number} ${name} "${pattern}" LABELS ${arg_LABELS} long
      SHARDS ${arg_SHARDS} COST 100)
    math(EXPR number "${number} + 1")
  endforeach()
  if(alone)
    cornerd_add_test_run(${name}.alone ${name} "${alone}" LABELS ${arg_LABELS} SERIAL)
  endif()
endfunction()
