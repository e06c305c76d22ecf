// SPDX-License-Identifier: MIT
#include "settings/map_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "error_of.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::settings {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MapChoice : public testing::Test {
 protected:
  MapChoice() {
    for (const char* folder : {"maps/old", "maps2", "other"}) {
      fs::create_directories(folder_ / folder);
    }
    for (const char* file : {"maps/a.json", "maps/old/b.json", "maps2/c.json", "secret"}) {
      std::ofstream{folder_ / file} << "{}";
    }
    config_.map = folder_ / "maps/a.json";
  }

  fs::path canonical(const std::string& file) const { return fs::canonical(folder_ / file); }
  std::string error(const fs::path& file) const {
    return error_of([&] { map_in_folders(config_, file); });
  }

  test::TemporaryFolder folder_;
  Config config_;
};

TEST_F(MapChoice, FileBelowTheMapsFolder_Taken) {
  EXPECT_EQ(map_in_folders(config_, folder_ / "maps/a.json"), canonical("maps/a.json"));
  EXPECT_EQ(map_in_folders(config_, folder_ / "maps/old/b.json"), canonical("maps/old/b.json"));
  EXPECT_EQ(map_in_folders(config_, "old/../old/b.json"), canonical("maps/old/b.json"));
}

TEST_F(MapChoice, FileElsewhere_Refused) {
  fs::create_symlink(folder_ / "secret", folder_ / "maps/link.json");
  for (const char* file : {"../secret", "../maps2/c.json", "link.json", "/etc/passwd", ".."}) {
    EXPECT_THAT(error(file), HasSubstr("SET_MAP: /file: must be below")) << file;
  }
}

TEST_F(MapChoice, FolderOfAnotherMap_Allowed) {
  config_.maps = {{"c", folder_ / "maps2/c.json"}};
  EXPECT_EQ(map_in_folders(config_, folder_ / "maps2/c.json"), canonical("maps2/c.json"));
  EXPECT_THAT(error(folder_ / "other/d.json"), HasSubstr("must be below"));
}

TEST_F(MapChoice, Name_OneOfTheConfigs) {
  EXPECT_THAT(error_of([&] { map_named(config_, "c"); }), HasSubstr("has no \"maps\""));
  config_.maps = {{"c", "/m/c.json"}, {"d", "/m/d.json"}};
  EXPECT_EQ(map_named(config_, "d"), "/m/d.json");
  EXPECT_THAT(error_of([&] { map_named(config_, "e"); }), HasSubstr("they are: auto, c, d"));
}

constexpr const char* kTwoFloors =
    R"("maps": [{"name": "ground", "file": "g.json"}, {"name": "first", "file": "/m/f.json"}]})";

TEST(Maps, MapIsAName_ItsFileIsTheMap) {
  const Config config =
      parse_config(R"({"map": "first", )" + std::string(kTwoFloors), "/etc/c.json");
  EXPECT_EQ(config.map, "/m/f.json");
  EXPECT_EQ(config.map_name, "first");
  ASSERT_EQ(config.maps.size(), 2u);
  EXPECT_EQ(config.maps[0].file, "/etc/g.json");
  EXPECT_EQ(map_named(config, "ground"), "/etc/g.json");
}

TEST(Maps, MapIsNoName_RefusedWithNames) {
  const std::string error = error_of(
      [] { parse_config(R"({"map": "cellar", )" + std::string(kTwoFloors), "/etc/c.json"); });
  EXPECT_NE(error.find("ground, first"), std::string::npos) << error;
}

TEST(Maps, Auto_TheScansChoose) {
  const Config config =
      parse_config(R"({"map": "auto", )" + std::string(kTwoFloors), "/etc/c.json");
  EXPECT_TRUE(config.chooses_map());
  EXPECT_EQ(config.map, "/etc/g.json");
  EXPECT_EQ(map_named(config, "auto"), "/etc/g.json");
  const std::string error = error_of([] {
    parse_config(R"({"map": "auto", "maps": [{"name": "auto", "file": "a"}]})", "/etc/c.json");
  });
  EXPECT_NE(error.find("/maps/0"), std::string::npos) << error;
}

TEST(Maps, TwoOfOneName_Refused) {
  const std::string error = error_of([] {
    parse_config(
        R"({"map": "a", "maps": [{"name": "a", "file": "a"}, {"name": "a", "file": "b"}]})",
        "/etc/c.json");
  });
  EXPECT_NE(error.find("/maps/1"), std::string::npos) << error;
}

TEST_F(MapChoice, OneFileTwice_IsNamed) {
  config_.maps = {{"ground", folder_ / "maps/a.json"}, {"first", folder_ / "maps2/c.json"}};
  EXPECT_EQ(equal_maps_warning(config_), "");
  config_.maps.push_back({"second", folder_ / "maps/../maps/a.json"});
  EXPECT_THAT(equal_maps_warning(config_), HasSubstr("\"ground\" and \"second\" are one file"));
  config_.maps = {{"a", folder_ / "none.json"}, {"b", folder_ / "none.json"}};
  EXPECT_EQ(equal_maps_warning(config_), "") << "that it is absent is said elsewhere";
}

}  // namespace
}  // namespace cornerd::settings
