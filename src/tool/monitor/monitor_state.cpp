// SPDX-License-Identifier: MIT
#include "tool/monitor/monitor_state.hpp"

#include <algorithm>
#include <utility>

namespace cornerd::tool {

namespace {

constexpr std::size_t kMaxEvents = 50;
/// Three seconds of an A1.
constexpr std::size_t kMaxArrivals = 22;
constexpr std::size_t kMaxStates = 100;
/// Seven scans of an A1.
constexpr double kFreshPose_s = 1;
constexpr core::TimeNs kMaxPause_ns = 2 * core::kNsPerSecond;

template <typename Value>
void push_limited(std::deque<Value>& values, Value value, std::size_t most) {
  values.push_back(std::move(value));
  if (values.size() > most) values.pop_front();
}

}  // namespace

void MonitorState::lose(std::string_view reason, core::TimeNs now_ns) {
  if (connected_ || !changed_ns_) changed_ns_ = now_ns;
  connected_ = false;
  reason_ = reason;
  // The last messages are no longer valid.
  pose_.reset();
  status_.reset();
  scan_.reset();
  breakpoints_ = {};
  arrivals_.clear();
  states_.clear();
  protocol_error_.clear();
}

void MonitorState::connect(core::TimeNs now_ns) {
  connected_ = true;
  changed_ns_ = now_ns;
  last_line_ns_ = now_ns;
}

double MonitorState::connection_age_s(core::TimeNs now_ns) const {
  return core::to_seconds(now_ns - changed_ns_.value_or(now_ns));
}

double MonitorState::silence_s(core::TimeNs now_ns) const {
  return core::to_seconds(now_ns - last_line_ns_);
}

void MonitorState::note(message::ParsedPose pose, core::TimeNs now_ns) {
  push_limited(states_, pose.state, kMaxStates);
  push_limited(arrivals_, now_ns, kMaxArrivals);
  pose_ = std::move(pose);
}

void MonitorState::take_line(std::string_view line, core::TimeNs now_ns) {
  last_line_ns_ = now_ns;
  message::ParsedLine parsed = message::parse_line(line);
  if (const auto* error = std::get_if<message::RequestError>(&parsed)) {
    protocol_error_ = "invalid message: " + error->text;
  } else if (const auto* refused = std::get_if<message::ParsedError>(&parsed)) {
    protocol_error_ = refused->code + ": " + refused->text;
  } else if (auto* version = std::get_if<message::ParsedVersion>(&parsed)) {
    version_ = std::move(version->version);
  } else if (auto* pose = std::get_if<message::ParsedPose>(&parsed)) {
    note(std::move(*pose), now_ns);
  } else if (auto* scan = std::get_if<message::RecordedScan>(&parsed)) {
    // POSE comes first, then SCAN and BREAKPOINTS of the same scan.
    scan_ = {std::move(*scan), pose_ ? pose_->T_map_base : std::nullopt};
    breakpoints_ = {};
  } else if (auto* points = std::get_if<message::ParsedBreakpoints>(&parsed)) {
    breakpoints_ = std::move(*points);
  } else if (auto* status = std::get_if<message::ParsedStatus>(&parsed)) {
    status_ = std::move(*status);
  } else if (auto* event = std::get_if<message::ParsedEvent>(&parsed)) {
    events_.push_front(std::move(*event));
    if (events_.size() > kMaxEvents) events_.pop_back();
  }
}

double MonitorState::pose_silence_s(core::TimeNs now_ns) const {
  return pose_ && !arrivals_.empty() ? core::to_seconds(now_ns - arrivals_.back()) : 0;
}

bool MonitorState::is_pose_stale(core::TimeNs now_ns) const {
  return pose_silence_s(now_ns) > kFreshPose_s;
}

std::optional<double> MonitorState::pose_rate_hz(core::TimeNs now_ns) const {
  if (arrivals_.size() < 2 || arrivals_.back() <= arrivals_.front()) return std::nullopt;
  if (now_ns - arrivals_.back() > kMaxPause_ns) return std::nullopt;
  return static_cast<double>(arrivals_.size() - 1) /
         core::to_seconds(arrivals_.back() - arrivals_.front());
}

std::size_t MonitorState::recent(core::PoseState state) const {
  return static_cast<std::size_t>(std::count(states_.begin(), states_.end(), state));
}

}  // namespace cornerd::tool
