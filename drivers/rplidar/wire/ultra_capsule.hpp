// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "drivers/rplidar/wire/capsule.hpp"

namespace cornerd::rplidar {

struct VarbitDistance {
  int mm = 0;
  int level = 0;  ///< its predictions have steps of 2^level mm
};

/// The 12-bit floating point of the ultra format: 1 mm steps below 512 mm, 16 mm beyond 16384.
VarbitDistance decode_varbit(int code);

/// Samples of an ultra capsule (answer type 0x84). `next_major`: first_major() of the next capsule,
/// the base of the last predictions.
void decode_ultra(std::span<const std::uint8_t, kUltraSize> capsule, int next_major,
                  const Sweep& sweep, std::span<SweepSample, kUltraSamples> samples);

/// The 12-bit code of a capsule's first distance.
int first_major(std::span<const std::uint8_t> capsule);

}  // namespace cornerd::rplidar
