// SPDX-License-Identifier: MIT
#include "survey/loop_closing.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"
#include "survey/adjustment.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

/// A room with an alcove, so that no other place in it looks like one.
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

/// In the room, then out of it and around where there is nothing to see, and back: `off_m` to the
/// right of where it thinks it is, so that all walls are taken for new ones.
MappedDrive drive_that_comes_back(double off_m, double link_sigma_m) {
  std::vector<core::Pose2> way;
  for (std::size_t i = 0; i < kInTheRoom; ++i) way.push_back(place_in_the_room(i));
  for (std::size_t i = 0; i < kOutside; ++i) {
    const double angle_rad = core::kTwoPi * static_cast<double>(i) / kOutside;
    way.push_back({1.4 * (kOutside - i) / kOutside, 0.5 * (kOutside - i) / kOutside,
                   core::normalize_angle(0.8 - angle_rad)});
    way.back().x_m += 2 * (1 - std::cos(angle_rad));
    way.back().y_m += 2 * std::sin(angle_rad);
  }
  for (std::size_t i = 0; i < kInTheRoom; ++i) way.push_back(place_in_the_room(i));

  MappedDrive drive = mapped_drive(kAlcove, way);
  add_returns(drive);
  const auto known = static_cast<std::uint32_t>(drive.faces.size());
  std::erase_if(drive.observations, [](const Observation& observation) {
    return observation.scan >= kInTheRoom && observation.scan < kBackFrom;
  });
  for (std::size_t i = 0; i < known; ++i) drive.faces.push_back(drive.faces[i]);
  for (Observation& observation : drive.observations) {
    if (observation.scan >= kBackFrom) observation.face += known;
  }
  for (std::size_t i = kInTheRoom; i < way.size(); ++i) {
    const double share = std::min(1.0, static_cast<double>(i - kInTheRoom) / kOutside);
    drive.T_map_lidar[i].x_m += off_m * share;
  }
  drive.links.resize(1);
  for (std::size_t i = 1; i < way.size(); ++i) {
    DriveLink link;
    link.T_before_now = drive.T_map_lidar[i - 1].inverse() * drive.T_map_lidar[i];
    link.covariance =
        Eigen::Vector3d(squared(link_sigma_m), squared(link_sigma_m), 1e-8).asDiagonal();
    drive.links.push_back(link);
  }
  measure_faces(drive);
  adjust(drive);
  return drive;
}

TEST(CloseLoops, DriveThatDrifted_IsBroughtBackAndItsWallsAreMerged) {
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

TEST(CloseLoops, WayThatIsKnownTooWell_RefusesAndLeavesTheDrive) {
  MappedDrive drive = drive_that_comes_back(0.5, 0.0002);
  const MappedDrive before = drive;
  std::size_t merged = 0;
  const auto reports = close_loops(drive, {}, {}, {}, merged);
  ASSERT_FALSE(reports.empty());
  for (const LoopReport& report : reports) EXPECT_FALSE(report.closed());
  EXPECT_EQ(merged, 0U);
  EXPECT_TRUE(drive.ties.empty());
  EXPECT_EQ(drive.faces.size(), before.faces.size());
  EXPECT_DOUBLE_EQ(drive.T_map_lidar.back().x_m, before.T_map_lidar.back().x_m);
}

TEST(CloseLoops, DriveThatCameBackRight_IsLeftAsItIs) {
  MappedDrive drive = drive_that_comes_back(0, 0.02);
  std::size_t merged = 0;
  EXPECT_TRUE(close_loops(drive, {}, {}, {}, merged).empty());
  EXPECT_EQ(merged, 0U);
}

TEST(FindLoop, TurnsBeforeAnyWayWasDriven_AreNoLoop) {
  const MappedDrive drive = drive_that_comes_back(0.5, 0.02);
  EXPECT_FALSE(find_loop(drive, 0, {}, {}).has_value());
}

TEST(FindLoop, StretchThatCameBack_TiesTurnsToWhereTheyWere) {
  const MappedDrive drive = drive_that_comes_back(0.5, 0.02);
  const auto loop = find_loop(drive, kBackFrom, {}, {});
  ASSERT_TRUE(loop.has_value());
  EXPECT_EQ(loop->recognised, loop->asked);
  EXPECT_EQ(loop->ties.size(), loop->recognised);
  for (const PlaceTie& tie : loop->ties) {
    const core::Pose2 was =
        place_in_the_room(tie.earlier).inverse() * place_in_the_room(tie.later - kBackFrom);
    EXPECT_NEAR(tie.T_earlier_later.x_m, was.x_m, 0.01);
    EXPECT_NEAR(tie.T_earlier_later.y_m, was.y_m, 0.01);
    EXPECT_NEAR(tie.T_earlier_later.theta_rad, was.theta_rad, 0.01);
  }
}

}  // namespace
}  // namespace cornerd::survey
