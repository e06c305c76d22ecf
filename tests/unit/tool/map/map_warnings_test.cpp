// SPDX-License-Identifier: MIT
#include "tool/map/map_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "command_run.hpp"
#include "settings/map_file.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

core::FloorPlan two_rooms() {
  core::FloorPlan plan;
  plan.walls = {{{0, 0}, {6, 0}, 0.1},
                {{6, 0}, {6, 3}, 0.1},
                {{6, 3}, {0, 3}, 0.1},
                {{0, 3}, {0, 0}, 0.1},
                {{3, 0}, {3, 2}, 0.1}};
  plan.rooms = {{"west", {{0, 0}, {3.05, 0}, {3.05, 3}, {0, 3}}},
                {"east", {{2.95, 0}, {6, 0}, {6, 3}, {2.95, 3}}}};
  return plan;
}

std::vector<std::string> warnings_of(core::FloorPlan plan) {
  return map_warnings(core::WallMap(std::move(plan)));
}

TEST(MapWarnings, RightMaps_HaveNone) {
  EXPECT_THAT(warnings_of(two_rooms()), IsEmpty());
  for (const auto& file : std::filesystem::directory_iterator(CORNERD_SOURCE_DIR "/config/maps")) {
    EXPECT_THAT(map_warnings(*settings::load_map(file.path())), IsEmpty()) << file.path();
  }
}

TEST(MapWarnings, SizeOver500Metres_IsAskedForItsUnits) {
  core::FloorPlan plan = two_rooms();
  plan.walls.push_back({{0, 3}, {0, 501}, 0.1});
  EXPECT_THAT(warnings_of(plan), ElementsAre(AllOf(HasSubstr("6 x 501 m"), HasSubstr("scale"))));
}

TEST(MapWarnings, WallWithoutLength) {
  core::FloorPlan plan = two_rooms();
  plan.walls.push_back({{1, 1}, {1, 1}, 0.2});
  EXPECT_THAT(warnings_of(plan), ElementsAre(HasSubstr("wall 5 at (1.000, 1.000) has no length")));
}

TEST(MapWarnings, DuplicateWall_InEitherDirection) {
  core::FloorPlan plan = two_rooms();
  plan.walls.push_back({{6, 3}, {6, 0}, 0.2});
  EXPECT_THAT(warnings_of(plan), ElementsAre(AllOf(HasSubstr("wall 5"), HasSubstr("of wall 1"))));
}

TEST(MapWarnings, RoomWithCrossedCorners) {
  core::FloorPlan plan = two_rooms();
  plan.rooms.resize(1);
  std::swap(plan.rooms[0].polygon[2], plan.rooms[0].polygon[3]);
  EXPECT_THAT(warnings_of(plan),
              ElementsAre(AllOf(HasSubstr("room 0, \"west\","), HasSubstr("bow-tie"))));
}

TEST(MapWarnings, RoomInAnother) {
  core::FloorPlan plan = two_rooms();
  plan.rooms[1].polygon[0].x() = plan.rooms[1].polygon[3].x() = 1.5;
  EXPECT_THAT(warnings_of(plan), ElementsAre(AllOf(HasSubstr("room 1, \"east\", lies to 35 %"),
                                                   HasSubstr("room 0, \"west\","))));
}

TEST(MapWarnings, RoomWithinALaterOne_IsRight_WithinAnEarlierOneIsNot) {
  core::FloorPlan plan = two_rooms();
  plan.rooms[0].polygon = {{3.5, 1.6}, {5, 1.6}, {5, 2.8}, {3.5, 2.8}};
  EXPECT_THAT(warnings_of(plan), IsEmpty());
  std::swap(plan.rooms[0], plan.rooms[1]);
  EXPECT_THAT(warnings_of(plan), ElementsAre(HasSubstr("room 1, \"west\", lies to 100 %")));
}

TEST(MapWarnings, RoomBeyondTheWalls) {
  core::FloorPlan plan = two_rooms();
  plan.rooms[1].polygon[2].y() = plan.rooms[1].polygon[3].y() = 5.05;
  EXPECT_THAT(warnings_of(plan), ElementsAre(HasSubstr("reaches 2.0 m beyond all walls")));
}

TEST(MapWarnings, CentreInFurniture) {
  core::FloorPlan plan = two_rooms();
  plan.walls.push_back({{1, 1.5}, {2, 1.5}, 0.8});
  EXPECT_THAT(warnings_of(plan),
              ElementsAre(AllOf(HasSubstr("\"west\","), HasSubstr("inside a wall or furniture"))));
}

TEST(MapWarnings, Check_PrintsThem_AndTheNumberOfThoseThatItDoesNot) {
  const test::TemporaryFolder folder;
  const std::string map = (folder / "map.json").string();
  std::ofstream file(map);
  file << R"({"format": "cornerd-map", "version": 1, "walls": [)";
  for (int i = 0; i < 15; ++i) file << R"({"from": [0, 0], "to": [4, 0], "thickness": 0.1},)";
  file << R"({"from": [4, 0], "to": [4, 3]}]})";
  file.close();
  const CommandRun run({"map", "check", map, "--places", "0"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("warning  wall 1 from (0.000, 0.000) to (4.000, 0.000) is a "
                                 "duplicate of wall 0: remove one\n"));
  EXPECT_THAT(run.out, HasSubstr("warning  and 2 more\n"));
}

}  // namespace
}  // namespace cornerd::tool
