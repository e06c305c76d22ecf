// SPDX-License-Identifier: MIT
#include "calibration/motion_window.hpp"

#include <cmath>
#include <limits>

namespace cornerd::calibration {
namespace {

constexpr core::TimeNs kWindowLength_ns = core::kNsPerSecond;
/// Between two localized scans; more is a gap.
constexpr core::TimeNs kMaxStep_ns = core::kNsPerSecond;
/// Less is no motion.
constexpr double kMotion_m = 0.02;
constexpr double kMotion_rad = 0.05;
/// Two seconds at 500 readings a second, and of scans.
constexpr std::size_t kMaxSteps = 1024;
constexpr std::size_t kMaxPoses = 64;

}  // namespace

void MotionWindow::extend(const core::Pose2& T_from_to) {
  const double half_rad = T_from_to.theta_rad / 2;
  const double c = std::cos(half_rad);
  const double s = std::sin(half_rad);
  lidar_m +=
      core::Vec2(c * T_from_to.x_m + s * T_from_to.y_m, c * T_from_to.y_m - s * T_from_to.x_m);
  sine += 2 * s;
  rotation_rad += T_from_to.theta_rad;
}

void MotionWindow::extend(const core::OdometryIncrement& step) {
  left_m += step.left_m;
  right_m += step.right_m;
  gyro_rad += step.gyro_rad;
  has_gyro = has_gyro && step.has_gyro;
  duration_s += step.duration_s();
}

bool MotionWindow::has_motion() const {
  return lidar_m.norm() > kMotion_m || std::abs(rotation_rad) > kMotion_rad ||
         std::abs(left_m) + std::abs(right_m) > 2 * kMotion_m;
}

void MotionWindows::add(const core::OdometryIncrement& step) {
  // A clock that was set back: nothing fits together any more.
  if (step.to_ns <= step.from_ns || (!steps_.empty() && step.from_ns < steps_.back().to_ns)) {
    steps_.clear();
    last_.reset();
    if (step.to_ns <= step.from_ns) return;
  }
  if (steps_.size() == kMaxSteps) steps_.pop_front();
  steps_.push_back(step);
  advance();
}

void MotionWindows::add(core::TimeNs t_ns, const core::Pose2& T_map_lidar) {
  if (!poses_.empty() && t_ns <= poses_.back().t_ns) poses_.clear();
  if (poses_.size() == kMaxPoses) poses_.pop_front();
  poses_.push_back({t_ns, T_map_lidar});
  advance();
}

void MotionWindows::advance() {
  while (!poses_.empty() && !steps_.empty() && steps_.back().to_ns >= poses_.front().t_ns) {
    extend_to(poses_.front());
    poses_.pop_front();
  }
}

void MotionWindows::extend_to(const Pose& pose) {
  if (!last_ || pose.t_ns <= last_->t_ns || pose.t_ns - last_->t_ns > kMaxStep_ns) {
    return begin_at(pose);
  }
  core::TimeNs reached_ns = last_->t_ns;
  while (reached_ns < pose.t_ns && !steps_.empty()) {
    core::OdometryIncrement& step = steps_.front();
    if (step.is_gap || step.from_ns > reached_ns) return begin_at(pose);
    if (step.to_ns > pose.t_ns) {
      window_.extend(step.split(pose.t_ns));
      reached_ns = pose.t_ns;
      break;
    }
    window_.extend(step);
    reached_ns = step.to_ns;
    steps_.pop_front();
  }
  if (reached_ns < pose.t_ns) return begin_at(pose);
  window_.extend(last_->T_map_lidar.inverse() * pose.T_map_lidar);
  last_ = pose;
  if (pose.t_ns - begin_ns_ < kWindowLength_ns) return;
  if (window_.has_motion()) {
    if (windows_.size() == capacity_) windows_.pop_front();
    windows_.push_back(window_);
    ++count_;
  }
  begin_at(pose);
}

void MotionWindows::begin_at(const Pose& pose) {
  while (!steps_.empty() && steps_.front().to_ns <= pose.t_ns) steps_.pop_front();
  if (!steps_.empty() && steps_.front().from_ns < pose.t_ns) steps_.front().split(pose.t_ns);
  window_ = {};
  begin_ns_ = pose.t_ns;
  last_ = pose;
}

std::vector<MotionWindow> motion_windows(std::span<const core::OdometryIncrement> steps,
                                         std::span<const KnownPose> places,
                                         const core::Pose2& T_base_lidar) {
  MotionWindows cut(std::numeric_limits<std::size_t>::max());
  std::size_t next = 0;
  for (const core::OdometryIncrement& step : steps) {
    for (; next < places.size() && places[next].t_ns <= step.to_ns; ++next) {
      cut.add(places[next].t_ns, places[next].T_map_base * T_base_lidar);
    }
    cut.add(step);
  }
  return {cut.windows().begin(), cut.windows().end()};
}

}  // namespace cornerd::calibration
