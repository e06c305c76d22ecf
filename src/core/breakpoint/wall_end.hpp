// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_tests.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// Which side of a breakpoint its wall is on, as the sensor sees it.
enum class WallSide : int { kRight = +1, kLeft = -1 };

/// The end of a wall where it meets no other: an edge, behind which the turn goes on.
class WallEnd {
 public:
  /// `free_samples`: beyond the end, on no wall.
  WallEnd(const PolarScan& scan, const SegmentTrack& wall, WallSide side, std::size_t free_samples,
          const Judgement& by);

  /// A corner where samples lie on the face of the wall's end, square to it and too short for a
  /// wall of its own: their mean tells where the wall ends.
  std::optional<Breakpoint> corner() const;

  /// A terminal where what is seen beyond the end lies behind the wall: where the face of the end
  /// begins if a sample shows it, else between the last sample and where the next ray would have
  /// met the wall. None where that is too far to mean a place.
  std::optional<Breakpoint> terminal() const;

 private:
  struct Beyond;
  /// The samples beyond the end that may lie on a face square to the wall.
  struct Face {
    std::size_t count = 0;
    double along_m = 0;  ///< means of theirs, as in Beyond
    double height_m = 0;
    double variance_along_m2 = 0;
    double variance_height_m2 = 0;  ///< with that of the line
  };
  Beyond look(std::size_t nth) const;
  Face look_at_face() const;
  bool goes_on_behind(std::size_t skip) const;
  Breakpoint place(double along_m, double variance_along_m2) const;

  const PolarScan& scan_;
  const SegmentTrack& wall_;
  WallSide side_;
  std::size_t free_samples_;
  Judgement by_;
  std::size_t last_;   ///< the wall's sample at this end
  Vec2 outward_;       ///< along the wall, beyond its end
  Vec2 foot_;          ///< of the last sample on the line
  double span_m_ = 0;  ///< from there to where the next ray would meet the line
  Face face_;
};

}  // namespace cornerd::core
