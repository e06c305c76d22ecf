// SPDX-License-Identifier: MIT
#include "calibration/motion_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cornerd::calibration {
namespace {

constexpr core::TimeNs kWindowLength_ns = core::kNsPerSecond;
/// Between two localized scans; more is a gap.
constexpr core::TimeNs kMaxStep_ns = core::kNsPerSecond;
/// More between two of them: the robot was carried, or one of the poses is wrong.
constexpr double kJump_m = 0.5;
constexpr double kJump_rad = core::radians(60);
/// Less is no motion.
constexpr double kMotion_m = 0.02;
constexpr double kMotion_rad = 0.05;
const core::TimeNs kLongestDelay_ns = core::from_seconds(std::ranges::max(kDelays_s));
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

void CountedMotion::extend(const core::OdometryIncrement& step) {
  left_m += step.left_m;
  right_m += step.right_m;
  gyro_rad += step.gyro_rad;
}

bool MotionWindow::has_motion() const {
  return lidar_m.norm() > kMotion_m || std::abs(rotation_rad) > kMotion_rad ||
         std::abs(counted[0].left_m) + std::abs(counted[0].right_m) > 2 * kMotion_m;
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
  poses_.push_back({t_ns, T_map_lidar, std::exchange(is_interrupted_, false)});
  advance();
}

void MotionWindows::advance() {
  while (!poses_.empty() && !steps_.empty() &&
         steps_.back().to_ns >= poses_.front().t_ns + kLongestDelay_ns) {
    extend_to(poses_.front());
    const core::TimeNs needed_ns = poses_.front().t_ns - kLongestDelay_ns;
    while (!steps_.empty() && steps_.front().to_ns <= needed_ns) steps_.pop_front();
    poses_.pop_front();
  }
}

void MotionWindows::extend_to(const Pose& pose) {
  if (!last_ || pose.is_first || pose.t_ns <= last_->t_ns ||
      pose.t_ns - last_->t_ns > kMaxStep_ns) {
    return begin_at(pose);
  }
  const core::Pose2 motion = last_->T_map_lidar.inverse() * pose.T_map_lidar;
  const bool jumps =
      motion.translation().norm() > kJump_m || std::abs(motion.theta_rad) > kJump_rad;
  if (jumps || !extend_by_odometry(last_->t_ns, pose.t_ns)) return begin_at(pose);
  window_.extend(motion);
  last_ = pose;
  if (pose.t_ns - begin_ns_ < kWindowLength_ns) return;
  if (window_.has_motion()) {
    if (windows_.size() == capacity_) windows_.pop_front();
    windows_.push_back(window_);
    ++count_;
  }
  begin_at(pose);
}

bool MotionWindows::extend_by_odometry(core::TimeNs from_ns, core::TimeNs to_ns) {
  for (std::size_t i = 0; i < kDelays_s.size(); ++i) {
    const core::TimeNs delay_ns = core::from_seconds(kDelays_s[i]);
    const core::TimeNs end_ns = to_ns + delay_ns;
    core::TimeNs reached_ns = from_ns + delay_ns;
    auto next = std::ranges::upper_bound(steps_, reached_ns, {}, &core::OdometryIncrement::to_ns);
    for (; reached_ns < end_ns; ++next) {
      if (next == steps_.end() || next->is_gap || next->from_ns > reached_ns) return false;
      core::OdometryIncrement step = *next;
      if (step.from_ns < reached_ns) step.split(reached_ns);
      if (step.to_ns > end_ns) step = step.split(end_ns);
      window_.counted[i].extend(step);
      window_.has_gyro = window_.has_gyro && step.has_gyro;
      window_.gyro_is_stuck = window_.gyro_is_stuck || (!step.has_gyro && step.gyro_may_be_stuck);
      reached_ns = step.to_ns;
    }
  }
  window_.duration_s += core::to_seconds(to_ns - from_ns);
  return true;
}

void MotionWindows::begin_at(const Pose& pose) {
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
