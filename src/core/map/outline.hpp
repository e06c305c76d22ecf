// SPDX-License-Identifier: MIT
// From drawn walls to the surfaces that a lidar sees.
#pragma once

#include <span>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Tolerance for equal points and lines: far below a lidar's resolution, far above the rounding of
/// coordinates of a kilometre.
inline constexpr double kGeometryEpsilon_m = 1e-6;

/// Footprint of a wall: a box around its centre line. half_width_m is 0 for a line wall.
struct WallBox {
  Vec2 centre = Vec2::Zero();
  Vec2 along = Vec2::UnitX();  ///< unit vector
  double half_length_m = 0;
  double half_width_m = 0;

  explicit WallBox(const Wall& wall);
  bool is_line() const { return half_width_m == 0; }
  Vec2 to_local(const Vec2& point) const;
  Extent extent() const;
};

/// Why a map is refused that no building has and that takes minutes to load.
inline constexpr const char* kTooManyCrossings =
    "too many walls cross each other: hatching, or noise?";

/// The surface of the union of all walls. Parts inside another wall are removed, shared parts kept
/// once, collinear parts joined. Throws std::invalid_argument, as does corners_of, where too many
/// walls cross each other.
std::vector<Face> outline_of(std::span<const WallBox> boxes);

/// Every vertex where the free space opens by another angle than pi.
std::vector<Corner> corners_of(std::span<const Face> faces);

}  // namespace cornerd::core
