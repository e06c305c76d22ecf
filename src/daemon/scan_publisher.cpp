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

ScanPublisher::ScanPublisher(MessageServer& server, PublishedMap map)
    : server_(server), map_(std::move(map)) {
  if (map_.line) server_.publish(MessageClass::kMap, map_.line);
}

void ScanPublisher::set_next_map(std::uint32_t generation, PublishedMap map) {
  next_maps_.push_back({generation, std::move(map)});
}

void ScanPublisher::publish_next_map() {
  if (next_maps_.empty()) return;
  if (const Line line = std::exchange(next_maps_.back().map.line, nullptr)) {
    server_.publish(MessageClass::kMap, line);
  }
}

void ScanPublisher::take_next_maps(std::uint32_t generation) {
  bool is_new = false;
  for (; !next_maps_.empty() && next_maps_.front().generation <= generation; is_new = true) {
    map_ = std::move(next_maps_.front().map);
    next_maps_.pop_front();
  }
  if (!is_new) return;
  recent_lost_.reset();
  last_fix_.reset();  // poses in two maps cannot be compared
  if (map_.line) server_.publish(MessageClass::kMap, map_.line);
}

void ScanPublisher::publish(const ScanReport& report) {
  const core::PoseEstimate& pose = report.result.pose;
  take_next_maps(report.generation);
  latencies_.add(core::to_seconds(report.latency_ns));
  ++poses_[static_cast<std::size_t>(pose.state)];
  recent_lost_ <<= 1;
  recent_lost_[0] = pose.state == core::PoseState::kLost;
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
                  line_.pose(pose, map_.map ? &map_.map->plan() : nullptr, map_.has_name));
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
