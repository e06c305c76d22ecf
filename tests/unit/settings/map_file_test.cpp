// SPDX-License-Identifier: MIT
#include "settings/map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::settings {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

std::string map_of(const std::string& rest) {
  return R"({"format": "cornerd-map", "version": 1, )" + rest + "}";
}

std::string map_error(const std::string& text) {
  return error_of([&text] { parse_floor_plan(text, "/m/a.json"); });
}

std::string wall_error(const std::string& wall) {
  return map_error(map_of("\"walls\": [" + wall + "]"));
}

constexpr const char* kWall = R"("walls": [{"from": [0, 0], "to": [1, 0]}])";

TEST(MapFile, Image_IsRefusedWithTheCommandThatImportsIt) {
  for (const char* image : {"\x89PNG\r\n", "P5\n2 2\n255\n", "<svg xmlns=\"\"/>"}) {
    EXPECT_THAT(map_error(image), HasSubstr("cornerctl map import"));
  }
}

TEST(MapFile, OpenEnds_AreTwoBooleans) {
  const auto error = [](const std::string& open) {
    return wall_error(R"({"from": [0, 0], "to": [1, 0], "open": )" + open + "}");
  };
  EXPECT_THAT(error("true"), HasSubstr("/walls/0/open: must be an array"));
  EXPECT_THAT(error("[true]"), HasSubstr("/walls/0/open: must have at least 2"));
  EXPECT_THAT(error("[true, false, true]"), HasSubstr("/walls/0/open: must have at most 2"));
  EXPECT_THAT(error("[true, 0]"), HasSubstr("/walls/0/open/1: must be true or false"));
}

TEST(MapFile, EveryField_ReachesThePlan) {
  const core::FloorPlan plan =
      parse_floor_plan(map_of(R"("name": "flat", "thickness": 0.018, "sigma": 0.03,
        "walls": [{"from": [0, 0], "to": [2.4, 0]},
                  {"from": [1.2, -1], "to": [1.2, 0.8], "thickness": 0, "open": [false, true]}],
        "rooms": [{"name": "room-1", "polygon": [[0, 0], [1, 0], [1, 1]]}])"),
                       "/m/a.json");
  EXPECT_EQ(plan.name, "flat");
  EXPECT_EQ(plan.thickness_m, 0.018);
  EXPECT_EQ(plan.sigma_m, 0.03);
  ASSERT_EQ(plan.walls.size(), 2u);
  EXPECT_EQ(plan.walls[0].to, core::Vec2(2.4, 0));
  EXPECT_EQ(plan.walls[0].thickness_m, 0.018);
  EXPECT_EQ(plan.walls[1].from, core::Vec2(1.2, -1));
  EXPECT_EQ(plan.walls[1].thickness_m, 0);
  EXPECT_EQ(plan.walls[0].is_open, (std::array<bool, 2>{false, false}));
  EXPECT_EQ(plan.walls[1].is_open, (std::array<bool, 2>{false, true}));
  ASSERT_EQ(plan.rooms.size(), 1u);
  EXPECT_EQ(plan.rooms[0].name, "room-1");
  EXPECT_EQ(plan.rooms[0].polygon[2], core::Vec2(1, 1));
}

TEST(MapFile, NameAndRooms_AreOptional) {
  const core::FloorPlan plan = parse_floor_plan(map_of(kWall), "/m/flat.json");
  EXPECT_EQ(plan.name, "flat");
  EXPECT_TRUE(plan.rooms.empty());
}

TEST(MapFile, OtherJson_IsRefused) {
  EXPECT_THAT(map_error("{}"), HasSubstr("/m/a.json: /format: must be \"cornerd-map\""));
  EXPECT_THAT(map_error(R"({"format": "other"})"), HasSubstr("/format"));
  EXPECT_THAT(map_error("[]"), EndsWith("must be an object"));
  EXPECT_THAT(map_error("solid cube"), HasSubstr("line 1, column 1"));
}

TEST(MapFile, AnotherVersion_IsRefused) {
  EXPECT_THAT(map_error(R"({"format": "cornerd-map"})"), EndsWith("/version: is missing"));
  EXPECT_THAT(map_error(R"({"format": "cornerd-map", "version": 2})"),
              HasSubstr("/version: is 2; this program reads version 1"));
}

