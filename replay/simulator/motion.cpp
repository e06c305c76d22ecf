// SPDX-License-Identifier: MIT
#include "replay/simulator/motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace cornerd::replay {
namespace {

/// Trapezoidal speed profile over a length or angle.
class Profile {
 public:
  Profile() = default;
  /// `acceleration` 0: unlimited.
  Profile(double length, double rate, double acceleration) : length_(length), rate_(rate) {
    if (acceleration > 0) {
      rate_ = std::min(rate, std::sqrt(length * acceleration));
      ramp_s_ = rate_ / acceleration;
    }
    duration_s_ = length / rate_ + ramp_s_;
  }
  double duration_s() const { return duration_s_; }
  /// Share of the length covered, in [0, 1].
  double share(double t_s) const {
    t_s = std::clamp(t_s, 0.0, duration_s_);
    const double left_s = duration_s_ - t_s;
    if (t_s < ramp_s_) return rate_ * t_s * t_s / (2 * ramp_s_) / length_;
    if (left_s < ramp_s_) return 1 - rate_ * left_s * left_s / (2 * ramp_s_) / length_;
    return rate_ * (t_s - ramp_s_ / 2) / length_;
  }

 private:
  double length_ = 1;
  double rate_ = 1;
  double ramp_s_ = 0;
  double duration_s_ = 0;
};

/// A straight line, or a rotation on the spot.
struct Leg {
  double start_s = 0;
  core::Pose2 from;
  core::Vec2 translation_m = core::Vec2::Zero();
  double rotation_rad = 0;
  Profile profile;
};

class Drive {
 public:
  Drive(const std::vector<core::Vec2>& points, const DriveConfig& config) : config_(config) {
    std::vector<core::Vec2> stops;
    for (const core::Vec2& point : points) {
      if (stops.empty() || point != stops.back()) stops.push_back(point);
    }
    if (config.loop && stops.size() > 1 && stops.front() == stops.back()) stops.pop_back();
    if (stops.size() < 2) throw std::invalid_argument("path: needs at least two different points");
    if (!(config.speed_m_s > 0) || !(config.yaw_rate_rad_s > 0)) {
      throw std::invalid_argument("drive: speed and yaw rate must be positive");
    }
    if (!(config.acceleration_m_s2 >= 0) || !(config.yaw_acceleration_rad_s2 >= 0)) {
      throw std::invalid_argument("drive: accelerations must not be negative");
    }
    end_ = {stops[0].x(), stops[0].y(), heading(stops[0], stops[1])};
    const double first_heading_rad = end_.theta_rad;
    for (std::size_t i = 1; i < stops.size(); ++i) go_to(stops[i]);
    if (config.loop) {
      go_to(stops[0]);
      rotate_to(first_heading_rad);
    }
  }

  double duration_s() const { return length_s_; }

  core::Pose2 pose_at(double t_s) const {
    if (config_.loop) t_s = std::fmod(t_s, length_s_);
    const auto after = std::upper_bound(legs_.begin(), legs_.end(), t_s,
                                        [](double t, const Leg& leg) { return t < leg.start_s; });
    const Leg& leg = after == legs_.begin() ? legs_.front() : *(after - 1);
    const double share = leg.profile.share(t_s - leg.start_s);
    return {leg.from.x_m + leg.translation_m.x() * share,
            leg.from.y_m + leg.translation_m.y() * share,
            core::normalize_angle(leg.from.theta_rad + leg.rotation_rad * share)};
  }

 private:
  static double heading(const core::Vec2& from, const core::Vec2& to) {
    return std::atan2(to.y() - from.y(), to.x() - from.x());
  }

  void rotate_to(double heading_rad) {
    const double rotation_rad = core::angle_between(end_.theta_rad, heading_rad);
    if (rotation_rad == 0) return;
    const Profile profile(std::abs(rotation_rad), config_.yaw_rate_rad_s,
                          config_.yaw_acceleration_rad_s2);
    legs_.push_back({length_s_, end_, core::Vec2::Zero(), rotation_rad, profile});
    end_.theta_rad = heading_rad;
    length_s_ += profile.duration_s();
  }

  void go_to(const core::Vec2& point) {
    rotate_to(heading(end_.translation(), point));
    const core::Vec2 translation = point - end_.translation();
    const Profile profile(translation.norm(), config_.speed_m_s, config_.acceleration_m_s2);
    legs_.push_back({length_s_, end_, translation, 0, profile});
    end_ = {point.x(), point.y(), end_.theta_rad};
    length_s_ += profile.duration_s();
  }

  DriveConfig config_;
  std::vector<Leg> legs_;
  core::Pose2 end_;
  double length_s_ = 0;
};

}  // namespace

Motion stand_still(const core::Pose2& T_map_base) {
  return [T_map_base](core::TimeNs, std::int64_t) { return T_map_base; };
}

Motion visit_poses(std::vector<core::Pose2> poses, std::int64_t scans_each) {
  if (poses.empty()) throw std::invalid_argument("visit_poses: needs at least one pose");
  if (scans_each < 1) throw std::invalid_argument("visit_poses: needs at least one scan per pose");
  return [poses = std::move(poses), scans_each](core::TimeNs, std::int64_t scan) {
    const auto last = static_cast<std::int64_t>(poses.size()) - 1;
    const std::int64_t index = std::clamp<std::int64_t>(scan / scans_each, 0, last);
    return poses[static_cast<std::size_t>(index)];
  };
}

double drive_duration_s(const std::vector<core::Vec2>& points, const DriveConfig& config) {
  return Drive(points, config).duration_s();
}

Motion drive_path(const std::vector<core::Vec2>& points, const DriveConfig& config) {
  return [drive = Drive(points, config)](core::TimeNs t_ns, std::int64_t) {
    return drive.pose_at(core::to_seconds(t_ns));
  };
}

std::span<const Scenario> scenarios() {
  static const std::vector<Scenario> kScenarios = {
      {"circuit-1", {{1.65, 2.7}, {1.0, 2.7}, {1.3, 0.8}, {3.3, 0.8}, {3.3, 2.4}}},
      {"circuit-2",
       {{1.65, 4.0},
        {1.65, 1.5},
        {5.75, 1.5},
        {5.75, 4.0},
        {8.85, 4.0},
        {8.85, 6.6},
        {7.4, 6.6},
        {7.4, 5.4},
        {8.85, 5.4},
        {8.85, 4.0}}},
      {"exploration", {{0.7, 4.0}, {1.65, 4.0}, {1.65, 2.6}, {1.2, 0.9},  {3.3, 0.9},  {3.3, 1.5},
                       {5.2, 1.5}, {5.9, 0.7},  {5.75, 2.6}, {5.75, 4.0}, {8.05, 4.0}, {8.05, 2.6},
                       {9.2, 1.0}, {7.8, 1.0},  {8.05, 2.6}, {8.05, 4.0}, {8.85, 4.0}, {8.85, 5.4},
                       {9.2, 7.2}, {7.2, 6.9},  {8.85, 5.4}, {8.85, 4.0}, {4.75, 4.0}, {4.75, 5.4},
                       {5.3, 7.2}, {4.3, 7.2},  {4.75, 5.4}, {4.75, 4.0}, {2.65, 4.0}, {2.65, 5.4},
                       {1.2, 5.6}, {1.2, 7.2},  {1.6, 6.6},  {2.65, 5.4}, {2.65, 4.0}}}};
  return kScenarios;
}

const Scenario* find_scenario(std::string_view name) {
  const auto all = scenarios();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Scenario& scenario) { return scenario.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace cornerd::replay
