# Debian 12 armhf on a BeagleBone Black: AM335x, Cortex-A8 r3p2, VFPv3 and NEON, hard float.
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(CMAKE_LIBRARY_ARCHITECTURE arm-linux-gnueabihf)
set(CORNERD_DEBIAN_ARCHITECTURE armhf)
# GCC notes an ABI change of its version 7 at every by-value struct; nothing here was built by 6.
set(cornerd_cpu_flags "-mcpu=cortex-a8 -mfpu=neon -mfloat-abi=hard -Wno-psabi")
set(cornerd_emulator qemu-arm -cpu cortex-a8)
include(${CMAKE_CURRENT_LIST_DIR}/cross.cmake)
