// SPDX-License-Identifier: MIT
// HQ packets (answer type 0x83), 781 bytes: A5, a time of unknown unit (8), 96 nodes of 8 bytes, a
// CRC-32. Each node has its own angle, unlike a capsule's samples.
#pragma once

#include <cstdint>
#include <span>

#include "drivers/rplidar/wire/capsule.hpp"

namespace cornerd::rplidar {

inline constexpr std::uint8_t kHqSync = 0xA5;

/// All three: of a whole packet.
bool has_right_crc(std::span<const std::uint8_t> packet);
int first_angle_q6(std::span<const std::uint8_t> packet);
void decode_hq(std::span<const std::uint8_t> packet, std::span<SweepSample> samples);

}  // namespace cornerd::rplidar
