// SPDX-License-Identifier: MIT
#include "core/recognition/evidence.hpp"

#include <gtest/gtest.h>

#include "core/geometry/angle.hpp"

namespace cornerd::core {
namespace {

constexpr double kAllRound_rad = radians(1);
constexpr double kHalfCovered_rad = radians(180);

Evidence evidence(std::size_t hits, std::size_t corners, double largest_gap_rad = kAllRound_rad,
                  std::size_t through = 0) {
  Evidence evidence;
  evidence.likelihood.rays = 800;
  evidence.likelihood.hits = hits;
  evidence.likelihood.free_space_violations = through;
  evidence.likelihood.shorts = 800 - hits - through;
  evidence.corners = corners;
  evidence.largest_gap_rad = largest_gap_rad;
  return evidence;
}

TEST(Evidence, NearlyAllHits_IsConclusive) {
  EXPECT_TRUE(is_conclusive(evidence(780, 0).likelihood, false));
  EXPECT_FALSE(is_conclusive(evidence(770, 0).likelihood, false));
  EXPECT_TRUE(is_conclusive(evidence(770, 0).likelihood, true));
}

TEST(Evidence, FewRays_AreNotConclusive) {
  BeamLikelihood few;
  few.rays = few.hits = 99;
  EXPECT_FALSE(is_conclusive(few, true));
}

TEST(Evidence, NearlyAllHitsOrManyAndThreeCorners_AreUnambiguous) {
  EXPECT_TRUE(is_unambiguous_fix(evidence(765, 0)));
  EXPECT_FALSE(is_unambiguous_fix(evidence(755, 0)));
  EXPECT_TRUE(is_unambiguous_fix(evidence(490, 3)));
  EXPECT_FALSE(is_unambiguous_fix(evidence(470, 2, kAllRound_rad, 10)));
}

TEST(Evidence, Obstacles_NeedCornerAndNoViolations) {
  EXPECT_TRUE(is_unambiguous_fix(evidence(450, 1)));
  EXPECT_FALSE(is_unambiguous_fix(evidence(450, 0)));
  EXPECT_FALSE(is_unambiguous_fix(evidence(450, 1, kAllRound_rad, 9)));
}

TEST(Evidence, Obstacles_NotExhaustive_AreAmbiguous) {
  Evidence untried = evidence(450, 1);
  untried.exhaustive = false;
  EXPECT_FALSE(is_unambiguous_fix(untried));
  untried = evidence(490, 3);
  untried.exhaustive = false;
  EXPECT_TRUE(is_unambiguous_fix(untried));
}

TEST(Evidence, HalfAScan_NeedsCorners) {
  EXPECT_FALSE(is_unambiguous_fix(evidence(790, 2, kHalfCovered_rad)));
  EXPECT_TRUE(is_unambiguous_fix(evidence(790, 3, kHalfCovered_rad)));
}

TEST(Evidence, HalfAScanAtPrior_NeedsCorner) {
  EXPECT_TRUE(may_be_tracked(evidence(80, 0)));
  Evidence half = evidence(80, 1, kHalfCovered_rad);
  EXPECT_FALSE(may_be_tracked(half));
  half.at_prior = true;
  EXPECT_TRUE(may_be_tracked(half));
  half.corners = 0;
  EXPECT_FALSE(may_be_tracked(half));
}

TEST(Evidence, Jump_NeedsConfirmationUnlessConclusive) {
  EXPECT_FALSE(needs_confirmation(evidence(780, 2), false, true));
  EXPECT_TRUE(needs_confirmation(evidence(780, 1), false, true));
  EXPECT_TRUE(needs_confirmation(evidence(770, 5), false, true));
  EXPECT_FALSE(needs_confirmation(evidence(770, 5), true, true));
  EXPECT_FALSE(needs_confirmation(evidence(770, 5), false, false));
}

TEST(Evidence, HalfAScan_NeedsConfirmationUnlessAtPrior) {
  Evidence half = evidence(790, 5, kHalfCovered_rad);
  EXPECT_TRUE(needs_confirmation(half, false, false));
  EXPECT_TRUE(needs_confirmation(half, true, true));
  half.at_prior = true;
  EXPECT_FALSE(needs_confirmation(half, true, true));
}

}  // namespace
}  // namespace cornerd::core
