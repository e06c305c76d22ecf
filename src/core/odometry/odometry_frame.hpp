// SPDX-License-Identifier: MIT
#pragma once

#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/reading_gate.hpp"

namespace cornerd::core {

/// The robot in the frame `odom` of REP 105: dead reckoning alone, continuous, drifting.
struct OdometryPose {
  TimeNs t_ns = 0;
  Pose2 T_odom_base;
  double vx_m_s = 0;  ///< forward, of `base`
  double omega_rad_s = 0;
};

/// Integrates odometry readings as they come. The pose begins at the origin and never jumps: no fix
/// corrects it, better parameters hold for what is driven afterwards, and over a gap of the
/// readings it stands still. Allocates nothing.
class OdometryFrame {
 public:
  explicit OdometryFrame(const OdometryConfig& config) : config_(config), gate_(config) {}

  /// For another robot's config begins with the next reading; the pose stays.
  void configure(const OdometryConfig& config);

  /// `parameters`: as estimated until now. Null where the reading ended no increment; else valid
  /// until the next call.
  const OdometryPose* add(const OdometryReading& reading, const OdometryParameters& parameters);

 private:
  OdometryConfig config_;
  ReadingGate gate_;
  OdometryPose pose_;
};

}  // namespace cornerd::core
