// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::core {

/// Whether the lidar has seen the turns that the gyro told of. Until then nobody knows which of
/// wheels and gyro is wrong where they differ: a wheel that slips looks as a gyro that is mounted
/// upside down.
class GyroProof {
 public:
  void drove(const OdometryIncrement& step) {
    if (step.is_gap || !step.has_gyro) interrupt();
    told_rad_ += step.gyro_rad;
    duration_s_ += step.duration_s();
  }

  /// A fix for the time that was reached.
  void fixed(double heading_rad) {
    const double seen_rad = angle_between(from_rad_, heading_rad);
    const double rotation_rad = std::max(std::abs(seen_rad), std::abs(told_rad_));
    if (is_open_ && rotation_rad < kTurn_rad && duration_s_ < kLongest_s) return;
    if (is_open_ && rotation_rad >= kTurn_rad && duration_s_ < kLongest_s) {
      const double off_rad = std::abs(normalize_angle(told_rad_ - seen_rad));
      const bool agrees = off_rad < kSlack_rad + kSlackShare * rotation_rad;
      turns_ = std::clamp(turns_ + (agrees ? 1 : -1), 0, kMost);
    }
    from_rad_ = heading_rad;
    told_rad_ = duration_s_ = 0;
    is_open_ = true;
  }

  /// The next fix has nothing to do with the last one.
  void interrupt() { is_open_ = false; }

  bool holds() const { return turns_ >= kEnough; }

 private:
  static constexpr double kTurn_rad = radians(6);
  /// In a longer time the bias of a gyro looks like a turn, and a turn may be a whole one.
  static constexpr double kLongest_s = 1.5;
  static constexpr double kSlack_rad = radians(2);
  static constexpr double kSlackShare = 0.25;
  static constexpr int kEnough = 3;
  static constexpr int kMost = 6;

  bool is_open_ = false;
  double from_rad_ = 0;
  double told_rad_ = 0;
  double duration_s_ = 0;
  int turns_ = 0;  ///< that agreed, less those that did not
};

}  // namespace cornerd::core
