// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "command_run.hpp"
#include "gridmap/map_server_yaml.hpp"
#include "settings/map_file.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/command_line/failure.hpp"
#include "xml_check.hpp"

namespace cornerd::tool {
namespace {

using testing::HasSubstr;

/// A room of 1.2 x 0.8 m within walls of one cell, a table of 0.2 x 0.1 m and a speck.
std::string room_pgm() {
  std::string text = "P2\n14 10\n255\n";
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 14; ++column) {
      const bool wall = row == 0 || row == 9 || column == 0 || column == 13;
      const bool table = row == 4 && (column == 4 || column == 5 || column == 6);
      const bool speck = row == 7 && column == 10;
      text += wall || table || speck ? "0 " : "254 ";
    }
    text += "\n";
  }
  return text;
}

class MapImport : public testing::Test {
 protected:
  MapImport() {
    write("room.pgm", room_pgm());
    write("room.yaml", yaml("room.pgm"));
  }
  void SetUp() override {
    if (!gridmap::has_yaml()) GTEST_SKIP() << "built without libyaml-cpp";
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  static std::string yaml(const std::string& image) {
    return "image: " + image +
           "\nresolution: 0.1\norigin: [10, 20, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
           "free_thresh: 0.196\nmade_with: care\n";
  }
  CommandRun import(const std::string& yaml_name) const {
    return CommandRun({"map", "import", path(yaml_name), "-o", path("room.json")});
  }

  test::TemporaryFolder folder_;
};

TEST_F(MapImport, RosMap_BecomesValidMap) {
  const CommandRun run({"map", "import", path("room.yaml"), "-o", path("room.json"), "--name",
                        "my room", "--plot", path("room.svg")});
  EXPECT_EQ(run.exit_code, kExitDone) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("made by      drawing"));
  EXPECT_THAT(run.out, HasSubstr("1 specks of occupied cells, the largest 0.10 m at 11.05,20.25"));
  EXPECT_THAT(run.out, HasSubstr("ignored      the key made_with"));

  const auto map = settings::load_map(path("room.json"));
  EXPECT_EQ(map->plan().name, "my room");
  EXPECT_NEAR(map->range_along({11, 20.2}, 0, 12), 0.3, 1e-6);
  EXPECT_NEAR(map->range_along({10.55, 20.2}, core::kPi / 2, 12), 0.3, 0.025);
  EXPECT_EQ(CommandRun({"map", "check", path("room.json"), "--places", "0"}).exit_code, kExitDone);

  std::ostringstream picture;
  picture << std::ifstream(path("room.svg")).rdbuf();
  EXPECT_EQ(find_xml_error(picture.str()), "");
}

TEST_F(MapImport, WrongInput_IsNamedByFileAndKey) {
  write("no-image.yaml", yaml("absent.pgm"));
  write("itself.yaml", yaml("itself.yaml"));
  write("short.yaml", "image: room.pgm\n");
  const auto expect = [&](const std::string& name, const std::string& text) {
    const CommandRun run = import(name);
    EXPECT_EQ(run.exit_code, kExitConfig);
    EXPECT_THAT(run.err, HasSubstr(text));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
    EXPECT_FALSE(std::filesystem::exists(path("room.json")));
  };
  write("large.pgm", "P5\n300 300\n255\n" + std::string(90'000, '\xfe'));
  expect("large.pgm", "name the yaml, not the picture");
  expect("no-image.yaml", "no-image.yaml: /image: ");
  expect("itself.yaml", "itself.yaml: is neither PGM");
  expect("short.yaml", "short.yaml: /resolution: is missing");
  expect("absent.yaml", "absent.yaml: ");
}

TEST_F(MapImport, ImageWithoutWalls_Fails) {
  write("room.pgm", "P2\n2 1\n255\n254 254\n");
  const CommandRun run = import("room.yaml");
  EXPECT_EQ(run.exit_code, kExitFailed);
  EXPECT_THAT(run.err, HasSubstr("no border"));
}

TEST_F(MapImport, WrongUsage_ExitCode2) {
  const std::string map = path("room.json");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--speck", "nan"}, {"--made-by", "magic"}, {"--gap", "-1"}}) {
    std::vector<std::string> words = {"map", "import", path("room.yaml"), "-o", map};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(CommandRun(words).exit_code, kExitUsage) << more[0];
  }
  EXPECT_EQ(CommandRun({"map", "import", path("room.yaml")}).exit_code, kExitUsage);
}

TEST_F(MapImport, InvalidMap_IsNotWritten) {
  const CommandRun run({"map", "import", path("room.yaml"), "-o", path("room.json"), "--name",
                        std::string(200, 'x')});
  EXPECT_EQ(run.exit_code, kExitFailed);
  EXPECT_THAT(run.err, HasSubstr("/name: "));
  EXPECT_FALSE(std::filesystem::exists(path("room.json")));
}

TEST_F(MapImport, MapOnStandardOutput_ReportOnStandardError) {
  const CommandRun run({"map", "import", path("room.yaml"), "-o", "-"});
  EXPECT_EQ(run.exit_code, kExitDone) << run.err;
  EXPECT_EQ(settings::parse_map(run.out, "map.json")->plan().name, "map");
  EXPECT_THAT(run.err, HasSubstr("made by      drawing"));
}

}  // namespace
}  // namespace cornerd::tool
