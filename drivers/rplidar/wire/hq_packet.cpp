// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/hq_packet.hpp"

#include <array>
#include <cstddef>

namespace cornerd::rplidar {
namespace {

constexpr std::size_t kHqHeaderSize = 9;
constexpr std::size_t kHqNodeSize = 8;
constexpr std::size_t kHqCrcSize = 4;
/// The CRC covers the packet filled up with zeros to a multiple of four bytes, as in the SDK.
constexpr std::size_t kHqPadding = 3;
/// 100 m: no lidar of the family measures farther.
constexpr std::uint32_t kMaxDistanceQ2 = 400'000;

/// CRC-32 of IEEE 802.3, reflected.
constexpr std::array<std::uint32_t, 256> kCrcTable = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xEDB88320 : crc >> 1;
    table[byte] = crc;
  }
  return table;
}();

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) {
    number |= static_cast<std::uint32_t>(bytes[at + i]) << 8 * i;
  }
  return number;
}

/// The wire has 16384 steps to a right angle.
std::uint16_t node_angle_q6(std::span<const std::uint8_t> packet, std::size_t node) {
  const std::uint32_t angle = number_at(packet, kHqHeaderSize + node * kHqNodeSize, 2);
  return static_cast<std::uint16_t>((angle * 90 >> 8) % kFullRevolutionQ6);
}

}  // namespace

bool has_right_crc(std::span<const std::uint8_t> packet) {
  std::uint32_t crc = 0xFFFFFFFF;
  const auto add = [&](std::uint8_t byte) { crc = crc >> 8 ^ kCrcTable[(crc ^ byte) & 0xFF]; };
  for (const std::uint8_t byte : packet.first(packet.size() - kHqCrcSize)) add(byte);
  for (std::size_t i = 0; i < kHqPadding; ++i) add(0);
  return ~crc == number_at(packet, packet.size() - kHqCrcSize, kHqCrcSize);
}

int first_angle_q6(std::span<const std::uint8_t> packet) { return node_angle_q6(packet, 0); }

void decode_hq(std::span<const std::uint8_t> packet, std::span<SweepSample> samples) {
  for (std::size_t k = 0; k < capsule_samples(WireFormat::kHq); ++k) {
    const auto node = packet.subspan(kHqHeaderSize + k * kHqNodeSize, kHqNodeSize);
    const std::uint32_t dist_q2 = number_at(node, 2, 4);
    samples[k] = {.angle_q6 = node_angle_q6(packet, k),
                  .dist_q2 = dist_q2 <= kMaxDistanceQ2 ? dist_q2 : 0,
                  .quality = node[6],
                  .starts_scan = (node[7] & 1) != 0};
  }
}

}  // namespace cornerd::rplidar
