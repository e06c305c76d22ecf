// SPDX-License-Identifier: MIT
// One packet of an LDROBOT lidar (LD06, LD19, STL-19P, STL-27L), as in its development manual:
// 54 2C, speed, start angle, 12 x (distance, confidence), end angle, time, CRC-8. Little-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cornerd::ld {

inline constexpr std::size_t kPacketSize = 47;
inline constexpr std::size_t kPacketSamples = 12;
inline constexpr int kRevolution_cdeg = 36'000;
inline constexpr int kClockWrap_ms = 30'000;

struct Packet {
  int speed_deg_s = 0;
  int start_cdeg = 0;  ///< of the first sample, degrees * 100, clockwise, below 36,000
  int end_cdeg = 0;    ///< of the last sample
  int t_ms = 0;        ///< of the device's clock
  std::array<std::uint16_t, kPacketSamples> dist_mm{};  ///< 0: no return
  std::array<std::uint8_t, kPacketSamples> confidence{};

  /// From the first to the last sample, degrees * 100.
  int span_cdeg() const { return (end_cdeg - start_cdeg + kRevolution_cdeg) % kRevolution_cdeg; }
};

/// Whether a packet begins here, as far as its first two bytes say.
constexpr bool has_header(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 2 && bytes[0] == 0x54 && bytes[1] == 0x2C;
}

/// CRC-8, polynomial 0x4D, initial value 0.
std::uint8_t crc8(std::span<const std::uint8_t> bytes);

bool has_right_crc(std::span<const std::uint8_t, kPacketSize> bytes);
Packet parse_packet(std::span<const std::uint8_t, kPacketSize> bytes);

}  // namespace cornerd::ld
