// SPDX-License-Identifier: MIT
#include "core/recognition/decision.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cornerd::core {
namespace {

VerifiedHypothesis place_at(double x_m, double log_likelihood, double of_things) {
  VerifiedHypothesis place;
  place.refined.T_map_lidar = {x_m, 0, 0};
  place.refined.valid = true;
  place.refined.least_inliers = 100;
  place.likelihood.rays = 300;
  place.likelihood.hits = 300;
  place.likelihood.log_likelihood = log_likelihood;
  place.likelihood.log_likelihood_of_obstacles = of_things;
  return place;
}

TEST(Decide, NoHypothesis_IsLost) {
  EXPECT_EQ(decide({}, std::nullopt).state, PoseState::kLost);
  EXPECT_EQ(decide({}, Prior{}).state, PoseState::kLost);
}

TEST(Decide, OneHypothesisFarAhead_IsFix) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 900, 900)};
  const Decision decision = decide(places, std::nullopt);
  EXPECT_EQ(decision.state, PoseState::kFix);
  EXPECT_EQ(decision.place, 0U);
}

TEST(Decide, TwoEqualHypotheses_AreAmbiguous) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 995, 995),
                                                  place_at(9, 800, 800)};
  const Decision decision = decide(places, std::nullopt);
  EXPECT_EQ(decision.state, PoseState::kAmbiguous);
  EXPECT_EQ(decision.rivals, 2U);
}

TEST(Decide, ManyUnlikelyHypotheses_AreAmbiguousTogether) {
  std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 984, 900)};
  const Decision alone = decide(places, std::nullopt);
  EXPECT_EQ(alone.state, PoseState::kFix);
  EXPECT_LT(alone.doubt, kWrongFixRate);
  EXPECT_GT(alone.doubt, 0.1 * kWrongFixRate);
  for (int k = 0; k < 6; ++k) places.push_back(place_at(10 + k, 984, 900));
  const Decision among_many = decide(places, std::nullopt);
  EXPECT_EQ(among_many.state, PoseState::kAmbiguous);
  EXPECT_NEAR(among_many.doubt, 7 * alone.doubt, 0.01 * kWrongFixRate);
}

TEST(Decide, EqualHypotheses_ShareThePosterior) {
  const std::vector<VerifiedHypothesis> places(4, place_at(1, 1000, 1000));
  EXPECT_NEAR(decide(places, std::nullopt).doubt, 0.75, 1e-12);
}

TEST(Decide, BehindByRaysOfOneObstacle_StaysAmbiguous) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 700, 995)};
  EXPECT_EQ(decide(places, std::nullopt).state, PoseState::kAmbiguous);
}

TEST(Decide, CompetingWithMoreHits_StaysAmbiguous) {
  // A sensor off by 1 % and 5 mm: the true hypothesis fits less exactly, but with all rays.
  std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 800, 800)};
  places[0].likelihood.hits = 280;
  places[1].likelihood.hits = 220;
  places[1].likelihood.near_hits = 75;
  EXPECT_EQ(decide(places, std::nullopt).state, PoseState::kAmbiguous);
  places[1].likelihood.near_hits = 55;
  EXPECT_EQ(decide(places, std::nullopt).state, PoseState::kFix);
}

TEST(Decide, ReducedChiSquareAboveOne_WidensMargin) {
  std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 970, 970)};
  EXPECT_EQ(decide(places, std::nullopt).state, PoseState::kFix);
  places[0].refined.reduced_chi_square = 2.5;
  EXPECT_EQ(decide(places, std::nullopt).state, PoseState::kAmbiguous);
}

TEST(Decide, PriorAtOneHypothesis_ChoosesIt) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 995, 995)};
  const Decision decision = decide(places, Prior{{5.1, 0.05, 0.1}});
  EXPECT_EQ(decision.state, PoseState::kTracking);
  EXPECT_EQ(decision.place, 1U);
}

TEST(Decide, PriorReachesBothHypotheses_ChoosesNone) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(1.3, 995, 995)};
  EXPECT_EQ(decide(places, Prior{{1, 0, 0}}).state, PoseState::kTracking);
  EXPECT_EQ(decide(places, Prior{{1, 0, 0}, 0.1}).state, PoseState::kAmbiguous);
}

TEST(Decide, PriorElsewhere_ChoosesNone) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 995, 995)};
  EXPECT_EQ(decide(places, Prior{{3, 0, 0}}).state, PoseState::kAmbiguous);
}

TEST(Decide, PriorAgainstClearScan_IsOverruled) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000), place_at(5, 500, 500)};
  const Decision decision = decide(places, Prior{{5, 0, 0}});
  EXPECT_EQ(decision.state, PoseState::kFix);
  EXPECT_EQ(decision.place, 0U);
}

TEST(Decide, OpenRival_IsNoFixButNearThePrior) {
  const std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000)};
  const std::vector<VerifiedHypothesis> open = {place_at(5, 995, 995)};
  EXPECT_EQ(decide(places, std::nullopt).state, PoseState::kFix);
  EXPECT_EQ(decide(places, std::nullopt, open).state, PoseState::kAmbiguous);
  EXPECT_EQ(decide(places, Prior{{1, 0, 0}}, open).state, PoseState::kTracking);
  EXPECT_EQ(decide(places, Prior{{5, 0, 0}}, open).state, PoseState::kAmbiguous);
}

TEST(Decide, FewRaysAlongACorridor_AreBelievedAtASurePriorAlone) {
  std::vector<VerifiedHypothesis> places = {place_at(1, 1000, 1000)};
  places[0].refined.least_inliers = 2;
  EXPECT_EQ(decide(places, std::nullopt).state, PoseState::kAmbiguous);
  EXPECT_EQ(decide(places, Prior{{1.02, 0, 0}}).state, PoseState::kTracking);
  EXPECT_EQ(decide(places, Prior{{1.2, 0, 0}}).state, PoseState::kAmbiguous);
  EXPECT_EQ(decide(places, Prior{{1.02, 0, 0}, 0.3}).state, PoseState::kAmbiguous);
}

}  // namespace
}  // namespace cornerd::core
