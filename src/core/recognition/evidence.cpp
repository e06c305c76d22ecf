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
/// A fix without a prior needs hits of nearly all rays, or hits of most rays and several corners.
/// Lower shares may come from another building or a wrong motion, and need a prior.
constexpr double kFixHitShare = 0.95;
constexpr double kFixHitShareWithCorners = 0.6;
constexpr std::size_t kFixCorners = 3;
/// Or one corner and no free-space violations, where the other rays may be unmapped obstacles.
/// Large maps, whose corridors cannot all be tested, are excluded.
constexpr double kFixHitShareWithObstacles = 0.55;
constexpr double kMaxViolationShareWithObstacles = 0.01;
/// A scan with a larger gap (the lidar was covered) fits many poses: only several corners make it a
/// fix.
constexpr double kMaxGap_rad = radians(170);

}  // namespace

bool has_full_coverage(double largest_gap_rad) { return largest_gap_rad < kMaxGap_rad; }

bool is_conclusive(const BeamLikelihood& likelihood, bool expected) {
  return likelihood.hits >= kCertainHits &&
         likelihood.hit_share() >= (expected ? kCertainHitShareExpected : kCertainHitShare);
}

bool is_unambiguous_fix(const Evidence& evidence) {
  const double hit_share = evidence.likelihood.hit_share();
  if (hit_share >= kFixHitShareWithCorners && evidence.corners >= kFixCorners) return true;
  if (!has_full_coverage(evidence.largest_gap_rad)) return false;
  return hit_share >= kFixHitShare ||
         (evidence.exhaustive && hit_share >= kFixHitShareWithObstacles && evidence.corners >= 1 &&
          evidence.likelihood.violation_share() <= kMaxViolationShareWithObstacles);
}

bool may_be_tracked(const Evidence& evidence) {
  return has_full_coverage(evidence.largest_gap_rad) ||
         (evidence.corners >= 1 && evidence.at_prior);
}

bool needs_confirmation(const Evidence& evidence, bool expected, bool has_prior) {
  if (!has_full_coverage(evidence.largest_gap_rad)) return !evidence.at_prior;
  const bool is_certain =
      is_conclusive(evidence.likelihood, /*expected=*/false) && evidence.corners >= kCertainCorners;
  return has_prior && !expected && !is_certain;
}

}  // namespace cornerd::core