TEST(MapFile, WithoutWalls_IsRefused) {
  EXPECT_THAT(map_error(map_of("\"name\": \"x\"")), EndsWith("/walls: is missing"));
  EXPECT_THAT(map_error(map_of("\"walls\": []")), EndsWith("/walls: must have at least 1 element"));
  EXPECT_THAT(map_error(map_of("\"walls\": {}")), EndsWith("/walls: must be an array"));
}

TEST(MapFile, WrongWall_IsNamedByItsIndex) {
  const std::string good = R"({"from": [0, 0], "to": [1, 0]}, )";
  EXPECT_THAT(wall_error(good + R"({"from": [0, 0]})"), EndsWith("/walls/1/to: is missing"));
  EXPECT_THAT(wall_error(good + R"({"from": [0], "to": [1, 0]})"),
              EndsWith("/walls/1/from: must be a point, [x, y] in metres"));
  EXPECT_THAT(wall_error(good + R"({"from": [0, "a"], "to": [1, 0]})"), HasSubstr("/walls/1/from"));
  EXPECT_THAT(wall_error(good + R"({"from": [0, 0], "to": [1e9, 0]})"),
              HasSubstr("/walls/1/to: coordinates must be from -10000 to 10000"));
  EXPECT_THAT(wall_error(good + "3"), EndsWith("/walls/1: must be an object"));
  EXPECT_THAT(wall_error(R"({"from": [0, 0], "to": [1, 0], "thickness": -1})"),
              HasSubstr("/walls/0/thickness"));
  EXPECT_THAT(wall_error(R"({"from": [0, 0], "to": [1, 0], "thicknes": 1})"),
              HasSubstr("/walls/0/thicknes: unknown key; did you mean \"thickness\"?"));
}

TEST(MapFile, WallWithoutLengthAndThickness_IsRefused) {
  EXPECT_THAT(wall_error(R"({"from": [1, 1], "to": [1, 1]})"),
              EndsWith("the wall has neither length nor thickness"));
  EXPECT_NO_THROW(parse_floor_plan(
      map_of(R"("walls": [{"from": [1, 1], "to": [1, 1], "thickness": 0.1}])"), "a.json"));
}

TEST(MapFile, WrongRoom_IsNamedByItsIndex) {
  const auto room_error = [](const std::string& room) {
    return map_error(map_of(std::string(kWall) + ", \"rooms\": [" + room + "]"));
  };
  EXPECT_THAT(room_error(R"({"name": "a", "polygon": [[0, 0], [1, 0]]})"),
              EndsWith("/rooms/0/polygon: must have at least 3 elements"));
  EXPECT_THAT(room_error(R"({"polygon": [[0, 0], [1, 0], [1, 1]]})"),
              EndsWith("/rooms/0/name: is missing"));
  EXPECT_THAT(room_error(R"({"name": "a", "polygon": [[0, 0], [1, 0], [1]]})"),
              HasSubstr("/rooms/0/polygon/2: must be a point"));
}

TEST(MapFile, FileOfAnotherKind_IsNamed) {
  EXPECT_THAT(map_error(" \n"), EndsWith("is empty"));
  EXPECT_THAT(map_error("P5\n1 1\n255\n"), HasSubstr("is an image"));
  EXPECT_THAT(map_error("<svg/>"), HasSubstr("is a drawing"));
  EXPECT_THAT(map_error("  0\r\nSECTION\r\n"), HasSubstr("is a drawing"));
  EXPECT_THAT(map_error("<!DOCTYPE html>"), HasSubstr("is a web page"));
  EXPECT_THAT(map_error("\x1f\x8b\b"), HasSubstr("is compressed"));
  EXPECT_THAT(map_error("\xff\xfe{"), HasSubstr("is UTF-16"));
  EXPECT_THAT(map_error(R"({"class":"SCAN"})"), HasSubstr("is a recording"));
  EXPECT_THAT(map_error("# saved\nimage: a.pgm\n"), HasSubstr("is the yaml of a ROS map"));
}

