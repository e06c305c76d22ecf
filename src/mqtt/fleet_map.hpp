// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "client/request.hpp"
#include "mqtt/broker_link.hpp"
#include "mqtt/config.hpp"
#include "mqtt/map_announcement.hpp"
#include "mqtt/map_folder.hpp"
#include "mqtt/robot_state.hpp"

namespace cornerd::mqtt {

/// Keeps the robot on the newest version of its site's map: fetches it, checks it, and switches the
/// daemon to it. A wrong one changes nothing but RobotState::map_problem.
class FleetMap {
 public:
  using Ask = std::function<bool(std::string line, std::function<void(const client::Answer&)>)>;

  /// Config, broker and robot must outlive it.
  FleetMap(const BridgeConfig& config, BrokerLink& broker, RobotState& robot, Ask ask);

  void on_broker(const Message& message);
  /// The daemon has started, or was started again: it runs the map of its own config.
  void on_daemon_connected();
  /// Its MAP is in RobotState::map_hash.
  void on_daemon_map();
  /// Asks a daemon again that was busy or silent, and says what does not come. Call it every few
  /// seconds.
  void retry();

 private:
  void take_announcement(std::string_view payload);
  void take_file(std::string_view text);
  void stop_fetching();
  void switch_daemon();
  void on_answer(std::uint64_t version, const client::Answer& answer);
  void refuse(std::uint64_t version, const std::string& reason);
  /// Writes RobotState::maps.
  void describe();

  const BridgeConfig& config_;
  BrokerLink& broker_;
  RobotState& robot_;
  Ask ask_;
  MapFolder folder_;
  std::optional<MapAnnouncement> fetched_;  ///< being fetched
  bool is_fetch_slow_ = false;
  bool is_switch_due_ = false;
  bool is_retry_due_ = false;
};

}  // namespace cornerd::mqtt
