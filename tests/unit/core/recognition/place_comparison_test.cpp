// SPDX-License-Identifier: MIT
#include "core/recognition/place_comparison.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/map/ray_caster.hpp"

namespace cornerd::core {
namespace {

constexpr std::uint32_t kNone = PredictedHit::kNone;
constexpr double kSpacing_rad = radians(1);
/// Log odds that a scan alone would need for a fix.
constexpr double kFix = 11.5;

ScanAtPlace hitting(std::vector<std::uint32_t> faces) { return {20, 0.003, std::move(faces)}; }

/// 60 rays of 3 m: each is 5 cm of a wall.
class PlaceComparisonTest : public ::testing::Test {
 protected:
  double log_odds(const ScanAtPlace& one, const ScanAtPlace& other) {
    return comparison_.log_odds(one, other, points_, kSpacing_rad);
  }
  static std::vector<std::uint32_t> faces(std::uint32_t first, std::uint32_t second) {
    std::vector<std::uint32_t> faces(40, first);
    faces.resize(60, second);
    return faces;
  }
  PlaceComparison comparison_{8};
  std::vector<PolarPoint> points_ = std::vector<PolarPoint>(60, PolarPoint{.range_m = 3});
};

TEST_F(PlaceComparisonTest, SameWallsAtBoth_TellNothing) {
  EXPECT_EQ(log_odds(hitting(faces(0, 1)), hitting(faces(2, 3))), 0);
}

TEST_F(PlaceComparisonTest, WallThatOnePlaceAloneHas_TellsPlacesApart) {
  const ScanAtPlace one = hitting(faces(0, 1));
  const ScanAtPlace other = hitting(faces(2, kNone));
  EXPECT_GT(log_odds(one, other), kFix);
  EXPECT_EQ(log_odds(other, one), -log_odds(one, other));
}

TEST_F(PlaceComparisonTest, MoreOfAWallThatBothHave_TellsLess) {
  const double part = log_odds(hitting(faces(0, 0)), hitting(faces(2, kNone)));
  EXPECT_GT(part, 0);
  EXPECT_LT(part, kFix) << "a door may be closed";
}

TEST_F(PlaceComparisonTest, EachHasAWallOfItsOwn_TellsNothing) {
  std::vector<std::uint32_t> other = faces(2, kNone);
  for (std::size_t i = 0; i < 20; ++i) other[i] = kNone;
  std::vector<std::uint32_t> one = faces(kNone, 1);
  for (std::size_t i = 0; i < 20; ++i) one[i] = 0;
  for (std::size_t i = 20; i < 40; ++i) one[i] = kNone;
  EXPECT_NEAR(log_odds(hitting(one), hitting(other)), 0, kFix / 2);
}

TEST_F(PlaceComparisonTest, PlaceWhoseWallsAreOff_IsLessLikely) {
  const ScanAtPlace exact = hitting(faces(0, 1));
  ScanAtPlace off = hitting(faces(2, 3));
  off.map_sigma_m = 0.025;
  EXPECT_GT(log_odds(exact, off), 0);
}

}  // namespace
}  // namespace cornerd::core
