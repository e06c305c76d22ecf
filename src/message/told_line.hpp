// SPDX-License-Identifier: MIT
// What the daemon tells, as a client reads it: one line in, one checked value out. Fields that a
// newer daemon adds are passed over.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/pose_estimate.hpp"
#include "message/request.hpp"

namespace cornerd::message {

struct ToldVersion {
  std::string program;
  std::string version;
};

struct ToldPose {
  std::uint64_t seq = 0;
  core::TimeNs t_ns = 0;
  core::PoseState state = core::PoseState::kLost;
  std::optional<core::Pose2> T_map_base;  ///< of the states that name a place
  std::optional<core::Covariance3> covariance;
  std::string room;  ///< empty: none
  std::uint64_t corners = 0;
  std::uint64_t inliers = 0;
  std::optional<double> rmse_m;
  std::optional<double> age_s;
  std::vector<core::Alternative> alternatives;  ///< best first
};

/// x, y in metres in the lidar's frame.
struct ToldBreakpoint {
  core::Vec2 position = core::Vec2::Zero();
  bool is_corner = false;  ///< else a terminal
};

struct ToldBreakpoints {
  core::TimeNs t_ns = 0;
  std::vector<ToldBreakpoint> points;
};

/// Texts are empty and numbers absent where STATUS left them out.
struct ToldStatus {
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
  std::vector<std::pair<std::string, std::uint64_t>> counters;
  std::string odometry_state;
  std::string odometry_hint;                ///< what is wrong with it
  std::optional<double> odometry_readings;  ///< so far, the refused ones included
  struct Sensor {
    std::string name;
    std::string state;
    std::string detail;
  };
  std::vector<Sensor> odometry_sensors;
  std::optional<double> latency_p50_s;
  std::optional<double> latency_p99_s;

  /// 0 where there is no such counter.
  std::uint64_t counter(std::string_view name) const;
};

struct ToldEvent {
  core::TimeNs t_ns = 0;
  std::string what;
  std::string detail;
};

struct ToldError {
  std::string code;
  std::string text;
};

using ToldLine = std::variant<RequestError, ToldVersion, ToldPose, RecordedScan, ToldBreakpoints,
                              ToldStatus, ToldEvent, ToldError, OtherLine>;

/// Never throws; RequestError where the line is none of the daemon's.
ToldLine parse_told_line(std::string_view line);

}  // namespace cornerd::message
