// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/scan.hpp"
#include "core/sensor_bias.hpp"

namespace cornerd::core {

/// A return with all that the steps of the algorithm ask of it again and again.
struct PolarPoint {
  Vec2 place() const { return {x_m, y_m}; }
  Vec2 ray() const { return {ray_x, ray_y}; }

  double bearing_rad = 0;  ///< in [-pi, pi]
  double range_m = 0;
  double ray_x = 0;  ///< unit vector of the ray, lidar frame
  double ray_y = 0;
  double x_m = 0;
  double y_m = 0;
  double dt_s = 0;  ///< when it was measured, from the time that the turn is seen at
};

/// The returns of one turn in the order of their bearing, whatever the order of their arrival: an
/// A1 corrects each bearing by the range, so that some samples step back.
class PolarScan {
 public:
  PolarScan();

  /// Keeps the samples within the limits. Allocates nothing.
  /// `motion`: of the lidar; each return is moved to where the lidar of time `at_ns` would have
  /// seen it, so that a turn taken in motion has straight walls.
  /// `bias`: of the lidar, taken off each return.
  void assign(const Scan& scan, double min_range_m, double max_range_m, TimeNs at_ns = 0,
              const Twist2& motion = {}, const SensorBias& bias = {});

  /// For a turn that is still going on: empty, with what is known of its samples' distance.
  void begin(double spacing_rad);
  /// The next return, at a bearing that is not below the last one's; it may go on beyond pi.
  /// Ignored where the turn is full.
  void append(double bearing_rad, double range_m);

  std::span<const PolarPoint> points() const { return points_; }
  std::size_t size() const { return points_.size(); }
  const PolarPoint& operator[](std::size_t i) const { return points_[i]; }

  /// Usual distance in bearing from one sample to the next, empty ones included.
  double spacing_rad() const { return spacing_rad_; }

  /// Of bearing without returns, but for lonely ones: an outlier in the dark fills no gap. The
  /// whole circle where there are none that have company.
  double widest_gap_rad() const;

 private:
  void sort();

  std::vector<PolarPoint> points_;
  double spacing_rad_ = 0;
};

}  // namespace cornerd::core
