// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "client/request.hpp"
#include "client/subscription.hpp"
#include "mqtt/broker_link.hpp"
#include "mqtt/config.hpp"
#include "mqtt/fleet_map.hpp"
#include "mqtt/instant_actions.hpp"
#include "mqtt/robot_state.hpp"
#include "mqtt/vda5050.hpp"

namespace cornerd::mqtt {

/// Between one daemon and one broker: takes what either says, and sends what the other needs. For
/// one thread; waits for nothing.
class Bridge {
 public:
  /// Sends one request line to the daemon, and later calls the function with the answer. False if
  /// too many wait.
  using Ask = std::function<bool(std::string line, std::function<void(const client::Answer&)>)>;
  /// Steady time for intervals; UNIX time for people.
  struct Now {
    double steady_s = 0;
    std::chrono::system_clock::time_point unix_time;
  };

  /// The config and the broker must outlive it.
  Bridge(const BridgeConfig& config, BrokerLink& broker, Ask ask);

  /// `text`: the message, or why the daemon is lost.
  void on_daemon(client::Event event, std::string_view text, const Now& now);
  void on_broker(const Message& message);
  /// Publishes what is due. Call it 20 times a second.
  void tick(const Now& now);
  /// The orderly end.
  void say_goodbye(const Now& now);

  const RobotState& robot() const { return robot_; }

 private:
  void take_line(std::string_view line, const Now& now);
  void greet(const Now& now);
  void publish_visualization(const Now& now);
  void take_actions(std::string_view payload);
  void start(const InstantAction& action);
  void init_position(const InstantAction& action);
  void set_pose(const InstantAction& action);
  void finish(const std::string& id, const client::Answer& answer);
  /// What makes a new state worth a message.
  std::string signature(const Now& now) const;

  const BridgeConfig& config_;
  BrokerLink& broker_;
  Ask ask_;
  Vda5050 vda5050_;
  RobotState robot_;
  std::optional<FleetMap> map_;
  std::uint64_t greeted_ = 0;  ///< connections
  bool state_is_requested_ = false;
  bool factsheet_is_requested_ = false;
  std::string told_;  ///< signature of the last state
  double state_s_ = 0;
  double report_s_ = 0;
  double visualization_s_ = 0;
  double map_retry_s_ = 0;
};

}  // namespace cornerd::mqtt
