// SPDX-License-Identifier: MIT
#include "calibration/drive_window.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace cornerd::calibration {
namespace {

constexpr core::TimeNs kWindow_ns = core::kNsPerSecond;
/// Longer windows, where scans are missing, are left out.
constexpr core::TimeNs kLongestWindow_ns = 3 * core::kNsPerSecond;

void extend(DriveWindow& window, const core::Pose2& from, const core::Pose2& to) {
  const double rotation_rad = core::angle_between(from.theta_rad, to.theta_rad);
  const core::Pose2 motion = from.inverse() * to;
  window.rotation_rad += rotation_rad;
  window.distance_m +=
      motion.x_m * std::cos(rotation_rad / 2) + motion.y_m * std::sin(rotation_rad / 2);
}

}  // namespace

std::vector<core::OdometryIncrement> at_true_times(std::span<const core::OdometryIncrement> steps,
                                                   double delay_s) {
  std::vector<core::OdometryIncrement> moved(steps.begin(), steps.end());
  const core::TimeNs delay_ns = core::from_seconds(delay_s);
  for (core::OdometryIncrement& step : moved) {
    step.from_ns -= delay_ns;
    step.to_ns -= delay_ns;
  }
  return moved;
}

std::vector<DriveWindow> cut_windows(std::span<const core::OdometryIncrement> steps,
                                     std::span<const KnownPose> places) {
  std::vector<DriveWindow> windows;
  std::size_t first = 0;
  for (std::size_t i = 0; i < places.size();) {
    DriveWindow window;
    std::size_t j = i + 1;
    for (; j < places.size(); ++j) {
      extend(window, places[j - 1].T_map_base, places[j].T_map_base);
      if (places[j].t_ns - places[i].t_ns >= kWindow_ns) break;
    }
    if (j == places.size()) break;
    const core::TimeNs from_ns = places[i].t_ns;
    const core::TimeNs to_ns = places[j].t_ns;
    window.motion = places[i].T_map_base.inverse() * places[j].T_map_base;
    while (first < steps.size() && steps[first].to_ns <= from_ns) ++first;
    bool whole = first < steps.size() && steps[first].from_ns <= from_ns;
    core::TimeNs reached_ns = from_ns;
    for (std::size_t k = first; k < steps.size() && steps[k].from_ns < to_ns; ++k) {
      core::OdometryIncrement step = steps[k];
      if (step.from_ns < from_ns) step.split(from_ns);
      if (step.to_ns > to_ns) step = step.split(to_ns);
      whole = whole && !step.is_gap && step.from_ns == reached_ns;
      reached_ns = step.to_ns;
      window.steps.push_back(step);
    }
    whole = whole && reached_ns == to_ns && to_ns - from_ns <= kLongestWindow_ns;
    if (whole) windows.push_back(std::move(window));
    i = j;
  }
  return windows;
}

}  // namespace cornerd::calibration
