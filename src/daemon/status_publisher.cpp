// SPDX-License-Identifier: MIT
#include "daemon/status_publisher.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "drivers/counter_names.hpp"
#include "message/state_names.hpp"

namespace cornerd::daemon {
namespace {

using drivers::LidarState;
using message::MessageClass;
using Counter = message::StatusFields::Counter;

/// In the order of core::PoseState.
constexpr std::array<std::string_view, TurnPublisher::kStates> kPoseCounterNames = {
    "poses_fix", "poses_tracking", "poses_predicted", "poses_ambiguous", "poses_lost"};

/// A driver has fewer different things to say.
constexpr std::size_t kMostWords = 64;

bool is_trouble(LidarState state) {
  return state == LidarState::kAbsent || state == LidarState::kFaulty ||
         state == LidarState::kBackoff;
}

std::string describe(const drivers::LidarStatus& lidar) {
  std::string text(drivers::to_string(lidar.state));
  if (!lidar.detail.view().empty()) text.append(": ").append(lidar.detail.view());
  return text;
}

}  // namespace

StatusPublisher::StatusPublisher(MessageServer& server, Notifier& notifier)
    : server_(server), notifier_(notifier) {}

bool StatusPublisher::notice_change(const drivers::LidarStatus& lidar, core::TimeNs t_ns) {
  const std::string text = describe(lidar);
  if (text == text_) return false;
  text_ = text;
  log_once(lidar.state, text);
  if (state_ == lidar.state) return true;
  if (lidar.state == LidarState::kRunning) {
    server_.publish(MessageClass::kEvent, line_.event(t_ns, "device found", text));
  } else if (state_ == LidarState::kRunning) {
    server_.publish(MessageClass::kEvent, line_.event(t_ns, "device lost", text));
  }
  state_ = lidar.state;
  return true;
}

void StatusPublisher::log_once(drivers::LidarState state, const std::string& text) {
  if (state == LidarState::kRunning) said_.clear();
  if (said_.size() == kMostWords) said_.clear();
  if (!said_.insert(text).second) return;
  spdlog::log(is_trouble(state) ? spdlog::level::warn : spdlog::level::info, "lidar {}", text);
}

void StatusPublisher::publish(const drivers::LidarStatus& lidar, const TurnPublisher& turns,
                              const Localization& localization, core::TimeNs t_ns) {
  std::array<Counter, drivers::kCounterNames.size() + kPoseCounterNames.size() + 4> counters;
  auto next = counters.begin();
  for (const auto& [name, member] : drivers::kCounterNames) {
    *next++ = {name, lidar.counters.*member};
  }
  for (std::size_t i = 0; i < kPoseCounterNames.size(); ++i) {
    *next++ = {kPoseCounterNames[i], turns.poses()[i]};
  }
  *next++ = {"lost_samples", localization.lost_samples()};
  *next++ = {"lost_turns", localization.lost_reports()};
  *next++ = {"clients", server_.clients()};
  *next++ = {"dropped_messages", server_.dropped()};

  message::StatusFields status;
  status.t_ns = t_ns;
  status.lidar_state = drivers::to_string(lidar.state);
  status.lidar_detail = lidar.detail.view();
  status.lidar_model = lidar.model.view();
  status.lidar_firmware = lidar.firmware.view();
  status.lidar_health = lidar.health.view();
  status.lidar_mode = lidar.mode.view();
  status.rate_hz = lidar.rate_hz;
  status.samples_hz = lidar.samples_hz;
  status.counters = counters;
  status.odometry = &turns.odometry();
  const LatencyWindow& latencies = turns.latencies();
  status.latency = {latencies.percentile(0.5), latencies.percentile(0.95),
                    latencies.percentile(0.99), !latencies.empty()};
  server_.publish(MessageClass::kStatus, line_.status(status));

  std::string summary = "lidar " + describe(lidar);
  if (lidar.state == LidarState::kRunning && turns.state()) {
    summary.append("; pose ").append(message::to_string(*turns.state()));
  }
  notifier_.status(summary);
}

}  // namespace cornerd::daemon
