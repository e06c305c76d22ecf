// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "message/parsed_line.hpp"

namespace cornerd::mqtt {

enum class ActionStatus : std::uint8_t { kRunning, kFinished, kFailed };

struct ActionState {
  std::string id;
  std::string type;
  ActionStatus status = ActionStatus::kRunning;
  std::string result = {};  ///< why it failed
};

/// A map of the site that this robot keeps.
struct KeptMap {
  std::string id;
  std::uint64_t version = 0;
  bool is_in_use = false;
};

/// What the daemon last said of the robot, and what the bridge did. Plain data: messages are made
/// of it.
struct RobotState {
  bool is_daemon_connected = false;
  std::string daemon_problem = "not connected yet";
  std::string daemon_version;
  std::optional<message::ParsedPose> pose;  ///< the last one
  std::optional<core::Pose2> T_map_base;    ///< the last that was known
  double pose_arrival_s = 0;                ///< steady time
  std::string map_name;                     ///< of the last MAP
  std::string map_hash;
  std::vector<std::string> faults;
  std::string hint;
  bool is_driving = false;
  std::string last_node;
  std::deque<ActionState> actions;  ///< oldest first, at most kMaxActionStates
  std::vector<KeptMap> maps;
  std::string map_problem;  ///< why the site's newest map is not in use; empty if it is

  /// 95 % of poses are nearer (chi-square, 2 degrees of freedom); nullopt without a covariance.
  std::optional<double> deviation_m() const;
  /// `now_s`: steady time. Fix, tracking or predicted, now, and within the limits.
  bool is_localized(double max_deviation_m, double max_age_s, double now_s) const;
  std::string_view state_name() const;
  /// The identifier of the map in use: the site's where it is that, else its name.
  std::string map_id() const;
  /// The fleet's version of the map in use; 0 if it is not the fleet's.
  std::uint64_t map_version() const;

  void note(const message::ParsedPose& newest, double now_s);
  /// A position in the map before is none in another.
  void note_map(const std::string& name, const std::string& hash);
  /// False if there is one with this id.
  bool add_action(ActionState action);
  /// Those that run stay.
  void clear_actions();
  void set_action(std::string_view id, ActionStatus status, std::string result);
};

inline constexpr std::size_t kMaxActionStates = 32;

}  // namespace cornerd::mqtt
