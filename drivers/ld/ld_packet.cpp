// SPDX-License-Identifier: MIT
#include "drivers/ld/ld_packet.hpp"

namespace cornerd::ld {
namespace {

constexpr std::uint8_t kPolynomial = 0x4D;

constexpr std::array<std::uint8_t, 256> make_table() {
  std::array<std::uint8_t, 256> table{};
  for (unsigned byte = 0; byte < table.size(); ++byte) {
    unsigned crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc << 1 ^ ((crc & 0x80) != 0 ? kPolynomial : 0U);
    table[byte] = static_cast<std::uint8_t>(crc);
  }
  return table;
}

constexpr auto kTable = make_table();

int word_at(std::span<const std::uint8_t, kPacketSize> bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8;
}

}  // namespace

std::uint8_t crc8(std::span<const std::uint8_t> bytes) {
  std::uint8_t crc = 0;
  for (const std::uint8_t byte : bytes) crc = kTable[crc ^ byte];
  return crc;
}

bool has_right_crc(std::span<const std::uint8_t, kPacketSize> bytes) {
  return crc8(bytes.first<kPacketSize - 1>()) == bytes[kPacketSize - 1];
}

Packet parse_packet(std::span<const std::uint8_t, kPacketSize> bytes) {
  Packet packet;
  packet.speed_deg_s = word_at(bytes, 2);
  packet.start_cdeg = word_at(bytes, 4) % kRevolution_cdeg;
  for (std::size_t i = 0; i < kPacketSamples; ++i) {
    packet.dist_mm[i] = static_cast<std::uint16_t>(word_at(bytes, 6 + 3 * i));
    packet.confidence[i] = bytes[8 + 3 * i];
  }
  packet.end_cdeg = word_at(bytes, 42) % kRevolution_cdeg;
  packet.t_ms = word_at(bytes, 44) % kClockWrap_ms;
  return packet;
}

}  // namespace cornerd::ld
