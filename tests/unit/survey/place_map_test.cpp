// SPDX-License-Identifier: MIT
#include "survey/place_map.hpp"

#include <gtest/gtest.h>

#include <array>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

MappedDrive drive_in_a_room() {
  const std::vector<std::pair<core::Vec2, core::Vec2>> walls = {
      {{-1, -1}, {3, -1}}, {{3, -1}, {3, 2}}, {{3, 2}, {-1, 2}}, {{-1, 2}, {-1, -1}}};
  std::vector<core::Pose2> way;
  for (int i = 0; i < 20; ++i) way.push_back({0.1 * i, 0.02 * i, 0.05 * i});
  MappedDrive drive = mapped_drive(walls, way);
  add_returns(drive);
  return drive;
}

TEST(PartOf, Turns_KeepWhatTheySaw) {
  const MappedDrive drive = drive_in_a_room();
  const std::array<std::uint32_t, 2> scans = {4, 11};
  const MappedDrive part = part_of(drive, scans);
  ASSERT_EQ(part.T_map_lidar.size(), 2U);
  EXPECT_EQ(part.T_map_lidar[1].x_m, drive.T_map_lidar[11].x_m);
  EXPECT_EQ(part.points_of(1).size(), drive.points_of(11).size());
  EXPECT_EQ(part.points_of(1)[7].range_m, drive.points_of(11)[7].range_m);
  EXPECT_EQ(part.observations_of(1).size(), drive.observations_of(11).size());
  ASSERT_EQ(part.faces.size(), 4U);
  for (const MappedFace& face : part.faces) EXPECT_EQ(face.sightings, 2U);
}

TEST(PartOf, FaceThatNoneOfTheTurnsSaw_IsLeftOut) {
  MappedDrive drive = drive_in_a_room();
  std::erase_if(drive.observations, [](const Observation& observation) {
    return observation.face == 2 && observation.scan < 10;
  });
  const std::array<std::uint32_t, 2> scans = {3, 5};
  EXPECT_EQ(part_of(drive, scans).faces.size(), 3U);
}

TEST(MapSeenBy, TurnsInARoom_HasItsWallsAndCorners) {
  const MappedDrive drive = drive_in_a_room();
  const std::array<std::uint32_t, 8> scans = {0, 2, 4, 6, 8, 10, 12, 14};
  const auto map = map_seen_by(drive, scans, {}, {});
  ASSERT_NE(map, nullptr);
  EXPECT_EQ(map->plan().walls.size(), 4U);
  EXPECT_NEAR(map->range_along({0, 0}, 0, 12), 3, 0.01);
  EXPECT_EQ(map->corners().size(), 8U);  // of walls without thickness, from both sides
}

TEST(MapSeenBy, TooFewTurnsToBelieveAWall_IsNone) {
  const std::array<std::uint32_t, 2> scans = {0, 1};
  EXPECT_EQ(map_seen_by(drive_in_a_room(), scans, {}, {}), nullptr);
}

}  // namespace
}  // namespace cornerd::survey
