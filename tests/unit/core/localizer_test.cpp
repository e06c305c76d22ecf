// SPDX-License-Identifier: MIT
#include "core/localizer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fixtures.hpp"

namespace cornerd::core {
namespace {

TEST(Localizer, UniqueRoom_FixFromOneScan) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(61);
  for (int k = 0; k < 100; ++k) {
    Localizer localizer(map, {});
    const Pose2 T_map_base = source.place_in(0.4, 2.2, 0.4, 2.6);
    const PoseEstimate& pose = localizer.step(source.take(*map, T_map_base)).pose;
    ASSERT_EQ(pose.state, PoseState::kFix);
    EXPECT_LT((pose.T_map_base.translation() - T_map_base.translation()).norm(), 0.005);
    EXPECT_LT(std::abs(angle_between(pose.T_map_base.theta_rad, T_map_base.theta_rad)), 0.005);
    EXPECT_EQ(pose.seq, 1U);
    EXPECT_GT(pose.inliers, 500U);
    EXPECT_GE(pose.corners, 3U);
    EXPECT_LT(pose.rmse_m, 0.01);
  }
}

TEST(Localizer, Rectangle_IsAmbiguousWithTruthAmongAlternatives) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(62);
  for (int k = 0; k < 50; ++k) {
    Localizer localizer(map, {});
    const Pose2 T_map_base = source.place_in(0.4, 2.6, 0.4, 1.6);
    const PoseEstimate& pose = localizer.step(source.take(*map, T_map_base)).pose;
    // In the centre the two hypotheses differ by a rotation of pi alone: still two.
    ASSERT_EQ(pose.state, PoseState::kAmbiguous);
    ASSERT_EQ(pose.alternatives.size(), 2U);
    double nearest = 1;
    double sum = 0;
    for (const Alternative& alternative : pose.alternatives) {
      nearest = std::min(nearest,
                         (alternative.T_map_base.translation() - T_map_base.translation()).norm());
      sum += alternative.score;
    }
    EXPECT_LT(nearest, 0.01);
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_GE(pose.alternatives[0].score, pose.alternatives[1].score);
  }
}

TEST(Localizer, TwoEqualRooms_AmbiguousWithoutPrior) {
  const auto map = testing::make_map(testing::two_equal_rooms());
  testing::ScanSource source(63);
  Localizer localizer(map, {});
  const PoseEstimate& pose = localizer.step(source.take(*map, {6.8, 1.2, 0.3})).pose;
  ASSERT_EQ(pose.state, PoseState::kAmbiguous);
  EXPECT_EQ(pose.alternatives.size(), 2U);
}

TEST(Localizer, ManyEqualRooms_NoneIsNamed) {
  for (const int rooms : {5, 12, 16, 17, 20, 40}) {
    const auto map = testing::make_map(testing::equal_rooms(rooms));
    testing::ScanSource source(65);
    Localizer localizer(map, {});
    const PoseEstimate& pose = localizer.step(source.take(*map, {1.8, 1.2, 0.3})).pose;
    EXPECT_EQ(pose.state, PoseState::kAmbiguous) << rooms;
    EXPECT_EQ(pose.alternatives.size(), std::min<std::size_t>(rooms, kMaxAlternatives)) << rooms;
  }
}

TEST(Localizer, TurningAmongManyEqualRooms_NoneIsNamed) {
  constexpr double kRate_rad_s = 1.5;
  const auto map = testing::make_map(testing::equal_rooms(24));
  testing::ScanSource source(66);
  testing::ScanOptions options;
  options.motion.twist.omega_rad_s = kRate_rad_s;
  for (int drive = 0; drive < 5; ++drive) {
    Localizer localizer(map, {});
    Pose2 at = source.place_in(0.4, 2.6, 0.3, 1.7);
    options.start_ns = 0;
    for (int k = 0; k < 40; ++k) {
      const PoseState state = localizer.step(source.take(*map, at, options)).pose.state;
      EXPECT_FALSE(has_pose(state)) << drive << " " << k;
      options.start_ns += from_seconds(options.scan_s);
      at.theta_rad = normalize_angle(at.theta_rad + kRate_rad_s * options.scan_s);
    }
  }
}

TEST(Localizer, OtherBuilding_GivesNoPose) {
  const auto map = testing::make_map(testing::l_shaped_room());
  const auto elsewhere = testing::make_map(testing::rectangular_room(7, 6.3));
  testing::ScanSource source(64);
  int lost = 0;
  for (int k = 0; k < 50; ++k) {
    Localizer localizer(map, {});
    const Pose2 T_map_base = source.place_in(1, 6, 1, 5);
    const PoseEstimate& pose = localizer.step(source.take(*elsewhere, T_map_base)).pose;
    EXPECT_FALSE(has_pose(pose.state)) << k;
    lost += pose.state == PoseState::kLost ? 1 : 0;
  }
  EXPECT_GE(lost, 45);
}

