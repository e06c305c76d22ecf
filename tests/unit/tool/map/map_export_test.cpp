// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "command_run.hpp"
#include "gridmap/image.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

class MapExportTest : public ::testing::Test {
 protected:
  MapExportTest() {
    std::ofstream(file("room.json")) << R"({"format": "cornerd-map", "version": 1, "thickness": 0.1,
      "walls": [{"from": [0, 0], "to": [3, 0]}, {"from": [3, 0], "to": [3, 2]},
                {"from": [3, 2], "to": [0, 2]}, {"from": [0, 2], "to": [0, 0]},
                {"from": [1, 0.9], "to": [2, 1.1], "thickness": 0}]})";
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(file(name), std::ios::binary).rdbuf();
    return text.str();
  }
  test::TemporaryFolder folder_;
};

TEST_F(MapExportTest, Room_IsFreeInsideAndUnknownOutside) {
  const CommandRun run({"map", "export", file("room.json"), "-o", file("room.yaml")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(content("room.yaml"),
            "image: room.pgm\nresolution: 0.05\norigin: [-0.55, -0.55, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const gridmap::Image image = gridmap::decode_image(content("room.pgm"));
  ASSERT_EQ(image.width, 82u);
  ASSERT_EQ(image.height, 62u);
  const auto shade_at = [&](double x_m, double y_m) {
    const auto column = static_cast<std::size_t>((x_m + 0.55) / 0.05);
    const auto row = static_cast<std::size_t>((y_m + 0.55) / 0.05);
    return image.shades[(image.height - 1 - row) * image.width + column];
  };
  EXPECT_EQ(shade_at(0.51, 0.51), 254);
  EXPECT_EQ(shade_at(-0.41, 1), 205);
  EXPECT_EQ(shade_at(0.01, 1), 0);
  EXPECT_EQ(shade_at(1.51, 1.01), 0);
}

TEST_F(MapExportTest, TooManyCells_AreRefusedBeforeAnythingIsWritten) {
  const CommandRun run(
      {"map", "export", file("room.json"), "--resolution", "0.0001", "-o", file("room.yaml")});
  EXPECT_EQ(run.exit_code, 2);
  std::ofstream(file("long.json")) << R"({"format": "cornerd-map", "version": 1,
      "walls": [{"from": [0, 0], "to": [9000, 9000]}]})";
  const CommandRun large({"map", "export", file("long.json"), "-o", file("room.yaml")});
  EXPECT_EQ(large.exit_code, 1);
  EXPECT_NE(large.err.find("--resolution"), std::string::npos) << large.err;
  EXPECT_FALSE(std::filesystem::exists(file("room.yaml")));
  EXPECT_FALSE(std::filesystem::exists(file("room.pgm")));
}

TEST_F(MapExportTest, OutputThatIsNoYaml_IsWrongUsage) {
  EXPECT_EQ(CommandRun({"map", "export", file("room.json"), "-o", file("room.pgm")}).exit_code, 2);
}

}  // namespace
}  // namespace cornerd::tool
