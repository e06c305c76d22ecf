// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "message/parsed_line.hpp"

namespace cornerd::tool {

/// A scan of the lidar, and where the pose that came with it says that it was taken.
struct ReceivedScan {
  message::RecordedScan scan;
  std::optional<core::Pose2> T_map_base;
};

/// What is known of the daemon: everything it said, as far as it still matters. Times are a clock's
/// that never steps; whoever feeds it brings them along.
class MonitorState {
 public:
  /// `reason`: why there is no connection, for a person.
  void lose(std::string_view reason, core::TimeNs now_ns);
  void connect(core::TimeNs now_ns);
  /// One line without its end.
  void take_line(std::string_view line, core::TimeNs now_ns);

  bool is_connected() const { return connected_; }
  const std::string& reason() const { return reason_; }
  /// Since the connection came or went.
  double connection_age_s(core::TimeNs now_ns) const;
  /// Since the daemon last said anything, or since the connection.
  double silence_s(core::TimeNs now_ns) const;

  const std::string& version() const { return version_; }
  const std::optional<message::ParsedPose>& pose() const { return pose_; }
  const std::optional<message::ParsedStatus>& status() const { return status_; }
  const std::optional<ReceivedScan>& scan() const { return scan_; }
  /// Of the same scan.
  const message::ParsedBreakpoints& breakpoints() const { return breakpoints_; }
  /// The newest first.
  const std::deque<message::ParsedEvent>& events() const { return events_; }
  /// What the daemon could not make sense of, or we not of it; empty: nothing.
  const std::string& protocol_error() const { return protocol_error_; }

  /// Since the last pose came; 0 where there is none.
  double pose_silence_s(core::TimeNs now_ns) const;
  /// No pose has come for so long that the last one is no longer where the robot is.
  bool is_pose_stale(core::TimeNs now_ns) const;
  /// Poses a second, of the last few; nullopt where too few came, or none of late.
  std::optional<double> pose_rate_hz(core::TimeNs now_ns) const;
  /// How many of the last (at most 100) poses were of a state, and how many there were.
  std::size_t recent(core::PoseState state) const;
  std::size_t recent() const { return states_.size(); }

 private:
  void note(message::ParsedPose pose, core::TimeNs now_ns);

  bool connected_ = false;
  std::string reason_;
  std::optional<core::TimeNs> changed_ns_;
  core::TimeNs last_line_ns_ = 0;
  std::string version_;
  std::optional<message::ParsedPose> pose_;
  std::optional<message::ParsedStatus> status_;
  std::optional<ReceivedScan> scan_;
  message::ParsedBreakpoints breakpoints_;
  std::deque<message::ParsedEvent> events_;
  std::deque<core::TimeNs> arrivals_;
  std::deque<core::PoseState> states_;
  std::string protocol_error_;
};

}  // namespace cornerd::tool
