// SPDX-License-Identifier: MIT
#include "baseline/paper_recognition.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../core/fixtures.hpp"
#include "core/breakpoint/detector.hpp"

namespace cornerd::baseline {
namespace {

using namespace core;

class PaperRecognitionTest : public ::testing::Test {
 protected:
  std::span<const PoseHypothesis> places_of(const Pose2& T_map_lidar) {
    detector_.detect(testing::polar(source_.take(*map_, T_map_lidar)), detection_);
    return recognition_.hypotheses(detection_.breakpoints, detection_.segments);
  }

  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::l_shaped_room());
  Catalog catalog_{*map_, 12};
  PaperRecognition recognition_{*map_, catalog_};
  testing::ScanSource source_{51};
  Detector detector_{{}, {}};
  Detection detection_;
};

TEST_F(PaperRecognitionTest, AsymmetricRoom_IsRecognised) {
  int found = 0;
  for (int k = 0; k < 40; ++k) {
    const Pose2 T_map_lidar = source_.place_in(0.4, 2.2, 0.4, 1.4);
    const auto hypotheses = places_of(T_map_lidar);
    found += std::any_of(hypotheses.begin(), hypotheses.end(), [&](const PoseHypothesis& place) {
      return same_pose(place.T_map_lidar, T_map_lidar, 0.1, radians(5));
    });
  }
  EXPECT_GE(found, 36);
}

TEST_F(PaperRecognitionTest, FewerThanThreeCorners_NoHypothesis) {
  places_of({1, 1, 0});
  detection_.breakpoints.resize(2);
  EXPECT_TRUE(recognition_.hypotheses(detection_.breakpoints, detection_.segments).empty());
  EXPECT_TRUE(recognition_.hypotheses({}, {}).empty());
}

}  // namespace
}  // namespace cornerd::baseline
