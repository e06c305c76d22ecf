// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>

#include "daemon/localization.hpp"
#include "daemon/message_server.hpp"
#include "daemon/notifier.hpp"
#include "daemon/turn_publisher.hpp"
#include "drivers/lidar_driver.hpp"
#include "message/line.hpp"

namespace cornerd::daemon {

/// Says how lidar and daemon are: as STATUS, as EVENT where the lidar's state changes, to the
/// service manager and to the log.
class StatusPublisher {
 public:
  StatusPublisher(MessageServer& server, Notifier& notifier);

  /// To be called often. True where the lidar's state or its reason has changed: time for a STATUS.
  bool notice_change(const drivers::LidarStatus& lidar, core::TimeNs t_ns);
  void publish(const drivers::LidarStatus& lidar, const TurnPublisher& turns,
               const Localization& localization, core::TimeNs t_ns);

 private:
  /// Between two tries a driver goes through the same states again and again: each is worth a line
  /// the first time.
  void log_once(drivers::LidarState state, const std::string& text);

  MessageServer& server_;
  Notifier& notifier_;
  message::LineWriter line_;
  std::optional<drivers::LidarState> state_;
  std::string text_;
  std::set<std::string> said_;  ///< in the log, since the lidar last ran
};

}  // namespace cornerd::daemon
