// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>

#include "daemon/localization.hpp"
#include "daemon/message_server.hpp"
#include "daemon/odometry_clients.hpp"
#include "daemon/odometry_reader.hpp"
#include "daemon/scan_publisher.hpp"
#include "daemon/systemd.hpp"
#include "drivers/lidar_driver.hpp"
#include "message/line_writer.hpp"

namespace cornerd::daemon {

/// How the daemon itself keeps its time, beside what Localization knows.
struct DaemonHealth {
  int priority = 0;  ///< of the thread that reads the port; 0: an ordinary one
  bool memory_is_locked = false;
  core::LatencyHistogram server;  ///< of its ticks
};

/// Says how lidar and daemon are: as STATUS, as EVENT where the lidar's state or fault changes, to
/// the service manager and to the log.
class StatusPublisher {
 public:
  StatusPublisher(MessageServer& server, Notifier& notifier);

  /// For each state that the lidar came to. True where it is a change: time for a STATUS.
  bool update(const drivers::LidarChange& change, core::TimeNs t_ns);
  void publish(const drivers::LidarStatus& lidar, const ScanPublisher& scans,
               Localization& localization, const DaemonHealth& health, core::TimeNs t_ns);
  /// Whose sensors to tell of; null: none of this program's.
  void set_odometry(OdometryReader* odometry) { odometry_ = odometry; }
  /// The clients that odometry comes from; null: it comes otherwise.
  void set_odometry(OdometryClients* clients) { odometry_clients_ = clients; }

 private:
  /// Between two tries a driver goes through the same states again and again: each is worth a line
  /// the first time.
  void log_once(const drivers::LidarChange& change, const std::string& text);

  MessageServer& server_;
  OdometryReader* odometry_ = nullptr;
  OdometryClients* odometry_clients_ = nullptr;
  Notifier& notifier_;
  message::LineWriter line_;
  std::optional<drivers::LidarChange> last_;
  std::string text_;
  std::set<std::string> logged_texts_;  ///< in the log, since the lidar last ran
};

}  // namespace cornerd::daemon
