// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::tool {

/// One trajectory of a drive.
struct DrawnTrack {
  std::string name;
  std::string_view colour;
  std::span<const core::Vec2> points;
  bool is_truth = false;
};

/// Trajectories of the same drive, to scale. `map`: draws its walls; may be null.
std::string draw_drive(std::string_view title, std::span<const DrawnTrack> tracks,
                       const core::WallMap* map);

}  // namespace cornerd::tool
