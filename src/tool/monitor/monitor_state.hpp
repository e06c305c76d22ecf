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

/// A scan and the pose at which it was taken.
struct ReceivedScan {
  message::RecordedScan scan;
  std::optional<core::Pose2> T_map_base;
};

/// The state of the daemon from its messages. The caller passes the time of a monotonic clock.
class MonitorState {
 public:
  /// `reason`: why there is no connection, for the user.
  void lose(std::string_view reason, core::TimeNs now_ns);
  void connect(core::TimeNs now_ns);
  /// One line without its end.
  void take_line(std::string_view line, core::TimeNs now_ns);

  bool is_connected() const { return connected_; }
  const std::string& reason() const { return reason_; }
  /// Since the connection came or went.
  double connection_age_s(core::TimeNs now_ns) const;
  /// Since the last message, or since the connection.
  double silence_s(core::TimeNs now_ns) const;

  const std::string& version() const { return version_; }
  const std::optional<message::ParsedPose>& pose() const { return pose_; }
  const std::optional<message::ParsedStatus>& status() const { return status_; }
  const std::optional<ReceivedScan>& scan() const { return scan_; }
  /// Of the same scan.
  const message::ParsedBreakpoints& breakpoints() const { return breakpoints_; }
  /// The newest first.
  const std::deque<message::ParsedEvent>& events() const { return events_; }
  /// The last message that the daemon rejected or that could not be parsed; empty: none.
  const std::string& protocol_error() const { return protocol_error_; }

  /// Since the last pose; 0 if there is none.
  double pose_silence_s(core::TimeNs now_ns) const;
  /// True if the last pose is older than 1 s.
  bool is_pose_stale(core::TimeNs now_ns) const;
  /// Rate of the last poses; nullopt if too few came, or none recently.
  std::optional<double> pose_rate_hz(core::TimeNs now_ns) const;
  /// The number of poses with this state among the last 100, and the number of these poses.
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
