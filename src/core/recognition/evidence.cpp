// SPDX-License-Identifier: MIT
#include "core/recognition/evidence.hpp"

#include "core/geometry/angle.hpp"

namespace cornerd::core {
namespace {

/// A hypothesis with a lower share of hits than outliers and mixed pixels explain, or with few
/// hits, may be the wrong one of several: rooms of one building share walls.
constexpr double kCertainHitShare = 0.97;
constexpr double kCertainHitShareExpected = 0.9;
constexpr std::size_t kCertainHits = 100;
constexpr double kExactHitShare = 0.95;
/// Two walls and a box stand like a corner: with half of the view, most hits prove little.
constexpr double kMaxGap_rad = radians(170);

}  // namespace

bool has_full_coverage(double largest_gap_rad) { return largest_gap_rad < kMaxGap_rad; }

bool is_conclusive(const BeamLikelihood& likelihood, bool expected) {
  return likelihood.hits >= kCertainHits &&
         likelihood.hit_share() >= (expected ? kCertainHitShareExpected : kCertainHitShare);
}

bool is_exact(const BeamLikelihood& likelihood, bool expected) {
  return is_conclusive(likelihood, expected) ||
         (likelihood.hits >= kCertainHits && likelihood.hit_share() >= kExactHitShare);
}

}  // namespace cornerd::core
