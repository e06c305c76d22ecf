// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::tool {

/// One way of reckoning a drive.
struct DrawnTrack {
  std::string name;
  std::string_view colour;
  std::span<const core::Vec2> points;
  bool is_truth = false;
};

/// Ways of the same drive, to scale, on a picture that is as large as all of them. `map`: its walls
/// too; may be null.
std::string draw_drive(std::string_view title, std::span<const DrawnTrack> tracks,
                       const core::WallMap* map);

}  // namespace cornerd::tool
