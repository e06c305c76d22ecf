// SPDX-License-Identifier: MIT
#include "drivers/ydlidar/ydlidar_packet.hpp"

#include <cmath>

namespace cornerd::ydlidar {
namespace {

// The optics of both manuals, millimetres.
constexpr float kLaserOffset_mm = 21.8F;
constexpr float kCrossing_mm = 155.3F;
constexpr float kDegree = 57.2957795F;

unsigned word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] | static_cast<unsigned>(bytes[at + 1]) << 8;
}

}  // namespace

bool has_header(std::span<const std::uint8_t, kHeaderSize> bytes) {
  return bytes[0] == 0xAA && bytes[1] == 0x55 && bytes[3] > 0 && (bytes[4] & 1U) != 0 &&
         (bytes[6] & 1U) != 0;
}

std::size_t packet_size(std::span<const std::uint8_t, kHeaderSize> header) {
  return kHeaderSize + 2 * std::size_t{header[3]};
}

bool has_right_check_code(std::span<const std::uint8_t> bytes) {
  unsigned code = 0;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) code ^= word_at(bytes, i);
  return code == 0;  // the check code is the XOR of all other words
}

Packet parse_packet(std::span<const std::uint8_t> bytes) {
  Packet packet;
  packet.samples = bytes[3];
  packet.is_zero_packet = (bytes[2] & 1U) != 0;
  if (packet.is_zero_packet) packet.rate_hz = (bytes[2] >> 1U) / 10.0;
  packet.first_deg = static_cast<float>(word_at(bytes, 4) >> 1U) / 64;
  packet.last_deg = static_cast<float>(word_at(bytes, 6) >> 1U) / 64;
  packet.ranges = bytes.subspan(kHeaderSize);
  return packet;
}

float angle_correction_deg(int dist_q2) {
  if (dist_q2 == 0) return 0;
  const float dist_mm = static_cast<float>(dist_q2) / 4;
  return kDegree * std::atan(kLaserOffset_mm * (kCrossing_mm - dist_mm) / (kCrossing_mm * dist_mm));
}

}  // namespace cornerd::ydlidar
