// SPDX-License-Identifier: MIT
#include "core/recognition/evidence.hpp"

#include "core/geometry/angle.hpp"

namespace cornerd::core {
namespace {

/// A place that leaves more of the rays unexplained than outliers and mixed pixels do, or that few
/// rays speak for, may be the wrong one of several: rooms of one building share walls.
constexpr double kCertainHitShare = 0.97;
constexpr double kCertainHitShareExpected = 0.9;
constexpr std::size_t kCertainHits = 100;
constexpr std::size_t kCertainCorners = 2;
/// A place is evident where it explains nearly every ray and a corner, or most rays and several.
/// What fits less well may be a building or a motion that is not what it seems: only a place that
/// was expected is believed on that.
constexpr double kEvidentHitShare = 0.95;
constexpr double kEvidentHitShareOfCorners = 0.6;
constexpr std::size_t kEvidentCorners = 3;
/// Or where a corner speaks for it and what it does not explain may be things in front of the
/// walls, for nothing was seen through one: unless the building is too large to try all its
/// corridors, of which another one may need no things at all.
constexpr double kEvidentHitShareAmongThings = 0.55;
constexpr double kThroughShareAmongThings = 0.01;
/// A turn that shows nothing over so much of the circle (the lidar was covered meanwhile) may be
/// that of many places: then only several corners make one evident.
constexpr double kWidestGap_rad = radians(170);

}  // namespace

bool is_whole(double widest_gap_rad) { return widest_gap_rad < kWidestGap_rad; }

bool leaves_no_doubt(const Explanation& explanation, bool expected) {
  return explanation.hits >= kCertainHits &&
         explanation.hit_share() >= (expected ? kCertainHitShareExpected : kCertainHitShare);
}

bool is_evident(const Evidence& evidence) {
  const double hit_share = evidence.explanation.hit_share();
  if (hit_share >= kEvidentHitShareOfCorners && evidence.corners >= kEvidentCorners) return true;
  if (!is_whole(evidence.widest_gap_rad)) return false;
  return hit_share >= kEvidentHitShare ||
         (evidence.all_tried && hit_share >= kEvidentHitShareAmongThings && evidence.corners >= 1 &&
          evidence.explanation.through_share() <= kThroughShareAmongThings);
}

bool may_be_tracked(const Evidence& evidence) {
  return is_whole(evidence.widest_gap_rad) || (evidence.corners >= 1 && evidence.at_prior);
}

bool needs_a_second(const Evidence& evidence, bool expected, bool has_prior) {
  if (!is_whole(evidence.widest_gap_rad)) return !evidence.at_prior;
  const bool is_certain = leaves_no_doubt(evidence.explanation, /*expected=*/false) &&
                          evidence.corners >= kCertainCorners;
  return has_prior && !expected && !is_certain;
}

}  // namespace cornerd::core
