// SPDX-License-Identifier: MIT
#include "tool/map/drive_points.hpp"

#include <cmath>
#include <cstdint>
#include <unordered_set>
#include <utility>

namespace cornerd::tool {

namespace {

/// No interpolation between scans that are further apart.
constexpr core::TimeNs kMaxNeighbourInterval_ns = core::kNsPerSecond / 2;

core::Vec2 return_of(const core::Sample& sample) {
  return core::unit_vector(sample.bearing_rad) * double{sample.range_m};
}

}  // namespace

void DrivePoints::add(const core::Scan& scan, const std::optional<core::Pose2>& T_map_base) {
  RecordedScan kept;
  kept.T_map_base = T_map_base;
  const auto samples = scan.samples();
  if (!samples.empty()) {
    kept.middle_ns = samples.front().t_ns + (samples.back().t_ns - samples.front().t_ns) / 2;
  }
  for (const core::Sample& sample : samples) {
    if (sample.range_m > 0) kept.returns.push_back(sample);
  }
  scans_.push_back(std::move(kept));
}

core::Pose2 DrivePoints::pose_at(std::size_t scan, core::TimeNs t_ns) const {
  const RecordedScan& own = scans_[scan];
  const bool before = t_ns < own.middle_ns;
  if (before ? scan == 0 : scan + 1 == scans_.size()) return *own.T_map_base;
  const RecordedScan& other = scans_[before ? scan - 1 : scan + 1];
  const core::TimeNs apart_ns = std::abs(other.middle_ns - own.middle_ns);
  if (!other.T_map_base || apart_ns == 0 || apart_ns > kMaxNeighbourInterval_ns)
    return *own.T_map_base;
  const double share =
      static_cast<double>(std::abs(t_ns - own.middle_ns)) / static_cast<double>(apart_ns);
  return interpolate(*own.T_map_base, *other.T_map_base, share);
}

std::vector<core::Vec2> DrivePoints::place(const core::Pose2& T_base_lidar) const {
  std::vector<core::Vec2> points;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    if (!scans_[i].T_map_base) continue;
    for (const core::Sample& sample : scans_[i].returns) {
      points.push_back(pose_at(i, sample.t_ns) * (T_base_lidar * return_of(sample)));
    }
  }
  return points;
}

std::vector<core::Vec2> DrivePoints::place(const core::Pose2& T_base_lidar,
                                           const Truth& trajectory) const {
  std::vector<core::Vec2> points;
  for (const RecordedScan& scan : scans_) {
    for (const core::Sample& sample : scan.returns) {
      const auto T_map_base = trajectory.at(sample.t_ns);
      if (T_map_base) points.push_back(*T_map_base * (T_base_lidar * return_of(sample)));
    }
  }
  return points;
}

std::vector<core::Vec2> thin_out(const std::vector<core::Vec2>& points, double cell_m,
                                 const core::Vec2& low, const core::Vec2& high) {
  std::unordered_set<std::uint64_t> taken;
  std::vector<core::Vec2> kept;
  for (const core::Vec2& point : points) {
    if ((point - low).minCoeff() < 0 || (high - point).minCoeff() < 0) continue;
    const core::Vec2 cell = (point - low) / cell_m;
    const auto key =
        static_cast<std::uint64_t>(cell.x()) << 32 | static_cast<std::uint64_t>(cell.y());
    if (taken.insert(key).second) kept.push_back(point);
  }
  return kept;
}

}  // namespace cornerd::tool
