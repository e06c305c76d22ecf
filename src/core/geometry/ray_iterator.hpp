// SPDX-License-Identifier: MIT
#pragma once

#include "core/geometry/pose2.hpp"
#include "core/geometry/small_angle.hpp"

namespace cornerd::core {

/// Unit vectors of the rays in the order of arrival: each is the previous one rotated, every 32nd
/// is computed afresh, so that errors do not add up.
class RayIterator {
 public:
  const Vec2& at(double bearing_rad) {
    if (left_-- == 0) {
      left_ = kMaxRotationsInARow;
      ray_ = unit_vector(bearing_rad);
    } else {
      ray_ = rotated(ray_, bearing_rad - bearing_rad_);
    }
    bearing_rad_ = bearing_rad;
    return ray_;
  }

 private:
  static constexpr int kMaxRotationsInARow = 31;
  int left_ = 0;
  double bearing_rad_ = 0;
  Vec2 ray_ = Vec2::Zero();
};

}  // namespace cornerd::core
