// SPDX-License-Identifier: MIT
#include "baseline/line_tracking.hpp"

#include <cmath>

namespace cornerd::baseline {
namespace {

/// Step 1: two samples make a line.
constexpr std::size_t kLineSeed = 2;

double distance_m(const core::Line& line, const core::PolarPoint& point) {
  return std::abs(line.normal.dot(point.position()) - line.offset_m);
}

}  // namespace

std::size_t LineTracking::track(const core::PolarScan& scan, core::SegmentTracks& tracks) {
  tracks.clear();
  std::size_t dropped = 0;
  std::size_t index = 0;
  while (index + kLineSeed <= scan.size()) {
    core::SegmentTrack wall = core::SegmentTrack::starting_at(scan, index);
    wall.add(scan, index++, noise_);
    do {
      wall.add(scan, index++, noise_);
      wall.line = wall.fit.line();
    } while (index < scan.size() && distance_m(wall.line, scan[index]) <= max_distance_m_);
    if (wall.support >= min_support_ && !keep_wall(wall, tracks)) ++dropped;
  }
  return dropped;
}

}  // namespace cornerd::baseline
