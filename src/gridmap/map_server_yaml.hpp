// SPDX-License-Identifier: MIT
// The YAML file that map_server (ROS 1 and 2) writes beside the picture of a map.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace cornerd::gridmap {

/// map_server's mode: two thresholds; two thresholds with values in between; per cent.
enum class ShadeMode : std::uint8_t { kTrinary, kScale, kRaw };

struct MapServerYaml {
  std::string image;  ///< as written, relative to the YAML file
  double resolution_m = 0;
  core::Pose2 T_map_picture;  ///< of the picture's lower left corner
  bool negate = false;        ///< white is occupied
  double occupied_threshold = 0;
  double free_threshold = 0;
  ShadeMode mode = ShadeMode::kTrinary;
  std::vector<std::string> unknown_keys;  ///< keys of other programs, ignored
};

/// False in a build without libyaml-cpp: parse_map_server_yaml() then throws.
bool has_yaml();

/// Reads the first document of a YAML text, by libyaml-cpp. Throws GridError, with the key or the
/// line.
MapServerYaml parse_map_server_yaml(std::string_view text);

}  // namespace cornerd::gridmap
