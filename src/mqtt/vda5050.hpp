// SPDX-License-Identifier: MIT
// Messages of VDA 5050, https://github.com/VDA5050/VDA5050: 2.0, 2.1 and 3.0.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "mqtt/config.hpp"
#include "mqtt/robot_state.hpp"

namespace cornerd::mqtt {

/// Writes the messages of one robot. `unix_time`: of the clock that people read.
class Vda5050 {
 public:
  using UnixTime = std::chrono::system_clock::time_point;
  enum class Connection : std::uint8_t { kOnline, kOffline, kBroken };

  explicit Vda5050(const BridgeConfig& config) : config_(config) {}

  /// "uagv/v2/MANUFACTURER/SERIAL/state".
  std::string topic(std::string_view name) const;

  std::string connection(Connection state, UnixTime now);
  /// `now_s`: steady time, see RobotState.
  std::string state(const RobotState& robot, UnixTime now, double now_s);
  std::string visualization(const RobotState& robot, UnixTime now, double now_s);
  std::string factsheet(UnixTime now);

 private:
  bool is_v3() const { return config_.vda5050 == VdaVersion::kV30; }
  nlohmann::json header(UnixTime now, std::uint32_t& count) const;
  nlohmann::json position(const RobotState& robot, double now_s) const;

  const BridgeConfig& config_;
  // The standard counts each topic's messages.
  std::uint32_t connections_ = 0;
  std::uint32_t states_ = 0;
  std::uint32_t visualizations_ = 0;
  std::uint32_t factsheets_ = 0;
};

/// ISO 8601, UTC, with milliseconds.
std::string iso_time(std::chrono::system_clock::time_point time);

}  // namespace cornerd::mqtt
