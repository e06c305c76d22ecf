// SPDX-License-Identifier: MIT
#include "survey/loop_closure.hpp"

#include <gtest/gtest.h>

#include <array>

#include "mapped_scene.hpp"
#include "survey/adjustment.hpp"
#include "survey/loop_detection.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

/// A room with an alcove, which makes each place in it unique.
const std::vector<std::pair<Vec2, Vec2>> kAlcove = {
    {{-1, -1}, {3, -1}},     {{3, -1}, {3, 2}},        {{3, 2}, {1, 2}},     {{1, 2}, {1, 2.7}},
    {{1, 2.7}, {-0.2, 2.7}}, {{-0.2, 2.7}, {-0.2, 2}}, {{-0.2, 2}, {-1, 2}}, {{-1, 2}, {-1, -1}}};
constexpr std::size_t kInTheRoom = 60;
constexpr std::size_t kOutside = 120;
constexpr std::size_t kBackFrom = kInTheRoom + kOutside;

core::Pose2 place_in_the_room(std::size_t i) {
  const double s = static_cast<double>(i) / static_cast<double>(kInTheRoom);
  return {1.4 * s, 0.5 * s, 0.8 * s};
}

/// Out of the room, through a part without walls, and back with a drift of `off_m`, so that all
/// walls are mapped again.
MappedDrive drive_that_comes_back(double off_m, double link_sigma_m) {
  std::vector<core::Pose2> trajectory;
  for (std::size_t i = 0; i < kInTheRoom; ++i) trajectory.push_back(place_in_the_room(i));
  for (std::size_t i = 0; i < kOutside; ++i) {
    const double angle_rad = core::kTwoPi * static_cast<double>(i) / kOutside;
    trajectory.push_back({1.4 * (kOutside - i) / kOutside, 0.5 * (kOutside - i) / kOutside,
                          core::normalize_angle(0.8 - angle_rad)});
    trajectory.back().x_m += 2 * (1 - std::cos(angle_rad));
    trajectory.back().y_m += 2 * std::sin(angle_rad);
  }
  for (std::size_t i = 0; i < kInTheRoom; ++i) trajectory.push_back(place_in_the_room(i));

  MappedDrive drive = mapped_drive(kAlcove, trajectory);
  add_returns(drive);
  const auto known = static_cast<std::uint32_t>(drive.faces.size());
  std::erase_if(drive.observations, [](const MatchedObservation& observation) {
    return observation.scan >= kInTheRoom && observation.scan < kBackFrom;
  });
  for (std::size_t i = 0; i < known; ++i) drive.faces.push_back(drive.faces[i]);
  for (MatchedObservation& observation : drive.observations) {
    if (observation.scan >= kBackFrom) observation.face += known;
  }
  for (std::size_t i = kInTheRoom; i < trajectory.size(); ++i) {
    const double share = std::min(1.0, static_cast<double>(i - kInTheRoom) / kOutside);
    drive.T_map_lidar[i].x_m += off_m * share;
  }
  drive.odometry_edges.resize(1);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    OdometryEdge link;
    link.T_before_now = drive.T_map_lidar[i - 1].inverse() * drive.T_map_lidar[i];
    link.covariance =
        Eigen::Vector3d(squared(link_sigma_m), squared(link_sigma_m), 1e-8).asDiagonal();
    drive.odometry_edges.push_back(link);
  }
  measure_faces(drive);
  adjust(drive);
  return drive;
}

TEST(CloseLoops, DriftWithinCovariance_IsCorrectedAndWallsAreMerged) {
  MappedDrive drive = drive_that_comes_back(0.5, 0.02);
  std::size_t merged = 0;
  const auto reports = close_loops(drive, {}, {}, {}, merged);
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_TRUE(reports[0].closed()) << reports[0].refused;
  EXPECT_LT(reports[0].earlier, kInTheRoom);
  EXPECT_GE(reports[0].later, kBackFrom);
  EXPECT_NEAR(reports[0].off_m, 0.5, 0.02);
  EXPECT_EQ(merged, kAlcove.size());
  EXPECT_EQ(drive.faces.size(), kAlcove.size());
  EXPECT_NEAR(drive.T_map_lidar.back().x_m, place_in_the_room(kInTheRoom - 1).x_m, 0.005);
}

TEST(CloseLoops, DriftBeyondCovariance_IsRejectedWithoutEffect) {
  MappedDrive drive = drive_that_comes_back(0.5, 0.0002);
  const MappedDrive before = drive;
  std::size_t merged = 0;
  const auto reports = close_loops(drive, {}, {}, {}, merged);
  ASSERT_FALSE(reports.empty());
  for (const LoopReport& report : reports) EXPECT_FALSE(report.closed());
  EXPECT_EQ(merged, 0U);
  EXPECT_TRUE(drive.loop_constraints.empty());
  EXPECT_EQ(drive.faces.size(), before.faces.size());
  EXPECT_DOUBLE_EQ(drive.T_map_lidar.back().x_m, before.T_map_lidar.back().x_m);
}

