// SPDX-License-Identifier: MIT
#include "core/recognition/map_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "../fixtures.hpp"
#include "core/breakpoint/detector.hpp"

namespace cornerd::core {
namespace {

class MapSearchTest : public ::testing::Test {
 protected:
  std::span<const PoseHypothesis> find(const Scan& scan) {
    points_ = testing::polar(scan);
    detector_.detect(points_, detection_);
    return search_.find(points_.points(), detection_.segments);
  }

  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::l_shaped_room());
  MapSearch search_{*map_};
  Detector detector_{{}, {}};
  Detection detection_;
  PolarScan points_;
  testing::ScanSource source_{71};
};

TEST_F(MapSearchTest, ScansFromAnywhere_TruePoseIsFoundFirst) {
  for (int k = 0; k < 50; ++k) {
    const Pose2 T_map_lidar = source_.place_in(0.4, 1.8, 0.4, 2.6);
    const auto found = find(source_.take(*map_, T_map_lidar));
    ASSERT_FALSE(found.empty());
    EXPECT_TRUE(same_pose(found.front().T_map_lidar, T_map_lidar, 0.1, radians(4))) << k;
    EXPECT_TRUE(search_.is_complete());
  }
}

TEST_F(MapSearchTest, TwoPlacesInASymmetricRoom_AreDistinctAndBestFirst) {
  map_ = testing::make_map(testing::rectangular_room(3, 2));
  search_ = MapSearch(*map_);
  const auto found = find(source_.take(*map_, {1.2, 0.9, 0.7}));
  ASSERT_GT(found.size(), 1U);
  EXPECT_LE(found.size(), MapSearch::kMaxFound);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end(),
                             [](const auto& a, const auto& b) { return a.votes > b.votes; }));
  EXPECT_FALSE(same_pose(found[0].T_map_lidar, found[1].T_map_lidar, 0.2, radians(5)));
}

TEST_F(MapSearchTest, TwoSidesOfAWall_BothAreFound) {
  // The walls of one corner, 18 cm thick, seen from within and, as far as the field can tell, from
  // behind them.
  FloorPlan corner;
  corner.thickness_m = 0.18;
  corner.walls = {{{0, 0}, {3, 0}}, {{0, 0}, {0, 3}}};
  map_ = testing::make_map(std::move(corner));
  search_ = MapSearch(*map_);
  for (int k = 0; k < 20; ++k) {
    const Pose2 T_map_lidar = source_.place_in(0.3, 2, 0.3, 2);
    const auto found = find(source_.take(*map_, T_map_lidar));
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const PoseHypothesis& other) {
      return same_pose(other.T_map_lidar, T_map_lidar, 0.09, radians(3));
    })) << k;
  }
}

TEST_F(MapSearchTest, EmptyScan_FindsNothing) { EXPECT_TRUE(find(Scan()).empty()); }

TEST(LikelihoodField, MaxScores_BoundTheCellsBelow) {
  const LikelihoodField field(*testing::make_map(testing::l_shaped_room()));
  for (int level = 1; level < LikelihoodField::kLevels; ++level) {
    const int size = 1 << level;
    for (int row = -size; row < field.rows(); row += 7) {
      for (int column = -size; column < field.columns(); column += 7) {
        int most = 0;
        for (int y = row; y < row + size; ++y) {
          for (int x = column; x < column + size; ++x) {
            most = std::max(most, field.max_score(0, x, y));
          }
        }
        ASSERT_GE(field.max_score(level, column, row), most) << level;
      }
    }
  }
}

TEST(LikelihoodField, LargeMap_TakesAtMost16MiB) {
  const LikelihoodField field(*testing::make_map(testing::rectangular_room(300, 200)));
  EXPECT_LE(field.memory_bytes(), 16U << 20U);
}

}  // namespace
}  // namespace cornerd::core
