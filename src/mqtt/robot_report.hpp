// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"
#include "mqtt/config.hpp"
#include "mqtt/robot_state.hpp"

namespace cornerd::mqtt {

/// What a robot says of itself to its site: `cornerd/SITE/robot/MANUFACTURER/SERIAL`, retained.
struct RobotReport {
  std::string manufacturer;
  std::string serial;
  core::TimeNs t_ns = 0;  ///< UNIX time
  std::string state;      ///< of POSE; "absent" without a daemon
  bool is_localized = false;
  std::string room;
  std::optional<core::Pose2> T_map_base;
  std::string map;
  std::uint64_t map_version = 0;  ///< 0: no map of the site
  std::string map_hash;           ///< SHA-256
  std::string problem;            ///< a sentence for a person; empty if all is well
};

RobotReport report_of(const RobotState& robot, const BridgeConfig& config, core::TimeNs t_ns,
                      double now_s);
std::string robot_report_json(const RobotReport& report);
/// nullopt if it is none. Never throws.
std::optional<RobotReport> parse_robot_report(std::string_view payload);

std::string robot_topic(const BridgeConfig& config);

}  // namespace cornerd::mqtt
