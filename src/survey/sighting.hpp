// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/geometry/pose2.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::survey {

using core::squared;

/// The face of a wall as one turn saw it, in the frame that the lidar had in the middle of the
/// turn. Its angle and its place across itself are independent at the centroid.
struct Sighting {
  double normal_rad = 0;  ///< from the wall towards the lidar
  core::Vec2 centroid = core::Vec2::Zero();
  double sigma_angle_rad = 0;
  double sigma_offset_m = 0;
  double begin_m = 0;  ///< of the wall's seen part along it, from the centroid; free space on the
  double end_m = 0;    ///< left of the way from begin to end
  std::uint32_t support = 0;  ///< samples

  double length_m() const { return end_m - begin_m; }
};

/// What a wall's normal says of the way along it: the normal is on its left.
inline core::Vec2 along(const core::Vec2& normal) { return {normal.y(), -normal.x()}; }

}  // namespace cornerd::survey
