# Debian 12 armhf on a BeagleBone Black: AM335x, Cortex-A8 r3p2, VFPv3 and NEON, hard float.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(CMAKE_C_COMPILER arm-linux-gnueabihf-gcc)
set(CMAKE_CXX_COMPILER arm-linux-gnueabihf-g++)
set(CMAKE_LIBRARY_ARCHITECTURE arm-linux-gnueabihf)
set(cornerd_cpu_flags "-mcpu=cortex-a8 -mfpu=neon -mfloat-abi=hard")
set(CMAKE_C_FLAGS_INIT "${cornerd_cpu_flags}")
# GCC notes an ABI change of its version 7 at every by-value struct; nothing here was built by 6.
set(CMAKE_CXX_FLAGS_INIT "${cornerd_cpu_flags} -Wno-psabi")
# The board needs no C++ runtime package of a certain version.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static-libstdc++ -static-libgcc")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
# Headers without an architecture are shared with the build machine; its libraries are not.
set(CMAKE_IGNORE_PATH /usr/lib/x86_64-linux-gnu /usr/lib/x86_64-linux-gnu/cmake
                      /usr/lib/aarch64-linux-gnu /usr/lib/aarch64-linux-gnu/cmake)
find_program(CORNERD_QEMU_ARM NAMES qemu-arm-static qemu-arm)
if(CORNERD_QEMU_ARM)
  set(CMAKE_CROSSCOMPILING_EMULATOR
      "${CORNERD_QEMU_ARM};-cpu;cortex-a8;-L;/usr/arm-linux-gnueabihf" CACHE STRING "")
endif()
