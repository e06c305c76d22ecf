// SPDX-License-Identifier: MIT
#include "drivers/rplidar/wire/standard_node.hpp"

namespace cornerd::rplidar {
namespace {

// The core's correction of the angle reaches a little past 360 degrees, never far.
constexpr int kMaxRawAngleQ6 = 380 * 64;

}  // namespace

std::optional<StandardNode> parse_standard_node(std::span<const std::uint8_t> bytes) {
  const bool start = (bytes[0] & 1) != 0;
  const bool not_start = (bytes[0] & 2) != 0;
  const bool check = (bytes[1] & 1) != 0;
  const int raw_angle_q6 = (bytes[1] | bytes[2] << 8) >> 1;
  if (start == not_start || !check || raw_angle_q6 > kMaxRawAngleQ6) return std::nullopt;
  return StandardNode{.start_flag = start,
                      .quality = static_cast<std::uint8_t>(bytes[0] >> 2),
                      .angle_q6 = static_cast<std::uint16_t>(raw_angle_q6 % kFullRevolutionQ6),
                      .dist_q2 = static_cast<std::uint16_t>(bytes[3] | bytes[4] << 8)};
}

}  // namespace cornerd::rplidar
