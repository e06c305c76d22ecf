// SPDX-License-Identifier: MIT
#include "daemon/pose_log.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "core/geometry/angle.hpp"
#include "message/line_writer.hpp"

namespace cornerd::daemon {
namespace {

std::string text_of(const core::Pose2& T_map_base) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "x %.3f m, y %.3f m, theta %.1f degrees", T_map_base.x_m,
                T_map_base.y_m, core::degrees(T_map_base.theta_rad));
  return text.data();
}

}  // namespace

std::optional<std::string> PoseLog::add(const core::PoseEstimate& pose, core::TimeNs t_ns) {
  if (core::has_pose(pose.state)) {
    const auto lost_since_ns = std::exchange(since_ns_, std::nullopt);
    const bool was_lost = std::exchange(said_lost_, false);
    if (!std::exchange(had_fix_, true)) return "first fix: " + text_of(pose.T_map_base);
    if (!was_lost) return std::nullopt;
    std::array<char, 32> duration{};
    std::snprintf(duration.data(), duration.size(), "%.0f s",
                  core::to_seconds(t_ns - *lost_since_ns));
    return "found again after " + std::string(duration.data()) + ": " + text_of(pose.T_map_base);
  }
  // The time of a recording starts again with each of its rounds.
  since_ns_ = std::min(since_ns_.value_or(t_ns), t_ns);
  if (said_lost_ || t_ns - *since_ns_ < kLoss_ns) return std::nullopt;
  said_lost_ = true;
  return "lost for 10 s: no scan gives a pose (" + std::string(message::to_string(pose.state)) +
         ")";
}

}  // namespace cornerd::daemon
