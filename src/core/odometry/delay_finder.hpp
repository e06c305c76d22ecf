// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/geometry/pose2.hpp"
#include "core/odometry/motion_path.hpp"
#include "core/types.hpp"

namespace cornerd::core {

/// How late the readings are, roughly but from anywhere: how far the robot went and turned from fix
/// to fix is compared with what wheels and gyro say of that time, put off by each of many delays.
/// The filter, which knows one delay and its doubt, finds what is off by a few hundredths of a
/// second itself, and far better (odometer_delay_test). Changes of speed alone show anything.
/// Allocates nothing.
class DelayFinder {
 public:
  /// A fix, in the order of their times. `path` is in the readings' times, and is asked about this
  /// fix when it goes beyond it far enough.
  void fixed(TimeNs t_ns, const Pose2& T_map_base, const Covariance3& covariance,
             const MotionPath& path);

  /// The fixes that wait are of a path that is no more.
  void interrupt() { waiting_ = 0; }

  /// The delay that all speaks for while much speaks against `delay_s`; seconds.
  std::optional<double> instead_of(double delay_s) const;

  /// What delays other than `delay_s` may still be true, as a variance about it, s^2, where
  /// `first_s` is the likeliest before any was seen, give or take `usual_s`; nothing of what the
  /// grid is too coarse for.
  double doubt_about(double delay_s, double first_s, double usual_s) const;

 private:
  static constexpr int kMost = 10;  ///< steps to either side
  static constexpr double kStep_s = 0.02;
  static constexpr std::size_t kDelays = 2 * kMost + 1;
  static constexpr std::size_t kWaiting = 8;
  struct Fix {
    TimeNs t_ns = 0;
    Pose2 T_map_base;
    double place_m2 = 0;
    double heading_rad2 = 0;
  };

  static double delay_s(std::size_t i) { return kStep_s * (static_cast<double>(i) - kMost); }
  void compare(const Fix& from, const Fix& to, const MotionPath& path);
  double cost_of(double delay_s) const;

  std::array<Fix, kWaiting> fixes_;
  std::size_t waiting_ = 0;
  std::array<double, kDelays> cost_{};  ///< squared surprises in units of what they may be
  double pairs_ = 0;                    ///< that told something
};

}  // namespace cornerd::core
