// SPDX-License-Identifier: MIT
// What map_server (ROS 1 and 2) writes beside the picture of a map.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace cornerd::gridmap {

/// How shades are read: by two thresholds; the same, with shares in between; or as per cent.
enum class ShadeMode : std::uint8_t { kTrinary, kScale, kRaw };

struct MapServerYaml {
  std::string image;  ///< as written: relative to the file
  double resolution_m = 0;
  core::Pose2 T_map_picture;  ///< of the picture's lower left corner
  bool negate = false;        ///< white is occupied
  double occupied_threshold = 0;
  double free_threshold = 0;
  ShadeMode mode = ShadeMode::kTrinary;
  std::vector<std::string> unknown_keys;  ///< of other programs; passed over
};

/// The little of YAML that these files are made of: one key a line with a plain or quoted scalar or
/// a list of numbers, in brackets (over any lines) or a line each; YAML 1.1's booleans; a byte
/// order mark; comments; `---`. All else is refused, as is a key that is there twice. Throws
/// GridError with the key.
MapServerYaml parse_map_server_yaml(std::string_view text);

}  // namespace cornerd::gridmap
