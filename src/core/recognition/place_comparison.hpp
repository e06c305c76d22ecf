// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/polar_scan.hpp"

namespace cornerd::core {

/// A scan at one of the places where it may have been taken.
struct ScanAtPlace {
  double log_odds = 0;     ///< against elsewhere, nats
  double map_sigma_m = 0;  ///< of the faces' offsets, the likeliest
  /// That each ray hits; PredictedHit::kNone for one that hits none.
  std::vector<std::uint32_t> faces;
};

/// What rays hit at one place, and none hits at another: widths as seen by the lidar.
struct ShownWalls {
  double whole_m = 0;  ///< of faces that are hit there alone
  double part_m = 0;   ///< of faces that both places have
};

/// Compares two places of one map ray by ray. What a scan shows of each by itself says little of
/// which of two is right where both explain most of it: rooms are alike, and obstacles hide how
/// they differ. A wall that rays hit at one of them, where at the other something unmapped would
/// have to stand just there, tells them apart; the less so where it goes on in a wall that both
/// have, as a closed door does. Allocates nothing after construction.
class PlaceComparison {
 public:
  explicit PlaceComparison(std::size_t map_faces) : faces_(map_faces) { met_.reserve(map_faces); }

  /// What is hit at `one` alone. `points`: of the rays, `spacing_rad` apart.
  ShownWalls shown_at(const ScanAtPlace& one, const ScanAtPlace& other,
                      std::span<const PolarPoint> points, double spacing_rad);
  /// Log odds of `one` against `other`, nats: a logistic regression (`cornerd-bench --evidence`,
  /// src/bench/localization/fit_evidence.py).
  double log_odds(const ScanAtPlace& one, const ScanAtPlace& other,
                  std::span<const PolarPoint> points, double spacing_rad);

 private:
  struct Face {
    double rays = 0;     ///< that hit it, and none at the other place
    double shared = 0;   ///< that hit it, and one at the other place
    double width_m = 0;  ///< of the former
  };
  std::vector<Face> faces_;         ///< by index into map.faces()
  std::vector<std::uint32_t> met_;  ///< faces with rays
};

}  // namespace cornerd::core
