// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/capsule.hpp"

#include <functional>
#include <numeric>

namespace cornerd::rplidar {

bool has_capsule_sync(std::span<const std::uint8_t> bytes) {
  return bytes[0] >> 4 == 0xA && bytes[1] >> 4 == 0x5;
}

bool has_right_checksum(std::span<const std::uint8_t> capsule) {
  const int expected = (capsule[0] & 0xF) | (capsule[1] & 0xF) << 4;
  return std::accumulate(capsule.begin() + 2, capsule.end(), 0, std::bit_xor<>()) == expected;
}

int start_angle_q6(std::span<const std::uint8_t> capsule) {
  return ((capsule[2] | capsule[3] << 8) & 0x7FFF) % kFullRevolutionQ6;
}

bool begins_stream(std::span<const std::uint8_t> capsule) { return (capsule[3] & 0x80) != 0; }

Verdict match_capsule(std::span<const std::uint8_t> bytes, WireFormat format, bool final) {
  const Verdict too_few = final ? Verdict::kNo : Verdict::kMore;
  const std::size_t size = capsule_size(format);
  if (bytes.size() < 2) return too_few;
  if (!has_capsule_sync(bytes)) return Verdict::kNo;
  if (bytes.size() < size) return too_few;
  if (!has_right_checksum(bytes.first(size))) return Verdict::kNo;
  if (bytes.size() < size + 2) return final ? Verdict::kYes : Verdict::kMore;
  return has_capsule_sync(bytes.subspan(size)) ? Verdict::kYes : Verdict::kNo;
}

}  // namespace cornerd::rplidar
