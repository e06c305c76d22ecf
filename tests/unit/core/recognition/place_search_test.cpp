// SPDX-License-Identifier: MIT
#include "core/recognition/place_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "../fixtures.hpp"
#include "core/breakpoint/detector.hpp"
#include "core/recognition/decision.hpp"

namespace cornerd::core {
namespace {

class PlaceSearchTest : public ::testing::Test {
 protected:
  /// The likeliest place of `points_`, of one that is proposed a few centimetres beside.
  VerifiedHypothesis place_at(const Pose2& T_map_lidar, bool fits_motion = false) {
    detector_.detect(points_, detection_);
    search_.begin(points_, detection_.segments, detection_.breakpoints,
                  {.noise_scale = detection_.noise_scale, .fits_motion = fits_motion});
    const PoseHypothesis beside{{T_map_lidar.x_m + 0.04, T_map_lidar.y_m, T_map_lidar.theta_rad},
                                0};
    search_.consider(std::span(&beside, 1));
    const auto found = search_.find();
    if (found.empty()) throw std::runtime_error("no place found");
    return found.front();
  }

  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::l_shaped_room());
  Catalog catalog_{*map_, 12};
  Recognition recognition_{catalog_};
  PlaceSearch search_{*map_, recognition_, {}};
  Detector detector_{{}, {}};
  Detection detection_;
  PolarScan points_;
  testing::ScanSource source_{5};
};

const Pose2 kTruth{0.8, 1.2, 0.3};

TEST_F(PlaceSearchTest, TruePlace_LeavesNoDoubt) {
  points_ = testing::polar(source_.take(*map_, kTruth));
  EXPECT_GT(place_at(kTruth).log_odds, -std::log(kWrongFixRate));
}

TEST_F(PlaceSearchTest, WallsWhereTheMapHasThem_AreExact) {
  points_ = testing::polar(source_.take(*map_, kTruth));
  EXPECT_TRUE(place_at(kTruth).is_exact);
  ASSERT_TRUE(search_.exact());
  EXPECT_GT(search_.exact()->rays.hit_share(), 0.99);
}

TEST_F(PlaceSearchTest, WallsOff_AreNotExact) {
  FloorPlan plan = testing::l_shaped_room();
  for (Wall& wall : plan.walls) {
    // By 0 to 3.5 cm.
    const Vec2 by = 0.01 * static_cast<double>(&wall - plan.walls.data()) * Vec2(0.5, 0.5);
    wall.from += by;
    wall.to += by;
  }
  const auto world = testing::make_map(std::move(plan));
  points_ = testing::polar(source_.take(*world, kTruth));
  const VerifiedHypothesis place = place_at(kTruth);
  EXPECT_FALSE(place.is_exact);
  EXPECT_GT(place.map_sigma_m, 0);
  EXPECT_GT(place.log_odds, -std::log(kWrongFixRate));
}

TEST_F(PlaceSearchTest, FurtherHypotheses_KeepThePlacesBefore) {
  points_ = testing::polar(source_.take(*map_, kTruth));
  const VerifiedHypothesis before = place_at(kTruth);
  const PoseHypothesis wrong{{3, 0.8, 2}, 0};
  search_.consider(std::span(&wrong, 1));
  const auto found = search_.find();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().evidence, before.evidence);
  EXPECT_EQ(found.front().refined.T_map_lidar, before.refined.T_map_lidar);
}

TEST_F(PlaceSearchTest, MotionFittedToFewWalls_CostsItsThreeParameters) {
  points_ = testing::polar(source_.take(*map_, kTruth));
  const double known = place_at(kTruth, false).log_odds;
  const double fitted = place_at(kTruth, true).log_odds;
  EXPECT_NEAR(known - fitted, 1.5 * std::log(static_cast<double>(points_.points().size())), 0.01);
}

}  // namespace
}  // namespace cornerd::core
