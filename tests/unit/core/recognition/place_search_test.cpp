// SPDX-License-Identifier: MIT
#include "core/recognition/place_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../fixtures.hpp"
#include "core/breakpoint/detector.hpp"
#include "core/recognition/decision.hpp"

namespace cornerd::core {
namespace {

class PlaceSearchTest : public ::testing::Test {
 protected:
  /// Log odds of a place that is proposed a few centimetres beside.
  double log_odds_at(const Pose2& T_map_lidar, bool fits_motion) {
    detector_.detect(points_, detection_);
    search_.begin(points_, detection_.segments, detection_.breakpoints, detection_.noise_scale,
                  BeamModel::kMapSigmas_m.back(), fits_motion);
    const PoseHypothesis beside{{T_map_lidar.x_m + 0.04, T_map_lidar.y_m, T_map_lidar.theta_rad},
                                0};
    search_.consider(std::span(&beside, 1));
    const auto found = search_.find();
    return found.empty() ? -INFINITY : found.front().log_odds;
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

TEST_F(PlaceSearchTest, TruePlace_LeavesNoDoubt) {
  const Pose2 T_map_lidar{0.8, 1.2, 0.3};
  points_ = testing::polar(source_.take(*map_, T_map_lidar));
  EXPECT_GT(log_odds_at(T_map_lidar, false), -std::log(kWrongFixRate));
}

TEST_F(PlaceSearchTest, MotionFittedToFewWalls_CostsItsThreeParameters) {
  const Pose2 T_map_lidar{0.8, 1.2, 0.3};
  points_ = testing::polar(source_.take(*map_, T_map_lidar));
  const double known = log_odds_at(T_map_lidar, false);
  const double fitted = log_odds_at(T_map_lidar, true);
  EXPECT_NEAR(known - fitted, 1.5 * std::log(static_cast<double>(points_.points().size())), 0.01);
}

}  // namespace
}  // namespace cornerd::core
