// SPDX-License-Identifier: MIT
#pragma once

#include "core/geometry/pose2.hpp"
#include "core/odometry/motion_filter.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::core {

/// A measured motion against another measurement of it.
struct MotionError {
  double error2 = 0;
  double variance = 0;  ///< by the noise of both
  double motion2 = 0;   ///< of the larger one
};

/// Whether a sensor measures a motion at all: a hidden Markov model with two states. A right one's
/// errors have the variance of its noise but for rare slips; a wrong one (swapped, reversed, dead,
/// in other units) is off by as much as the motion.
class SensorTrust {
 public:
  void add(const MotionError& error);
  double p_right() const;

 private:
  double log_odds_ = 2.2;  ///< nine of ten are right
};

/// Compares what wheels and gyro measured between fixes with the fixes themselves.
class MotionTrust {
 public:
  explicit MotionTrust(const DriveGeometry& geometry) : geometry_(geometry) {}

  void add(const OdometryIncrement& step, const MotionFilter& filter);
  /// The wheels' rotation against the gyro's in a scan: slips differ for a moment, a wrong sensor
  /// in each turn.
  void add_comparison(const RotationComparison& rotations);
  void add_fix(const Pose2& T_map_base, const Covariance3& covariance, const MotionFilter& filter);
  /// The next fix may be anywhere.
  void interrupt() { has_fix_ = false; }

  /// The gyro's rotation is that of the wheels or better.
  bool uses_gyro() const;
  /// False where a sensor that the motion is taken from is rather wrong than right.
  bool is_healthy() const;
  /// The motion since the last fix is small, or of sensors that are known to be right.
  bool carries() const;

 private:
  /// Motion since the last comparison.
  struct Sum {
    double measured = 0;
    double seen = 0;
    double noise = 0;         ///< variance
    double end_variance = 0;  ///< at its begin, of the fix and the counts
  };
  static void compare(Sum& sum, SensorTrust& trust, double end_variance, double calibration,
                      double least);
  double p_rotation() const;

  DriveGeometry geometry_;
  SensorTrust travel_;
  SensorTrust wheel_rotation_;
  SensorTrust gyro_rotation_;
  Sum travel_m_;
  Sum wheel_rad_;
  Sum gyro_rad_;
  double duration_s_ = 0;
  double agreement_ = 0;  ///< log odds that neither wheels nor gyro broke since the last fix
  double longest_s_ = 0;  ///< increment since the last fix
  bool may_be_stuck_ = false;
  bool has_gyro_ = false;
  bool has_fix_ = false;
  Pose2 T_map_fix_;
  double travel_since_fix_m_ = 0;
  double rotation_since_fix_rad_ = 0;
};

}  // namespace cornerd::core
