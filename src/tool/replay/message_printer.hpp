// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "calibration/drive_monitor.hpp"
#include "core/scan.hpp"
#include "core/scan_result.hpp"
#include "drivers/lidar_driver.hpp"
#include "message/line_writer.hpp"
#include "message/odometry_input_monitor.hpp"
#include "message/request.hpp"
#include "settings/config.hpp"
#include "tool/command_line/output.hpp"

namespace cornerd::tool {

/// Prints the daemon's messages of the chosen classes for a recording.
class MessagePrinter {
 public:
  /// `plan`: names the rooms; null: there is no map.
  MessagePrinter(Output& output, message::ClassSet classes, const core::FloorPlan* plan,
                 const settings::Config* config = nullptr);

  void print_scan(const core::Scan& scan, const core::ScanResult& result);

  /// Counts odometry lines, for the hint in STATUS.
  void note(const core::OdometryReading& reading);

  void print_odom(const core::OdometryPose& pose);

  /// A pose between two scans.
  void print_pose(const core::PoseEstimate& pose);

  /// Resets the rates for the next file.
  void begin_recording();
  /// As of the last scan.
  const core::OdometrySummary& odometry() const { return odometry_; }
  /// STATUS if a second of the data's time has passed since the last one.
  void print_status_when_due(core::TimeNs t_ns, const drivers::StreamCounters& counters);
  void print_status(core::TimeNs t_ns, const drivers::StreamCounters& counters,
                    drivers::LidarState state);

 private:
  struct Mark {
    core::TimeNs t_ns = 0;
    drivers::StreamCounters counters;
  };

  const settings::Config* config_;  ///< of the odometry; null: there is none
  Output& output_;
  message::ClassSet classes_;
  const core::FloorPlan* plan_;
  message::LineWriter writer_;
  std::optional<Mark> last_status_;
  core::OdometrySummary odometry_;  ///< as of the last scan
  message::OdometryInputMonitor odometry_lines_;
  std::optional<calibration::DriveMonitor> drive_;  ///< where there is odometry
};

}  // namespace cornerd::tool
