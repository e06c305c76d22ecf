// SPDX-License-Identifier: MIT
#include "core/recognition/decision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

VerifiedHypothesis place_at(double x_m, double log_odds) {
  VerifiedHypothesis place;
  place.refined.T_map_lidar = {x_m, 0, 0};
  place.refined.valid = true;
  place.refined.least_inliers = 100;
  place.evidence = place.log_odds = log_odds;
  return place;
}

Decision decide_alone(const std::vector<VerifiedHypothesis>& places) {
  PlaceFilter filter;
  return decide(places, /*is_complete=*/true, std::nullopt, filter);
}

/// The robot was last named at `T_map_lidar`, and should be there still.
Decision decide_after(const Pose2& T_map_lidar, const std::vector<VerifiedHypothesis>& places) {
  PlaceFilter filter;
  filter.confirm(T_map_lidar);
  return decide(places, /*is_complete=*/true, Prior{T_map_lidar, 0.05, 0.05}, filter);
}

TEST(Decide, NoPlace_IsLost) {
  EXPECT_EQ(decide_alone({}).state, PoseState::kLost);
  EXPECT_EQ(decide_after({}, {}).state, PoseState::kLost);
}

TEST(Decide, OnePlaceFarAhead_IsFix) {
  const Decision decision = decide_alone({place_at(1, 30), place_at(5, 10)});
  EXPECT_EQ(decision.state, PoseState::kFix);
  EXPECT_EQ(decision.place, 0U);
}

TEST(Decide, TwoEqualPlaces_AreAmbiguous) {
  const Decision decision = decide_alone({place_at(1, 30), place_at(5, 29), place_at(9, 5)});
  EXPECT_EQ(decision.state, PoseState::kAmbiguous);
  EXPECT_EQ(decision.rivals, 2U);
}

TEST(Decide, PlacesLeftOut_NoneIsNamedWithoutPrior) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 30)};
  PlaceFilter filter;
  filter.confirm({1, 0, 0});
  const Decision alone = decide(places, /*is_complete=*/false, std::nullopt, filter);
  EXPECT_EQ(alone.state, PoseState::kAmbiguous);
  EXPECT_GE(alone.doubt, 0.5);
  filter.confirm({1, 0, 0});
  const Prior prior{{1, 0, 0}, 0.05, 0.05};
  EXPECT_EQ(decide(places, /*is_complete=*/false, prior, filter).state, PoseState::kTracking);
}

TEST(Decide, ManyUnlikelyPlaces_AreAmbiguousTogether) {
  std::vector<VerifiedHypothesis> places = {place_at(1, 30), place_at(5, 18)};
  const Decision alone = decide_alone(places);
  EXPECT_EQ(alone.state, PoseState::kFix);
  for (int k = 0; k < 6; ++k) places.push_back(place_at(10 + k, 18));
  const Decision among_many = decide_alone(places);
  EXPECT_EQ(among_many.state, PoseState::kAmbiguous);
  EXPECT_GT(7 * squared(alone.doubt), kWrongFixRate);
  EXPECT_EQ(among_many.doubt, kLeastDoubt) << "more than the evidence tells";
}

TEST(Decide, NamedPlace_DoubtIsTheRootOfWhatTheOddsLeave) {
  EXPECT_NEAR(decide_alone({place_at(1, 14)}).doubt, std::exp(-7), 1e-6);
  EXPECT_EQ(decide_alone({place_at(1, 60)}).doubt, 1e-6);
  const Decision tracking = decide_after({1, 0, 0}, {place_at(1, 5)});
  ASSERT_EQ(tracking.state, PoseState::kTracking);
  EXPECT_GT(tracking.doubt, 1e-5);
}

TEST(Decide, EqualPlaces_ShareThePosterior) {
  EXPECT_NEAR(decide_alone(std::vector(4, place_at(1, 40))).doubt, 0.75, 1e-12);
}

TEST(Decide, MaybeNotInThisMap_IsNoFix) {
  EXPECT_EQ(decide_alone({place_at(1, 12)}).state, PoseState::kFix);
  EXPECT_EQ(decide_alone({place_at(1, 11)}).state, PoseState::kAmbiguous);
  EXPECT_EQ(decide_alone({place_at(1, 4)}).state, PoseState::kLost);
}

TEST(Decide, PriorAtOneOfTwo_ChoosesIt) {
  const Decision decision = decide_after({5, 0, 0}, {place_at(1, 30), place_at(5.1, 29)});
  EXPECT_EQ(decision.state, PoseState::kTracking);
  EXPECT_EQ(decision.place, 1U);
}

TEST(Decide, PriorElsewhere_ChoosesNone) {
  EXPECT_EQ(decide_after({3, 0, 0}, {place_at(1, 30), place_at(5, 29)}).state,
            PoseState::kAmbiguous);
}

TEST(Decide, PriorAgainstClearScan_IsOverruled) {
  const Decision decision = decide_after({5, 0, 0}, {place_at(1, 30), place_at(5, -20)});
  EXPECT_EQ(decision.state, PoseState::kFix);
  EXPECT_EQ(decision.place, 0U);
}

TEST(Decide, FewRaysAlongACorridor_AreNoFix) {
  VerifiedHypothesis place = place_at(1, 30);
  place.refined.least_inliers = 2;
  EXPECT_EQ(decide_alone({place}).state, PoseState::kAmbiguous);
  EXPECT_EQ(decide_after({1, 0, 0}, {place}).state, PoseState::kTracking);
}

}  // namespace
}  // namespace cornerd::core
