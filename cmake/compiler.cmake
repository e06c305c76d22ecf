# What every target is compiled with, and the two functions that make targets.

add_library(cornerd_sanitizer INTERFACE)
if(CORNERD_SANITIZE)
  # vptr looks at memory through a pipe: wrong where a test has used up all descriptors. The others are half of the
  # compilation; the address sanitizer stops at such an access, and -Wcast-align at a cast to what is aligned to more.
  target_compile_options(cornerd_sanitizer INTERFACE -fsanitize=${CORNERD_SANITIZE}
    -fno-sanitize=vptr,null,object-size,pointer-overflow,alignment -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(cornerd_sanitizer INTERFACE -fsanitize=${CORNERD_SANITIZE})
  target_compile_definitions(cornerd_sanitizer INTERFACE CORNERD_SANITIZED)
endif()

add_library(cornerd_warnings INTERFACE)
target_compile_options(cornerd_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow
  -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
  -Wcast-align$<$<CXX_COMPILER_ID:GNU>:=strict> $<$<BOOL:${CORNERD_WERROR}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports these inside Eigen's and the standard library's own inlined code.
  target_compile_options(cornerd_warnings INTERFACE
    -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
endif()

# Nobody asks errno after a root: with it, the compiler calls a function where an instruction does.
add_compile_options(-fno-math-errno)

# Sources are compiled in batches: without sections a program gets all of a batch for one function of it,
# the daemon the papers' baselines and the fits of calibration.
add_compile_options($<$<CONFIG:Release>:-ffunction-sections>)
add_link_options($<$<CONFIG:Release>:-Wl,--gc-sections>)

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # A tenth of a compilation is collecting garbage that a machine with memory need not collect.
  cmake_host_system_information(RESULT memory_MiB QUERY TOTAL_PHYSICAL_MEMORY)
  if(memory_MiB GREATER 6000)
    add_compile_options("SHELL:--param ggc-min-heapsize=1000000")
  endif()
endif()

find_program(CORNERD_CCACHE ccache)
if(CORNERD_CCACHE)
  # Without this it caches nothing that uses a precompiled header.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros ${CORNERD_CCACHE})
endif()

# cornerd_add_library(NAME SOURCES file... LINK target... [COLD] [HOT])
# A static library; its headers are included from the top of src/ ("core/scan.hpp") or of the tree
# ("drivers/rplidar/decoder.hpp"). COLD: nobody waits for what it computes but for its compilation.
# HOT: unoptimised, as a sanitized build is, it would take ten times as long.
function(cornerd_add_library name)
  cmake_parse_arguments(arg "COLD;HOT" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES})
  if((arg_COLD AND NOT CORNERD_SANITIZE) OR (arg_HOT AND CORNERD_SANITIZE))
    target_compile_options(${name} PRIVATE -O1)
  endif()
  if(CORNERD_FUZZ)
    # What libFuzzer is guided by; in hot code without its calls at every comparison.
    set(coverage -fsanitize=fuzzer-no-link)
    if(arg_HOT)
      set(coverage -fsanitize-coverage=inline-8bit-counters,pc-table)
    endif()
    target_compile_options(${name} PRIVATE ${coverage})
  endif()
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${arg_LINK} cornerd_sanitizer PRIVATE cornerd_warnings)
endfunction()

# cornerd_add_executable(NAME SOURCES file... LINK target...)
function(cornerd_add_executable name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINK} cornerd_sanitizer cornerd_warnings)
endfunction()