TEST(Localizer, MostlyCoveredLidar_FixIsRight) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(65);
  for (int k = 0; k < 50; ++k) {
    Localizer localizer(map, {});
    Scan covered;
    const Pose2 T_map_base = source.place_in(0.4, 2.2, 0.4, 2.6);
    const Scan scan = source.take(*map, T_map_base);
    for (Sample sample : scan.samples()) {
      if (std::abs(sample.bearing_rad) > radians(60)) sample.range_m = 0;
      covered.add(sample);
    }
    const PoseEstimate& pose = localizer.step(covered).pose;
    EXPECT_TRUE(pose.state != PoseState::kFix ||
                same_pose(pose.T_map_base, T_map_base, 0.05, radians(2)))
        << k;
  }
}

TEST(Localizer, EmptyScan_IsLost) {
  const auto map = testing::make_map(testing::l_shaped_room());
  Localizer localizer(map, {});
  EXPECT_EQ(localizer.step(Scan()).pose.state, PoseState::kLost);
  EXPECT_EQ(localizer.step(Scan()).pose.seq, 2U);
}

TEST(Localizer, NoMap_DetectsBreakpointsAndIsLost) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(65);
  Localizer localizer(nullptr, {});
  const ScanResult& result = localizer.step(source.take(*map, {1, 1, 0}));
  EXPECT_EQ(result.pose.state, PoseState::kLost);
  EXPECT_GE(result.detection.breakpoints.size(), 4U);
}

TEST(Localizer, MountedOffCentre_PoseIsOfBase) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(66);
  LocalizerConfig config;
  config.T_base_lidar = {0.1, -0.05, 2.0};
  Localizer localizer(map, config);
  const Pose2 T_map_base{1.3, 1.0, -0.8};
  const PoseEstimate& pose =
      localizer.step(source.take(*map, T_map_base * config.T_base_lidar)).pose;
  ASSERT_EQ(pose.state, PoseState::kFix);
  EXPECT_LT((pose.T_map_base.translation() - T_map_base.translation()).norm(), 0.005);
  EXPECT_NEAR(pose.T_map_base.theta_rad, T_map_base.theta_rad, 0.005);
}

TEST(Localizer, FirstScanWhileTurning_IsAnswered) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(71);
  testing::ScanOptions options;
  int answered = 0;
  for (int k = 0; k < 80; ++k) {
    Localizer localizer(map, {});
    options.motion = Twist2{0.3, 0, (k % 2 == 0 ? 0.025 : -0.025) * (k + 40)};
    const Pose2 T_map_base = source.place_in(0.4, 2.2, 0.4, 2.6);
    const bool has_prior = k % 4 < 2;
    if (has_prior) localizer.set_pose(T_map_base * Pose2{0.05, -0.05, 0.05});
    Scan scan;
    const Scan unhindered = source.take(*map, T_map_base, options);
    for (Sample sample : unhindered.samples()) {
      // Two things that are not on the map stop a fifth of the rays.
      const bool is_stopped = k % 8 < 4 && std::abs(std::sin(sample.bearing_rad)) > 0.95;
      if (is_stopped) sample.range_m = std::min(sample.range_m, 0.3F);
      scan.add(sample);
    }
    const PoseEstimate& pose = localizer.step(scan).pose;
    answered += pose.state == PoseState::kLost ? 0 : 1;
    if (!has_pose(pose.state)) continue;
    EXPECT_TRUE(same_pose(pose.T_map_base, T_map_base, 0.1, radians(5))) << k;
  }
  EXPECT_GE(answered, 78);
}

TEST(Localizer, DrivingRobot_IsTracked) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(67);
  Localizer localizer(map, {});
  testing::ScanOptions options;
  options.motion = Twist2{0.3, 0, 0.5};
  Pose2 T_map_base{0.6, 0.6, 0};
  for (int scan = 0; scan < 12; ++scan) {
    const PoseEstimate& pose = localizer.step(source.take(*map, T_map_base, options)).pose;
    ASSERT_TRUE(has_pose(pose.state)) << scan;
    EXPECT_LT((pose.T_map_base.translation() - T_map_base.translation()).norm(),
              scan < 4 ? 0.03 : 0.006);
    T_map_base = T_map_base * options.motion.twist.over(options.scan_s);
    options.start_ns += from_seconds(options.scan_s);
  }
}

TEST(Localizer, PoseInRoom_HasRoomIndex) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(68);
  Localizer localizer(map, {});
  const PoseEstimate& pose = localizer.step(source.take(*map, {1, 2.4, 0})).pose;
  ASSERT_TRUE(pose.room);
  EXPECT_EQ(map->plan().rooms[*pose.room].name, "nook");
}

TEST(Localizer, SameScans_PosesAreBitIdentical) {
  const auto map = testing::make_map(testing::l_shaped_room());
  const auto run = [&] {
    testing::ScanSource source(69);
    Localizer localizer(map, {});
    std::vector<double> values;
    for (int k = 0; k < 10; ++k) {
      const PoseEstimate& pose = localizer.step(source.take(*map, {1 + 0.01 * k, 1, 0})).pose;
      values.insert(values.end(), {pose.T_map_base.x_m, pose.T_map_base.y_m, pose.rmse_m});
    }
    return values;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace cornerd::core
