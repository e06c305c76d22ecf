// SPDX-License-Identifier: MIT
#include "core/polar_scan.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"

namespace cornerd::core {

PolarScan::PolarScan() { points_.reserve(kMaxSamplesPerTurn); }

void PolarScan::assign(const Scan& scan, double min_range_m, double max_range_m) {
  points_.clear();
  for (const Sample& sample : scan.samples()) {
    const double range = sample.range_m;
    if (!(range >= min_range_m && range <= max_range_m)) continue;
    const double bearing = sample.bearing_rad;
    const double c = std::cos(bearing);
    const double s = std::sin(bearing);
    points_.push_back({bearing, range, c, s, range * c, range * s});
  }
  spacing_rad_ = scan.empty() ? 0 : kTwoPi / static_cast<double>(scan.size());
  sort();
}

void PolarScan::sort() {
  const auto by_bearing = [](const PolarPoint& a, const PolarPoint& b) {
    return a.bearing_rad < b.bearing_rad;
  };
  if (points_.size() < 2) return;
  // The A1 turns clockwise: its samples come with falling bearings, from somewhere in the circle.
  if (angle_between(points_[0].bearing_rad, points_[1].bearing_rad) < 0) {
    std::reverse(points_.begin(), points_.end());
  }
  const auto seam = std::adjacent_find(
      points_.begin(), points_.end(),
      [](const PolarPoint& a, const PolarPoint& b) { return b.bearing_rad < a.bearing_rad - kPi; });
  if (seam != points_.end()) std::rotate(points_.begin(), seam + 1, points_.end());

  // What is left out of order is a few places away from where it belongs, unless the input is no
  // turn of a lidar at all: then the work is bounded by a sort that is indifferent to the order.
  std::size_t moves_left = 16 * points_.size();
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const PolarPoint moving = points_[i];
    std::size_t place = i;
    while (place > 0 && by_bearing(moving, points_[place - 1])) {
      if (moves_left-- == 0) {
        points_[place] = moving;
        std::sort(points_.begin(), points_.end(), by_bearing);
        return;
      }
      points_[place] = points_[place - 1];
      --place;
    }
    points_[place] = moving;
  }
}

}  // namespace cornerd::core
