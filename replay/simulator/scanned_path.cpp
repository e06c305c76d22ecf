// SPDX-License-Identifier: MIT
#include "replay/simulator/scanned_path.hpp"

#include <algorithm>
#include <stdexcept>

namespace cornerd::replay {
namespace {

constexpr std::int64_t kMaxScans = 100;
constexpr double kPointDistance_m = 0.02;

}  // namespace

ScannedPath scanned_path(const Motion& motion, const core::Pose2& T_base_lidar, std::int64_t scans,
                         double rate_hz) {
  if (scans < 1 || !(rate_hz > 0)) {
    throw std::invalid_argument("scanned path: needs at least one scan and a positive rate");
  }
  const auto at = [&](double scan, std::int64_t index) {
    return motion(core::from_seconds(scan / rate_hz), index);
  };
  ScannedPath path;
  const std::int64_t count = std::min(scans, kMaxScans);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t scan = (2 * i + 1) * scans / (2 * count);
    path.T_map_lidar.push_back(at(static_cast<double>(scan) + 0.5, scan) * T_base_lidar);
  }
  core::Pose2 last;
  for (std::int64_t scan = 0; scan <= scans; ++scan) {
    const auto start = static_cast<double>(scan);
    const core::Pose2 from = at(start, scan);
    const core::Pose2 to = at(start + 1, scan);
    // The lidar moves while the robot rotates in place.
    const double length_m =
        std::max((to.translation() - from.translation()).norm(),
                 ((to * T_base_lidar).translation() - (from * T_base_lidar).translation()).norm());
    const int steps = 1 + static_cast<int>(length_m / kPointDistance_m);
    for (int step = 0; step < steps; ++step) {
      const core::Pose2 pose = at(start + static_cast<double>(step) / steps, scan);
      if (!path.points.empty() && core::same_pose(last, pose, 1e-6, 1e-6)) continue;
      path.points.push_back(pose.translation());
      path.points.push_back((pose * T_base_lidar).translation());
      last = pose;
    }
  }
  return path;
}

}  // namespace cornerd::replay
