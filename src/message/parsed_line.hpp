// SPDX-License-Identifier: MIT
// Parses the daemon's messages for clients. Unknown fields are ignored.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/map/wall_map.hpp"
#include "core/pose_estimate.hpp"
#include "message/request.hpp"

namespace cornerd::message {

struct ParsedVersion {
  std::string program;
  std::string version;
};

struct ParsedPose {
  std::uint64_t seq = 0;
  core::TimeNs t_ns = 0;
  core::PoseState state = core::PoseState::kLost;
  std::optional<core::Pose2> T_map_base;  ///< absent if ambiguous or lost
  std::optional<core::Covariance3> covariance;
  std::string map;   ///< empty where the daemon has one map only
  std::string room;  ///< empty if none
  std::uint64_t corners = 0;
  std::uint64_t inliers = 0;
  std::optional<double> rmse_m;
  std::optional<double> age_s;
  std::optional<double> p_wrong;                ///< absent if predicted, lost, or by part of a scan
  std::vector<core::Alternative> alternatives;  ///< best first
};

/// Position in metres in the lidar frame.
struct ParsedBreakpoint {
  core::Vec2 position = core::Vec2::Zero();
  bool is_corner = false;  ///< else a terminal
};

struct ParsedBreakpoints {
  core::TimeNs t_ns = 0;
  std::vector<ParsedBreakpoint> points;
};

/// Texts are empty and numbers absent if STATUS leaves them out.
struct ParsedStatus {
  core::TimeNs t_ns = 0;
  std::string lidar_state;
  std::string lidar_fault;
  std::string lidar_detail;
  std::string lidar_model;
  std::string lidar_firmware;
  std::string lidar_health;
  std::string lidar_mode;
  std::optional<double> rate_hz;
  std::optional<double> samples_hz;
  std::optional<core::Pose2> T_base_lidar;
  std::vector<std::pair<std::string, std::uint64_t>> counters;
  std::string odometry_state;
  std::string odometry_hint;
  std::optional<double> odometry_readings;  ///< since the start, including rejected ones
  struct Sensor {
    std::string name;
    std::string state;
    std::string detail;
  };
  std::vector<Sensor> odometry_sensors;
  std::optional<double> latency_p50_s;
  std::optional<double> latency_p99_s;
  std::vector<std::string> faults;  ///< names, in the order of weight
  std::string hint;                 ///< of the first fault, for a person

  /// 0 if there is no such counter.
  std::uint64_t counter(std::string_view name) const;
};

struct ParsedEvent {
  core::TimeNs t_ns = 0;
  std::string what;
  std::string detail;
};

/// The robot in the frame `odom`.
struct ParsedOdom {
  core::TimeNs t_ns = 0;
  core::Pose2 T_odom_base;
  double vx_m_s = 0;
  double omega_rad_s = 0;
};

/// The map in which the daemon localizes.
struct ParsedMap {
  core::FloorPlan plan;
};

struct ParsedError {
  std::string code;
  std::string text;
};

using ParsedLine =
    std::variant<RequestError, ParsedVersion, ParsedPose, RecordedScan, ParsedBreakpoints,
                 ParsedStatus, ParsedEvent, ParsedOdom, ParsedMap, ParsedError, OtherLine>;

/// Never throws. RequestError if the line is not a message of the daemon.
ParsedLine parse_line(std::string_view line);

}  // namespace cornerd::message
