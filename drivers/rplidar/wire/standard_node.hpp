// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace cornerd::rplidar {

inline constexpr std::size_t kNodeSize = 5;
inline constexpr int kFullRevolutionQ6 = 360 * 64;

/// One measurement of the standard scan (A1 protocol, answer type 0x81).
struct StandardNode {
  bool start_flag = false;
  std::uint8_t quality = 0;
  std::uint16_t angle_q6 = 0;  ///< reduced to one turn
  std::uint16_t dist_q2 = 0;
};

/// Reads the node at the beginning of `bytes` (at least kNodeSize of them). nullopt where one of
/// the format's few redundancies is violated: S and its inverse, the check bit, the angle's limit.
std::optional<StandardNode> parse_standard_node(std::span<const std::uint8_t> bytes);

}  // namespace cornerd::rplidar
