// SPDX-License-Identifier: MIT
#include "tool/monitor/advice.hpp"

#include <cmath>
#include <optional>

#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

using core::PoseState;

/// STATUS comes every second.
constexpr double kMaxSilence_s = 3.5;
/// Line noise damages fewer bytes than this.
constexpr double kMaxSkippedShare = 0.01;
/// A smaller share of fixes is worth a warning.
constexpr double kMinFixShare = 0.8;
constexpr std::size_t kMinScans = 20;

std::string seconds_text(double seconds) { return formatted("%.0f s", std::floor(seconds)); }

std::optional<Advice> advise_on_connection(const MonitorState& state, core::TimeNs now_ns) {
  if (!state.is_connected()) {
    return Advice{
        Style::kBad,
        "no daemon since " + seconds_text(state.connection_age_s(now_ns)) + ": " + state.reason(),
        "start it: sudo systemctl start cornerd; why it ended: journalctl -u cornerd"};
  }
  if (const double silence_s = state.silence_s(now_ns); silence_s > kMaxSilence_s) {
    return Advice{Style::kBad, "no message from the daemon for " + seconds_text(silence_s),
                  "restart it: sudo systemctl restart cornerd; cornerctl doctor finds the cause"};
  }
  if (!state.status()) return Advice{Style::kDim, "waiting for the daemon's first message", ""};
  return std::nullopt;
}

std::optional<Advice> advise_on_lidar(const message::ParsedStatus& status) {
  if (status.lidar_state == "running" && status.lidar_fault.empty()) return std::nullopt;
  const bool is_coming = status.lidar_fault.empty() &&
                         (status.lidar_state == "identifying" || status.lidar_state == "starting" ||
                          status.lidar_state == "opening");
  return Advice{
      is_coming ? Style::kWarning : Style::kBad,
      "lidar " + status.lidar_state + (status.lidar_fault.empty() ? "" : ", " + status.lidar_fault),
      status.lidar_detail};
}

std::optional<Advice> advise_on_pose(const MonitorState& state, core::TimeNs now_ns) {
  if (!state.pose())
    return Advice{Style::kWarning, "the lidar runs, but no scan is complete yet", ""};
  const message::ParsedPose& pose = *state.pose();
  if (state.recent() > 1 && !state.pose_rate_hz(now_ns)) {
    return Advice{Style::kBad, "the lidar runs, but no scans come", "run cornerctl doctor"};
  }
  switch (pose.state) {
    case PoseState::kLost:
      return Advice{Style::kBad, "no pose in the map fits the scan",
                    "check the map, that the robot is inside it, lidar.mount, and that the walls "
                    "are not hidden; key l shows the scan"};
    case PoseState::kAmbiguous:
      return Advice{
          Style::kWarning, formatted("%zu poses fit the scan", pose.alternatives.size()),
          "move the robot, or send its pose (SET_POSE); cornerctl map check lists look-alike "
          "places"};
    case PoseState::kPredicted:
      return Advice{Style::kWarning, formatted("dead reckoned for %.1f s", pose.age_s.value_or(0)),
                    "check that the lidar is not covered and the robot is inside the map"};
    case PoseState::kFix:
    case PoseState::kTracking:
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Advice> advise_on_quality(const MonitorState& state) {
  const std::size_t named = state.recent(PoseState::kFix) + state.recent(PoseState::kTracking);
  const std::size_t scans = state.recent();
  if (scans >= kMinScans &&
      static_cast<double>(named) < kMinFixShare * static_cast<double>(scans)) {
    return Advice{Style::kWarning,
                  formatted("%zu of the last %zu scans gave no pose", scans - named, scans),
                  "unmapped obstacles hide the walls, or walls have moved"};
  }
  for (const message::ParsedStatus::Sensor& sensor : state.status()->odometry_sensors) {
    if (sensor.state == "running") continue;
    return Advice{Style::kWarning, "odometry: " + sensor.name + " is " + sensor.state,
                  sensor.detail};
  }
  if (const std::string& hint = state.status()->odometry_hint; !hint.empty()) {
    return Advice{Style::kWarning, "odometry: " + hint, "cornerctl doctor shows more"};
  }
  const auto bytes = static_cast<double>(state.status()->counter("bytes"));
  const auto skipped = static_cast<double>(state.status()->counter("skipped_bytes"));
  if (skipped > kMaxSkippedShare * bytes) {
    return Advice{Style::kWarning,
                  formatted("%.1f %% of the lidar's bytes were damaged", 100 * skipped / bytes),
                  "use a shorter or shielded cable, away from motors, and a stable 5 V supply"};
  }
  if (!state.protocol_error().empty()) {
    return Advice{Style::kWarning, state.protocol_error(),
                  "check that cornerd and cornerctl have the same version"};
  }
  return std::nullopt;
}

}  // namespace

Advice advise(const MonitorState& state, core::TimeNs now_ns) {
  std::optional<Advice> advice = advise_on_connection(state, now_ns);
  if (!advice) advice = advise_on_lidar(*state.status());
  if (!advice) advice = advise_on_pose(state, now_ns);
  if (!advice) advice = advise_on_quality(state);
  return advice.value_or(Advice{Style::kGood, "all is well", ""});
}

}  // namespace cornerd::tool
