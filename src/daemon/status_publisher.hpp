// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "calibration/drive_fault_text.hpp"
#include "calibration/drive_monitor.hpp"
#include "daemon/line_quality.hpp"
#include "daemon/localization.hpp"
#include "daemon/map_examiner.hpp"
#include "daemon/message_server.hpp"
#include "daemon/odometry_clients.hpp"
#include "daemon/odometry_reader.hpp"
#include "daemon/scan_publisher.hpp"
#include "daemon/systemd.hpp"
#include "drivers/lidar_driver.hpp"
#include "message/line_writer.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// Timing and privileges of the daemon, in addition to Localization's.
struct DaemonHealth {
  int priority = 0;  ///< SCHED_FIFO priority of the reader thread; 0 if it has none
  bool memory_is_locked = false;
  core::LatencyHistogram server;  ///< of its ticks of 0.1 s
};

/// Publishes the state of lidar and daemon as STATUS, changes of the lidar as EVENT, and both to
/// the service manager and the log.
class StatusPublisher {
 public:
  StatusPublisher(MessageServer& server, Notifier& notifier);

  /// Call it for each change of the lidar. Returns true if STATUS should be published.
  bool update(const drivers::LidarChange& change, core::TimeNs t_ns);
  void publish(const drivers::LidarStatus& lidar, const ScanPublisher& scans,
               Localization& localization, const DaemonHealth& health, core::TimeNs t_ns);
  /// Where there is a report: what is known of the walls of `map`. Publishes EVENT for each new
  /// change.
  void set_walls(const WallReport* report, const core::WallMap* map, core::TimeNs t_ns);
  /// Why what is learned of the walls and of the lidar is not kept; empty if nothing is wrong.
  void set_file_problems(const std::string& walls, const std::string& calibration) {
    walls_problem_ = walls;
    calibration_problem_ = calibration;
  }
  /// Of the scans that follow.
  void configure(const settings::Config& config);
  /// For the faults of the odometry. Readings before the scans that they belong to.
  void observe(const ScanReport& report);
  void observe(const core::OdometryReading& reading);
  /// The reader of the board's sensors; null if there is none.
  void set_odometry(OdometryReader* odometry) { odometry_ = odometry; }
  /// The clients that send odometry; null for other sources.
  void set_odometry(OdometryClients* clients) { odometry_clients_ = clients; }

 private:
  /// With the last fault while the driver tries again, where most of the time nothing is wrong yet.
  drivers::LidarStatus with_last_fault(const drivers::LidarStatus& lidar);
  /// Logs each text once until the lidar runs, because retries repeat the same states.
  void log_once(const drivers::LidarChange& change, const std::string& text);

  MessageServer& server_;
  std::optional<message::StatusFields::Mount> mount_;
  calibration::OdometryNames names_;
  std::optional<calibration::DriveMonitor> drive_;  ///< where there is odometry
  std::uint32_t generation_ = 0;                    ///< of the last scan's pipeline
  MapExaminer map_examiner_;
  OdometryReader* odometry_ = nullptr;
  OdometryClients* odometry_clients_ = nullptr;
  Notifier& notifier_;
  message::StatusFields::Walls walls_;
  LineQuality line_quality_;
  std::string walls_problem_;
  std::string calibration_problem_;
  std::vector<core::MapChange> changes_;  ///< of the map, in the last report
  message::LineWriter line_;
  std::optional<drivers::LidarChange> last_;
  std::optional<drivers::LidarChange> last_fault_;  ///< since the lidar ran
  std::string text_;
  std::set<std::string> logged_texts_;  ///< since the lidar last ran
};

}  // namespace cornerd::daemon
