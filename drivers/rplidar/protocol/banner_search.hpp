// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace cornerd::rplidar {

/// Finds the text that the core prints when it is switched on or reset: "RP LIDAR System." and two
/// more lines, which differ from firmware to firmware.
class BannerSearch {
 public:
  /// True where a banner's first words are complete in `bytes`, which may begin in an earlier call.
  bool add(std::span<const std::uint8_t> bytes);

 private:
  std::size_t matched_ = 0;
};

}  // namespace cornerd::rplidar
