// SPDX-License-Identifier: MIT
// The result of every corner detector.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace cornerd::core {

/// Corner: two visible walls meet. Terminal (the paper's term): the end of a wall in front of
/// something farther.
enum class BreakpointKind : std::uint8_t { kCorner, kTerminal };

/// A line through wall points, in the lidar frame: normal.dot(p) = offset_m.
struct WallSegment {
  Vec2 normal = Vec2::Zero();  ///< unit vector from the wall towards the sensor
  double offset_m = 0;         ///< negative: the normal points to the sensor
  Vec2 first =
      Vec2::Zero();  ///< projection of the first sample on the line (counter-clockwise order)
  Vec2 last = Vec2::Zero();
  double sigma_offset_m = 0;  ///< of the line at the centroid of its samples
  double sigma_angle_rad = 0;
  std::uint32_t first_sample = 0;  ///< index in the order of bearing
  std::uint32_t last_sample = 0;   ///< inclusive; smaller than first_sample across the seam
  std::uint32_t support = 0;       ///< samples on the line
};

/// A breakpoint in the lidar frame. "Right" is clockwise of it seen from the sensor, "left"
/// counter-clockwise. A terminal has one wall; the fields of its other side are not set.
struct Breakpoint {
  Vec2 position = Vec2::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  BreakpointKind kind = BreakpointKind::kCorner;
  bool convex = false;        ///< the free space opens by more than pi
  bool wall_on_right = true;  ///< a wall is visible on that side
  bool wall_on_left = true;
  double right_wall_rad = 0;  ///< direction along that wall, away from the breakpoint
  double left_wall_rad = 0;
  double opening_rad = 0;  ///< of the free space at a corner, from the left wall to the right one
  std::uint32_t right_support = 0;  ///< samples on that wall
  std::uint32_t left_support = 0;
};

inline constexpr std::size_t kMaxSegmentsPerScan = 256;
inline constexpr std::size_t kMaxBreakpointsPerScan = 256;

/// The breakpoints and walls of one scan, counter-clockwise from bearing -pi. Room is taken at
/// construction; what does not fit is dropped and counted.
struct Detection {
  Detection() {
    breakpoints.reserve(kMaxBreakpointsPerScan);
    segments.reserve(kMaxSegmentsPerScan);
  }
  void clear() {
    breakpoints.clear();
    segments.clear();
    overflowed = 0;
    noise_scale = 1;
  }
  std::vector<Breakpoint> breakpoints;
  std::vector<WallSegment> segments;
  std::size_t overflowed = 0;
  double noise_scale = 1;  ///< standard deviation of the residuals over the noise model's
};

}  // namespace cornerd::core
