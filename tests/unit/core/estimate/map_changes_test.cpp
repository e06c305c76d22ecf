// SPDX-License-Identifier: MIT
#include "core/estimate/map_changes.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

constexpr double kWallSigma_m = 0.01;
constexpr TimeNs kOneSecond_ns = 1'000'000'000;
const Wall kDividingScreen{{1.0, 1.2}, {1.5, 1.2}, 0.05};

class MapChangesTest : public ::testing::Test {
 protected:
  /// Scans of a robot that drives to and fro along the lower wall, one a second.
  void drive(const FloorPlan& building, int seconds) {
    const auto world = testing::make_map(building);
    for (int k = 0; k < seconds; ++k) {
      const Pose2 T_map_lidar{0.6 + 0.2 * (time_s_ % 8), 0.5, 0.3};
      const PolarScan points = testing::polar(source_.take(*world, T_map_lidar));
      changes_->add(*map_, T_map_lidar, points.points(), kWallSigma_m, ++time_s_ * kOneSecond_ns);
    }
  }
  void use_map(const FloorPlan& plan) {
    map_ = testing::make_map(plan);
    changes_.emplace(*map_, 12);
  }
  static FloorPlan with_screen(const Vec2& by = Vec2::Zero()) {
    FloorPlan plan = testing::l_shaped_room();
    plan.walls.push_back(kDividingScreen);
    for (Vec2* end : {&plan.walls.back().from, &plan.walls.back().to}) *end += by;
    return plan;
  }

  std::shared_ptr<const WallMap> map_;
  std::optional<MapChanges> changes_;
  testing::ScanSource source_{91};
  int time_s_ = 0;
};

TEST_F(MapChangesTest, MapIsRight_NoChange) {
  use_map(with_screen());
  drive(with_screen(), 200);
  EXPECT_TRUE(changes_->changes().empty());
}

TEST_F(MapChangesTest, WallTakenAway_GoneAfterHalfAMinute) {
  use_map(with_screen());
  drive(testing::l_shaped_room(), 10);
  EXPECT_TRUE(changes_->changes().empty());
  drive(testing::l_shaped_room(), 30);
  ASSERT_EQ(changes_->changes().size(), 1u);
  EXPECT_EQ(changes_->changes()[0].kind, MapChange::Kind::kWallGone);
  EXPECT_EQ(changes_->changes()[0].wall, 6u);
  drive(with_screen(), 2);
  EXPECT_TRUE(changes_->changes().empty()) << "it is back";
}

TEST_F(MapChangesTest, ThingThatStays_IsNewAfterMinutesAndForgottenWhenTakenAway) {
  use_map(testing::l_shaped_room());
  drive(with_screen(), 30);
  EXPECT_TRUE(changes_->changes().empty());
  drive(with_screen(), 170);
  ASSERT_FALSE(changes_->changes().empty());
  for (const MapChange& change : changes_->changes()) {
    EXPECT_EQ(change.kind, MapChange::Kind::kNewThing);
    EXPECT_LT((change.position - Vec2(1.25, 1.2)).norm(), 0.4);
  }
  drive(testing::l_shaped_room(), 100);
  EXPECT_TRUE(changes_->changes().empty());
}

TEST_F(MapChangesTest, AfterARestart_ChangesStayUntilTheyAreSeenNoMore) {
  use_map(with_screen());
  const std::vector<MapChange> known = {
      {MapChange::Kind::kWallGone, 6, Vec2::Zero()},
      {MapChange::Kind::kWallGone, 700, Vec2::Zero()},
      {MapChange::Kind::kNewThing, 0, Vec2(0.85, 0.95)},
      {MapChange::Kind::kNewThing, 0, Vec2(0.85, 1e300)},
  };
  changes_->resume(known);
  ASSERT_EQ(changes_->changes().size(), 2u) << "two are not of this map";
  EXPECT_EQ(changes_->changes()[1], known[2]);
  drive(testing::l_shaped_room(), 2);
  ASSERT_FALSE(changes_->changes().empty());
  EXPECT_EQ(changes_->changes()[0], known[0]);
  drive(with_screen(), 100);
  EXPECT_TRUE(changes_->changes().empty());
}

TEST_F(MapChangesTest, Passers_AreNoChange) {
  use_map(testing::l_shaped_room());
  for (int k = 0; k < 40; ++k) drive(with_screen({0.15 * (k % 6), 0.15 * (k % 4)}), 5);
  EXPECT_TRUE(changes_->changes().empty());
}

}  // namespace
}  // namespace cornerd::core
