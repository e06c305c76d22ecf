// SPDX-License-Identifier: MIT
#include "daemon/scan_publisher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/geometry/angle.hpp"
#include "daemon/posix_clock.hpp"
#include "message/line_writer.hpp"

namespace cornerd::daemon {

using message::MessageClass;

namespace {

/// More than a robot moves between two scans: it was carried, or one of the two poses is wrong.
constexpr double kJump_m = 0.5;
constexpr double kJump_rad = core::radians(60);
/// Upper limit of the rotation after missing scans.
constexpr double kMaxJump_rad = core::radians(179);

}  // namespace

ScanPublisher::ScanPublisher(MessageServer& server, PublishedMaps maps)
    : server_(server), maps_(std::move(maps)) {
  if (maps_.maps.size() == 1) use_map(0, 0);
}

void ScanPublisher::set_next_maps(std::uint32_t generation, PublishedMaps maps) {
  next_maps_.push_back({generation, std::move(maps)});
}

void ScanPublisher::publish_next_map() {
  if (next_maps_.empty() || next_maps_.back().maps.maps.size() > 1) return;
  if (const Line line = std::exchange(next_maps_.back().maps.maps.front().line, nullptr)) {
    server_.publish(MessageClass::kMap, line);
  }
}

void ScanPublisher::take_next_maps(std::uint32_t generation) {
  for (; !next_maps_.empty() && next_maps_.front().generation <= generation;
       next_maps_.pop_front()) {
    maps_ = std::move(next_maps_.front().maps);
    map_.reset();
    recent_ = {};
  }
}

void ScanPublisher::use_map(std::optional<std::size_t> map, core::TimeNs t_ns) {
  if (map == map_) return;
  map_ = map;
  recent_ = {};
  last_fix_.reset();  // poses in two maps cannot be compared
  if (!map) return;
  const LoadedMap& used = maps_.maps[*map];
  if (used.line) server_.publish(MessageClass::kMap, used.line);
  if (maps_.maps.size() == 1) return;
  const std::string text = describe(*used.map);
  log(LogLevel::kInfo, "map chosen by the scans: " + text);
  server_.publish(MessageClass::kEvent, line_.event(t_ns, "map chosen", text));
}

std::optional<message::StatusFields::Map> ScanPublisher::choice() const {
  if (maps_.names.empty()) return std::nullopt;
  if (map_) return {{"known", map()->plan().name, {}}};
  return {{candidates_.empty() ? "unknown" : "ambiguous", {}, candidates_}};
}

void ScanPublisher::publish(const ScanReport& report) {
  const core::PoseEstimate& pose = report.result.pose;
  take_next_maps(report.generation);
  use_map(report.map, pose.t_ns);
  candidates_.clear();
  if (!map_) {
    for (const core::Alternative& other : pose.alternatives) {
      candidates_.push_back(maps_.names[other.map]);
    }
  }
  latencies_.add(core::to_seconds(report.latency_ns));
  ++poses_[static_cast<std::size_t>(pose.state)];
  recent_.add(report.result, report.scan, maps_.limits, map());
  odometry_ = report.result.odometry;
  bias_ = report.result.bias;
  lidar_ = report.lidar;
  end_ns_ = report.scan.end_ns();

  publish_pose(pose);
  if (server_.is_watched(MessageClass::kScan)) {
    server_.publish(MessageClass::kScan, line_.scan(report.scan));
  }
  if (server_.is_watched(MessageClass::kBreakpoints)) {
    server_.publish(MessageClass::kBreakpoints,
                    line_.breakpoints(report.scan.start_ns(), report.result.detection));
  }
  if (pose.state != state_) publish_change(pose.state, pose.t_ns);
  if (const auto line = pose_log_.add(pose, pose.t_ns - report.to_unix_ns)) {
    log(LogLevel::kInfo, *line);
  }
  publish_jump(pose, report.number);
  jumps_.flush(monotonic_ns());
}

void ScanPublisher::publish_jump(const core::PoseEstimate& pose, std::uint64_t number) {
  if (!core::has_pose(pose.state)) return;
  if (last_fix_) {
    const auto scans = static_cast<double>(number - last_fix_->number);
    const double translation_m =
        (pose.T_map_base.translation() - last_fix_->T_map_base.translation()).norm();
    const double rotated_rad =
        std::abs(core::angle_between(last_fix_->T_map_base.theta_rad, pose.T_map_base.theta_rad));
    if (translation_m > kJump_m * scans ||
        rotated_rad > std::min(kJump_rad * scans, kMaxJump_rad)) {
      std::array<char, 64> text{};
      std::snprintf(text.data(), text.size(), "%.3f m, %.1f degrees", translation_m,
                    core::degrees(rotated_rad));
      jumps_.add(text.data(), monotonic_ns());
      server_.publish(MessageClass::kEvent, line_.event(pose.t_ns, "jump", text.data()));
    }
  }
  last_fix_ = {number, pose.T_map_base};
}

void ScanPublisher::publish(const core::PoseEstimate& pose) { publish_pose(pose); }

void ScanPublisher::publish(core::OdometryReading reading, core::TimeNs to_unix_ns) {
  if (!server_.is_watched(MessageClass::kOdometry)) return;
  reading.t_ns += to_unix_ns;
  server_.publish(MessageClass::kOdometry, line_.odometry(reading));
}

void ScanPublisher::publish_odometry(Localization& localization) {
  const bool is_watched = server_.is_watched(MessageClass::kOdom);
  localization.hurry_odometry(is_watched || server_.is_watched(MessageClass::kOdometry));
  std::optional<core::OdometryPose> newest;
  localization.take_odometry_poses([&](const core::OdometryPose& pose) {
    if (is_watched) return server_.publish(MessageClass::kOdom, line_.odom(pose));
    newest = pose;
  });
  if (newest) server_.publish(MessageClass::kOdom, line_.odom(*newest));
}

void ScanPublisher::publish_pose(const core::PoseEstimate& pose) {
  server_.publish(MessageClass::kPose,
                  line_.pose(pose, map() ? &map()->plan() : nullptr, maps_.names));
}

void ScanPublisher::publish_change(core::PoseState to, core::TimeNs t_ns) {
  using message::to_string;
  std::string change(state_ ? to_string(*state_) : "none");
  change.append(" -> ").append(to_string(to));
  log(LogLevel::kDebug, "pose " + change);
  server_.publish(MessageClass::kEvent, line_.event(t_ns, "state change", change));
  state_ = to;
}

}  // namespace cornerd::daemon
