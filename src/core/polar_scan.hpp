// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/scan.hpp"
#include "core/sensor_bias.hpp"

namespace cornerd::core {

/// A return with the values that the algorithms need repeatedly.
struct PolarPoint {
  Vec2 position() const { return {x_m, y_m}; }
  Vec2 ray() const { return {ray_x, ray_y}; }

  double bearing_rad = 0;  ///< in [-pi, pi]
  double range_m = 0;
  double ray_x = 0;  ///< unit vector of the ray, lidar frame
  double ray_y = 0;
  double x_m = 0;
  double y_m = 0;
  double dt_s = 0;  ///< time of measurement, relative to the time that the scan is deskewed to
};

/// Every n-th of the points, all around: at least `least` of them where there are as many, and less
/// than twice that. Returns n.
std::size_t take_few(std::span<const PolarPoint> points, std::size_t least,
                     std::vector<PolarPoint>& few);

/// The returns of a scan sorted by bearing. An A1 corrects each bearing by the range, so that
/// samples arrive slightly out of order.
class PolarScan {
 public:
  PolarScan();

  /// Keeps the samples within the range limits. Allocates nothing.
  /// `motion`: of the lidar; each return is deskewed to the lidar's pose at `at_ns`.
  /// `bias`: of the lidar, removed from each return.
  void assign(const Scan& scan, double min_range_m, double max_range_m, TimeNs at_ns = 0,
              const ScanMotion& motion = {}, const SensorBias& bias = {});

  /// Starts an empty scan that append() fills. `spacing_rad`: expected distance in bearing between
  /// samples.
  void begin(double spacing_rad);
  /// Adds a return with a bearing not below the last one's, which may go on beyond pi. Ignored
  /// where the scan is full.
  void append(double bearing_rad, double range_m);

  std::span<const PolarPoint> points() const { return points_; }
  std::size_t size() const { return points_.size(); }
  const PolarPoint& operator[](std::size_t i) const { return points_[i]; }

  /// Mean distance in bearing between samples, including those without a return.
  double spacing_rad() const { return spacing_rad_; }

  /// Largest gap of the field of view: bearings without returns, isolated returns not counted. 2 pi
  /// where all returns are isolated. Found when first asked for: by one thread at a time.
  double largest_gap_rad() const;

 private:
  void sort();
  double largest_step_rad() const;
  double find_largest_gap_rad() const;

  std::vector<PolarPoint> points_;
  double spacing_rad_ = 0;
  mutable std::optional<double> largest_gap_rad_;
};

}  // namespace cornerd::core
