// SPDX-License-Identifier: MIT
// From walls as people draw them to the surfaces that a lidar sees.
#pragma once

#include <span>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Points closer than this are one point, lines closer than this are one line. Far below what a
/// lidar can tell, far above the rounding of coordinates of a kilometre.
inline constexpr double kGeometryEpsilon_m = 1e-6;

/// Where one wall stands: a box around its centre line. half_width_m is 0 for a line wall.
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

/// The surface of the union of all walls: what lies inside another wall is left out, what two walls
/// share is there once, what continues straight is one face.
std::vector<Face> outline_of(std::span<const WallBox> boxes);

/// Every place where the free space opens by another angle than pi.
std::vector<Corner> corners_of(std::span<const Face> faces);

}  // namespace cornerd::core
