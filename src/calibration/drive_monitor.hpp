// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "calibration/drive_faults.hpp"
#include "calibration/motion_window.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "core/odometry/reading_gate.hpp"

namespace cornerd::calibration {

/// With limits that no wrong unit exceeds, so that what is wrong shows in the motion.
core::OdometryConfig with_wide_limits(core::OdometryConfig config);

/// Compares odometry with the lidar while a robot drives. Independent of the odometry filter, which
/// rejects what it cannot use. Bounded memory; not for the real-time threads.
class DriveMonitor {
 public:
  /// `config`: its limits are widened, as wrong units exceed them.
  DriveMonitor(const core::OdometryConfig& config, const core::Pose2& T_base_lidar);

  /// True where what was compared so far holds for this config.
  bool is_of(const core::OdometryConfig& config, const core::Pose2& T_base_lidar) const {
    return config_.is_of_same_robot(config) && T_base_lidar_ == T_base_lidar;
  }

  /// Both in the order of time, by one clock.
  void add(const core::OdometryReading& reading);
  void add(core::TimeNs t_ns, const core::Pose2& T_map_base);

  /// The next pose is no motion from the last: another map, or an initial pose.
  void interrupt() { windows_.interrupt(); }

  /// From the newest windows; computed where there are some new ones. None where readings have
  /// ended.
  const DriveFaults& faults();

 private:
  core::OdometryConfig config_;
  core::Pose2 T_base_lidar_;
  core::ReadingGate gate_;
  MotionWindows windows_;
  core::TimeNs newest_ns_ = 0;  ///< reading
  DriveFaults faults_;
  std::size_t evaluated_ = 0;  ///< windows, at the last evaluation
};

}  // namespace cornerd::calibration
