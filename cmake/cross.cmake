# What the toolchain files of the ARM boards share. They set before they include it: CMAKE_SYSTEM_PROCESSOR,
# CMAKE_LIBRARY_ARCHITECTURE (Debian's name of the target), cornerd_cpu_flags, and cornerd_emulator (the
# name of QEMU's program and its options).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${CMAKE_LIBRARY_ARCHITECTURE}-gcc)
set(CMAKE_CXX_COMPILER ${CMAKE_LIBRARY_ARCHITECTURE}-g++)
set(CMAKE_C_FLAGS_INIT "${cornerd_cpu_flags}")
set(CMAKE_CXX_FLAGS_INIT "${cornerd_cpu_flags}")
# The board needs no C++ runtime package of a certain version.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static-libstdc++ -static-libgcc")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
# Headers without an architecture are shared with the build machine; its libraries are not.
foreach(architecture x86_64-linux-gnu aarch64-linux-gnu arm-linux-gnueabihf)
  if(NOT architecture STREQUAL CMAKE_LIBRARY_ARCHITECTURE)
    list(APPEND CMAKE_IGNORE_PATH /usr/lib/${architecture} /usr/lib/${architecture}/cmake)
  endif()
endforeach()
list(POP_FRONT cornerd_emulator emulator)
find_program(CORNERD_QEMU NAMES ${emulator}-static ${emulator})
if(CORNERD_QEMU)
  set(CMAKE_CROSSCOMPILING_EMULATOR
      "${CORNERD_QEMU};${cornerd_emulator};-L;/usr/${CMAKE_LIBRARY_ARCHITECTURE}" CACHE STRING "")
endif()
