// SPDX-License-Identifier: MIT
#include "core/recognition/place_filter.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cornerd::core {
namespace {

constexpr double kRate = 1e-5;

VerifiedHypothesis place_at(double x_m, double log_odds) {
  VerifiedHypothesis place;
  place.refined.T_map_lidar = {x_m, 0, 0};
  place.evidence = place.log_odds = log_odds;
  return place;
}

void update(PlaceFilter& filter, const std::vector<VerifiedHypothesis>& found,
            const std::optional<Prior>& prior = std::nullopt) {
  filter.update(found, prior);
}

TEST(PlaceFilter, OneWeakScan_NamesNothing) {
  PlaceFilter filter;
  update(filter, {place_at(1, 3)});
  EXPECT_GE(filter.doubt(), kLeastDoubt);
}

TEST(PlaceFilter, StandingRobot_GathersNothing) {
  PlaceFilter filter;
  for (int k = 0; k < 100; ++k) update(filter, {place_at(1, 3)});
  ASSERT_TRUE(filter.likeliest());
  EXPECT_GE(filter.doubt(), kLeastDoubt);
}

TEST(PlaceFilter, DrivingRobot_GathersEvidence) {
  PlaceFilter filter;
  for (int k = 0; k < 140; ++k) update(filter, {place_at(0.1 * k, 3), place_at(20, -25)});
  ASSERT_TRUE(filter.likeliest());
  EXPECT_EQ(*filter.likeliest(), 0U);
  EXPECT_LT(filter.doubt(), kRate);
}

TEST(PlaceFilter, EqualPlaces_StayEqual) {
  PlaceFilter filter;
  for (int k = 0; k < 100; ++k) {
    update(filter, {place_at(0.1 * k, 30), place_at(20 + 0.1 * k, 30)});
  }
  EXPECT_GT(filter.doubt(), 0.3);
}

TEST(PlaceFilter, ConfirmedPlace_NamedWhileScansSpeakForIt) {
  PlaceFilter filter;
  filter.confirm({1, 0, 0});
  const Prior there{{1, 0, 0}, 0.1, 0.1};
  update(filter, {place_at(1, -8)}, there);
  ASSERT_TRUE(filter.likeliest());
  EXPECT_LT(filter.doubt(), kRate);
  update(filter, {place_at(1, -20)}, there);
  EXPECT_FALSE(filter.likeliest()) << "likelier at a place that was not there";
  update(filter, {place_at(1, -8)}, there);
  EXPECT_TRUE(filter.likeliest());
}

TEST(PlaceFilter, RoomThatLooksAlike_DoesNotTakeTheConfirmedPlaceAway) {
  PlaceFilter filter;
  filter.confirm({1, 0, 0});
  update(filter, {place_at(9, 8), place_at(1, 7)}, Prior{{1, 0, 0}, 0.1, 0.1});
  ASSERT_TRUE(filter.likeliest());
  EXPECT_EQ(*filter.likeliest(), 1U);
  EXPECT_LT(filter.doubt(), kRate);
}

TEST(PlaceFilter, WeakPlaceBesideTheNamedOne_DoesNotTakeItsHypothesis) {
  PlaceFilter filter;
  update(filter, {place_at(0.7, -4)});
  update(filter, {place_at(0.7, -4), place_at(1, 12)});
  for (int k = 0; k < 100; ++k) update(filter, {place_at(1 + 0.1 * k, 20), place_at(0.7, -4)});
  ASSERT_LT(filter.doubt(), kRate);
  filter.follow({10.9, 0, 0});
  update(filter, {place_at(10.9, 12), place_at(10.6, -4)}, Prior{{10.9, 0, 0}, 0.02, 0.02});
  update(filter, {place_at(10.65, 12)}, Prior{{10.65, 0, 0}, 0.02, 0.02});
  EXPECT_LT(filter.doubt(), kRate);
}

TEST(PlaceFilter, PlaceThatWasWrongForLong_IsNamedAgainAsSoonAsANewOne) {
  PlaceFilter filter;
  for (int k = 0; k < 400; ++k) update(filter, {place_at(0.2 * k, -30)});
  for (int k = 0; k < 100; ++k) update(filter, {place_at(80 + 0.2 * k, 6)});
  EXPECT_LT(filter.doubt(), kRate);
}

TEST(PlaceFilter, VaguePrior_DoesNotNameAnotherPlaceAtOnce) {
  PlaceFilter filter;
  filter.confirm({1, 0, 0});
  const Prior vague{{1.8, 0, 0}, 1.5, 3};
  update(filter, {place_at(2.4, -10)}, vague);
  EXPECT_GT(filter.doubt(), kRate);
  filter.confirm({1, 0, 0});
  update(filter, {place_at(2.4, -8), place_at(1.1, -10)}, vague);
  ASSERT_TRUE(filter.likeliest());
  EXPECT_EQ(*filter.likeliest(), 1U) << "where it was last";
  EXPECT_LT(filter.doubt(), kRate);
}

TEST(PlaceFilter, VaguePrior_WhatWasSeenBeforeSpeaksForNoOtherPlace) {
  PlaceFilter filter;
  filter.confirm({1, 0, 0});
  for (int k = 0; k < 5; ++k) {
    update(filter, {place_at(1 + 0.1 * k, 30)}, Prior{{1 + 0.1 * k, 0, 0}, 0.02, 0.02});
  }
  update(filter, {place_at(3.4, -10)}, Prior{{2.8, 0, 0}, 1.5, 3});
  EXPECT_GT(filter.doubt(), kRate);
}

TEST(PlaceFilter, PlaceThatScansContradictForLong_IsNoLongerNamed) {
  PlaceFilter filter;
  filter.confirm({0, 0, 0});
  bool is_named = true;
  for (int k = 0; k < 160; ++k) {
    const double log_odds = k % 20 == 19 ? -10 : -26;  // speaks for it now and then
    update(filter, {place_at(0.1 * k, log_odds)}, Prior{{0.1 * k, 0, 0}, 0.02, 0.02});
    is_named = filter.likeliest() && filter.doubt() < kRate;
  }
  EXPECT_FALSE(is_named);
}

TEST(PlaceFilter, MorePlacesThanItKeeps_LikeliestAreKept) {
  PlaceFilter filter;
  std::vector<VerifiedHypothesis> many;
  for (int k = 0; k < 40; ++k) many.push_back(place_at(k, 40 - k));
  for (int k = 0; k < 3; ++k) update(filter, many);
  ASSERT_TRUE(filter.likeliest());
  EXPECT_EQ(*filter.likeliest(), 0U);
}

}  // namespace
}  // namespace cornerd::core