TEST(CloseLoops, NoDrift_ChangesNothing) {
  MappedDrive drive = drive_that_comes_back(0, 0.02);
  std::size_t merged = 0;
  EXPECT_TRUE(close_loops(drive, {}, {}, {}, merged).empty());
  EXPECT_EQ(merged, 0U);
}

TEST(FindLoop, FirstSegment_HasNoLoop) {
  const MappedDrive drive = drive_that_comes_back(0.5, 0.02);
  EXPECT_FALSE(find_loop(drive, 0, {}, {}).has_value());
}

TEST(FindLoop, ReturnedSegment_GivesRelativePosesToEarlierScans) {
  const MappedDrive drive = drive_that_comes_back(0.5, 0.02);
  const auto loop = find_loop(drive, kBackFrom, {}, {});
  ASSERT_TRUE(loop.has_value());
  EXPECT_EQ(loop->recognised, loop->tried);
  EXPECT_EQ(loop->loop_constraints.size(), loop->recognised);
  for (const LoopConstraint& constraint : loop->loop_constraints) {
    const core::Pose2 was = place_in_the_room(constraint.earlier).inverse() *
                            place_in_the_room(constraint.later - kBackFrom);
    EXPECT_NEAR(constraint.T_earlier_later.x_m, was.x_m, 0.01);
    EXPECT_NEAR(constraint.T_earlier_later.y_m, was.y_m, 0.01);
    EXPECT_NEAR(constraint.T_earlier_later.theta_rad, was.theta_rad, 0.01);
  }
}

MappedDrive drive_in_a_room() {
  const std::vector<std::pair<core::Vec2, core::Vec2>> walls = {
      {{-1, -1}, {3, -1}}, {{3, -1}, {3, 2}}, {{3, 2}, {-1, 2}}, {{-1, 2}, {-1, -1}}};
  std::vector<core::Pose2> trajectory;
  for (int i = 0; i < 20; ++i) trajectory.push_back({0.1 * i, 0.02 * i, 0.05 * i});
  MappedDrive drive = mapped_drive(walls, trajectory);
  add_returns(drive);
  return drive;
}

TEST(SubsetOf, Scans_KeepTheirObservations) {
  const MappedDrive drive = drive_in_a_room();
  const std::array<std::uint32_t, 2> scans = {4, 11};
  const MappedDrive part = subset_of(drive, scans);
  ASSERT_EQ(part.T_map_lidar.size(), 2U);
  EXPECT_EQ(part.T_map_lidar[1].x_m, drive.T_map_lidar[11].x_m);
  EXPECT_EQ(part.points_of(1).size(), drive.points_of(11).size());
  EXPECT_EQ(part.points_of(1)[7].range_m, drive.points_of(11)[7].range_m);
  EXPECT_EQ(part.observations_of(1).size(), drive.observations_of(11).size());
  ASSERT_EQ(part.faces.size(), 4U);
  for (const LineLandmark& face : part.faces) EXPECT_EQ(face.observations, 2U);
}

TEST(SubsetOf, FaceWithoutObservation_IsLeftOut) {
  MappedDrive drive = drive_in_a_room();
  std::erase_if(drive.observations, [](const MatchedObservation& observation) {
    return observation.face == 2 && observation.scan < 10;
  });
  const std::array<std::uint32_t, 2> scans = {3, 5};
  EXPECT_EQ(subset_of(drive, scans).faces.size(), 3U);
}

TEST(MapFromScans, ScansInRoom_HasItsWallsAndCorners) {
  const MappedDrive drive = drive_in_a_room();
  const std::array<std::uint32_t, 8> scans = {0, 2, 4, 6, 8, 10, 12, 14};
  const auto map = map_from_scans(drive, scans, {}, {});
  ASSERT_NE(map, nullptr);
  EXPECT_EQ(map->plan().walls.size(), 4U);
  EXPECT_NEAR(map->range_along({0, 0}, 0, 12), 3, 0.01);
  EXPECT_EQ(map->corners().size(), 8U);  // of walls without thickness, from both sides
}

TEST(MapFromScans, TooFewScans_IsNull) {
  const std::array<std::uint32_t, 2> scans = {0, 1};
  EXPECT_EQ(map_from_scans(drive_in_a_room(), scans, {}, {}), nullptr);
}

}  // namespace
}  // namespace cornerd::survey
