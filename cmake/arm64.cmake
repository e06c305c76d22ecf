# Debian 12 arm64: a Raspberry Pi 3 or later, and other boards with a Cortex-A53 or better.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CORNERD_DEBIAN_ARCHITECTURE arm64)
# Without fused multiply-add, sums are those of the other architectures.
set(cornerd_cpu_flags "-mcpu=cortex-a53 -ffp-contract=off")
set(cornerd_emulator qemu-aarch64 -cpu cortex-a53)
include(${CMAKE_CURRENT_LIST_DIR}/cross.cmake)
