// SPDX-License-Identifier: MIT
#pragma once

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::core {

/// What wheels and gyro say of the time between two readings, by the parameters as estimated then.
struct MeasuredMotion {
  TimeNs to_ns = 0;
  double duration_s = 0;  ///< 0: a gap, of which nothing is known
  Pose2 motion;           ///< in the frame of `base` at its begin
  double travel_m = 0;
  double rotation_rad = 0;
};

/// The robot in the frame `odom` of REP 105: dead reckoning alone, continuous, drifting. Begins at
/// the origin and never jumps: no fix corrects it, better parameters hold for what is driven
/// afterwards, and over a gap of the readings it stands still.
struct OdometryPose {
  void add(const MeasuredMotion& moved) {
    t_ns = moved.to_ns;
    const bool is_known = moved.duration_s > 0;
    vx_m_s = is_known ? moved.travel_m / moved.duration_s : 0;
    omega_rad_s = is_known ? moved.rotation_rad / moved.duration_s : 0;
    T_odom_base = T_odom_base * moved.motion;
  }

  TimeNs t_ns = 0;
  Pose2 T_odom_base;
  double vx_m_s = 0;  ///< forward, of `base`
  double omega_rad_s = 0;
};

}  // namespace cornerd::core
