// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_tests.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// Side of a breakpoint on which its wall is, seen from the sensor.
enum class WallSide : int { kRight = +1, kLeft = -1 };

/// The end of a wall that meets no other: an edge with farther samples beyond.
class WallEnd {
 public:
  /// `free_samples`: number of samples beyond the end that are on no wall.
  WallEnd(const PolarScan& scan, const SegmentTrack& wall, WallSide side, std::size_t free_samples,
          const ExtractionContext& context);

  /// A corner where samples lie on the wall's end face, which is perpendicular and too short for a
  /// wall of its own; their mean is its position along the wall.
  std::optional<Breakpoint> corner() const;

  /// A terminal where the samples beyond lie behind the wall: at the end face if a sample shows it,
  /// else between the last sample and the next ray's intersection. None where that interval is too
  /// long.
  std::optional<Breakpoint> terminal() const;

 private:
  struct Beyond;
  /// Samples beyond the end that may lie on a face perpendicular to the wall.
  struct Face {
    std::size_t count = 0;
    double along_m = 0;  ///< means, in the frame of Beyond
    double height_m = 0;
    double variance_along_m2 = 0;
    double variance_height_m2 = 0;  ///< including the line's
  };
  Beyond sample_beyond(std::size_t nth) const;
  Face find_face() const;
  bool is_occluding(std::size_t skip) const;
  Breakpoint breakpoint_at(double along_m, double variance_along_m2) const;

  const PolarScan& scan_;
  const SegmentTrack& wall_;
  WallSide side_;
  std::size_t free_samples_;
  ExtractionContext context_;
  std::size_t last_;   ///< index of the wall's sample at this end
  Vec2 outward_;       ///< unit vector along the wall, beyond its end
  Vec2 foot_;          ///< projection of the last sample on the line
  double span_m_ = 0;  ///< from there to the next ray's intersection with the line
  Face face_;
};

}  // namespace cornerd::core