TEST(MapFile, Millimetres_AreNamed) {
  EXPECT_THAT(map_error(map_of(std::string(kWall) + R"(, "thickness": 120)")),
              EndsWith("/thickness: must be from 0 to 10 metres (`cornerctl map scale` converts "
                       "millimetres), not 120"));
}

TEST(MapFile, FanOfWallsWithoutEnd_IsRefusedInSeconds) {
  std::string walls;
  for (int i = 0; i < 16'000; ++i) {
    const std::string y = std::to_string(i * 1e-4);
    walls += (i == 0 ? "" : ",") + ("{\"from\":[0," + y + "],\"to\":[50,5" + y.substr(1) + "]}");
  }
  EXPECT_THAT(error_of([&] { parse_map(map_of("\"walls\":[" + walls + "]"), "a.json"); }),
              HasSubstr("/walls: too many walls cross each other"));
}

TEST(MapFile, SizeOfNoBuilding_IsAWarning) {
  EXPECT_EQ(size_warning(*parse_map(map_of(kWall), "a.json")), "");
  EXPECT_THAT(
      size_warning(*parse_map(map_of(R"("walls": [{"from": [0, 0], "to": [900, 0]}])"), "a.json")),
      HasSubstr("900 x 0 m"));
}

TEST(MapFile, ControlCharacterInName_IsRefused) {
  for (const char* name : {R"(a\u001b[2J)", R"(a\nb)", R"(\u007f)", R"(a\u009b2J)"}) {
    const std::string text = "\"name\": \"" + std::string(name) + "\"";
    EXPECT_THAT(map_error(map_of(std::string(kWall) + ", " + text)),
                EndsWith("/name: must not have control characters"));
    EXPECT_THAT(map_error(map_of(std::string(kWall) + ", \"rooms\": [{" + text +
                                 ", \"polygon\": [[0, 0], [1, 0], [1, 1]]}]")),
                EndsWith("/rooms/0/name: must not have control characters"));
  }
  EXPECT_EQ(
      parse_floor_plan(map_of(std::string(kWall) + R"(, "name": "Küche 台所")"), "a.json").name,
      "Küche 台所");
}

TEST(MapFile, ControlCharacterInFileName_IsReplaced) {
  EXPECT_EQ(parse_floor_plan(map_of(kWall), "a\x1b[2J\xc2\x9b.json").name, "a?[2J?");
}

TEST(MapFile, TooManyWalls_AreRefused) {
  std::string walls = "0";
  for (int i = 0; i < 100'000; ++i) walls += ",0";
  EXPECT_THAT(wall_error(walls), EndsWith("/walls: must have at most 100000 elements"));
}

TEST(LoadMap, FileOnDisk_BecomesAMap) {
  const test::TemporaryFolder folder;
  const auto file = folder / "map.json";
  std::ofstream(file) << map_of(
      R"("thickness": 0.02, "walls": [{"from": [0, 0], "to": [1, 0]}, {"from": [0, 0], "to": [0, 1]}])");
  const auto map = load_map(file);
  EXPECT_EQ(map->plan().walls.size(), 2u);
  EXPECT_FALSE(map->faces().empty());
}

TEST(LoadMap, AbsentFile_IsNamed) {
  EXPECT_EQ(error_of([] { load_map("/nowhere/a.json"); }),
            "/nowhere/a.json: cannot be opened: No such file or directory");
}

TEST(LoadMap, PipeDeviceOrFolder_ThrowsAtOnce) {
  const test::TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& file : {pipe, std::string("/dev/zero")}) {
    EXPECT_EQ(error_of([&] { load_map(file, FileKind::kOrdinary); }),
              file + ": is no ordinary file");
  }
  EXPECT_EQ(error_of([&] { load_map(folder.path(), FileKind::kOrdinary); }),
            folder.path().string() + ": is a folder");
}

TEST(LoadMap, PipeWithWriter_IsReadCompletely) {
  const test::TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::jthread writer([&pipe] { std::ofstream(pipe) << map_of(kWall); });
  EXPECT_EQ(load_map(pipe)->plan().walls.size(), 1u);
}

}  // namespace
}  // namespace cornerd::settings
