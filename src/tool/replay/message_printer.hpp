// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "calibration/drive_monitor.hpp"
#include "calibration/fault_list.hpp"
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
  /// `map`: null: there is none.
  MessagePrinter(Output& output, message::ClassSet classes, const core::WallMap* map,
                 const settings::Config* config = nullptr);

  void print_scan(const core::Scan& scan, const core::ScanResult& result);

  /// Counts odometry lines, for the hint in STATUS.
  void note(const core::OdometryReading& reading);
  void refuse(const message::RequestError& error);

  void print_odom(const core::OdometryPose& pose);

  /// A pose between two scans.
  void print_pose(const core::PoseEstimate& pose);

  /// Resets the rates for the next file.
  void begin_recording();
  /// STATUS if a second of the data's time has passed since the last one.
  void print_status_when_due(core::TimeNs t_ns, const drivers::StreamCounters& counters);
  /// That of the recording's end also tells what is wrong with a map that does not fit: it takes
  /// seconds.
  void print_status(core::TimeNs t_ns, const drivers::StreamCounters& counters,
                    drivers::LidarState state);

 private:
  calibration::FaultList faults(const message::StatusFields& status, bool has_ended);

  struct Mark {
    core::TimeNs t_ns = 0;
    drivers::StreamCounters counters;
  };

  const settings::Config* config_;  ///< null: no odometry, no variants of a map
  Output& output_;
  message::ClassSet classes_;
  const core::WallMap* map_;
  const core::FloorPlan* plan_;  ///< of the map
  message::LineWriter writer_;
  std::optional<Mark> last_status_;
  core::OdometrySummary odometry_;  ///< as of the last scan
  message::OdometryInputMonitor odometry_lines_;
  bool has_odometry_lines_ = false;
  calibration::RecentPoses recent_;
  calibration::RecentScans scans_;                  ///< where there is a map
  std::optional<calibration::DriveMonitor> drive_;  ///< where there is odometry
};

}  // namespace cornerd::tool
