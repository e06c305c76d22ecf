// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>

#include <nlohmann/json.hpp>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {
namespace {

constexpr const char* kMillimetres = R"({"format": "cornerd-map", "version": 1, "name": "hall",
  "walls": [{"from": [0, 0], "to": [4000, 0], "thickness": 100, "sigma": 0.02}],
  "rooms": [{"name": "one", "polygon": [[0, 0], [40000, 0], [0, 3000]]}]})";

TEST(MapScale, DrawingInMillimetres_BecomesOneInMetres) {
  const test::TemporaryFolder folder;
  const std::string map = (folder / "mm.json").string();
  std::ofstream(map) << kMillimetres;
  const CommandRun run({"map", "scale", map, "--factor", "0.001", "-o", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json scaled = nlohmann::json::parse(run.out);
  EXPECT_EQ(scaled["name"], "hall");
  EXPECT_EQ(scaled["walls"][0]["to"][0], 4);
  EXPECT_EQ(scaled["walls"][0]["thickness"], 0.1);
  EXPECT_EQ(scaled["walls"][0]["sigma"], 0.02);
  EXPECT_EQ(scaled["rooms"][0]["polygon"][2][1], 3);
}

TEST(MapScale, TwoFactors_AreOfXAndY) {
  const test::TemporaryFolder folder;
  const std::string map = (folder / "mm.json").string();
  std::ofstream(map) << kMillimetres;
  const CommandRun run({"map", "scale", "--factor", "0.001,0.004", map, "-o", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json scaled = nlohmann::json::parse(run.out);
  EXPECT_EQ(scaled["walls"][0]["to"][0], 4);
  EXPECT_EQ(scaled["walls"][0]["thickness"], 0.2);
  EXPECT_EQ(scaled["rooms"][0]["polygon"][2][1], 12);
}

TEST(MapScale, OverItself_IsWrongUsage) {
  const test::TemporaryFolder folder;
  const std::string map = (folder / "mm.json").string();
  std::ofstream(map) << kMillimetres;
  EXPECT_EQ(CommandRun({"map", "scale", map, "--factor", "2", "-o", map}).exit_code, 2);
  EXPECT_EQ(CommandRun({"map", "scale", map, "--factor", "0", "-o", "-"}).exit_code, 2);
  EXPECT_EQ(CommandRun({"map", "scale", map, "--factor", "1,2,3", "-o", "-"}).exit_code, 2);
}

}  // namespace
}  // namespace cornerd::tool
