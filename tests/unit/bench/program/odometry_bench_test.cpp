// SPDX-License-Identifier: MIT
// cornerd-bench --odometry as its users call it.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "bench/program/cornerd_bench.hpp"
#include "tests/program_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/tool/xml_check.hpp"

namespace cornerd::bench {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(BenchOdometry, AllDrives_HaveEachModeAndDrawings) {
  const test::TemporaryFolder folder;
  const std::filesystem::path plots = folder.path() / "plots";
  const std::filesystem::path json = folder.path() / "odometry.json";
  const test::ProgramRun outcome(
      "cornerd-bench", run_cornerd_bench,
      {"--maps", CORNERD_SOURCE_DIR "/config/maps", "--odometry", "--positions", "0", "--plots",
       plots.string(), "--json", json.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("weighted (eq. 5)"));
  const auto figures = nlohmann::json::parse(text_of(json));
  ASSERT_EQ(figures["odometry"].size(), 6U);
  for (const auto& drive : figures["odometry"]) EXPECT_EQ(drive["tracks"].size(), 13U);
  for (const char* file :
       {"pioneer-circuit-1.svg", "contest-exploration-factors.svg",
        "contest-circuit-2-no-dead-band.svg", "pioneer-exploration-factors-no-dead-band.svg"}) {
    EXPECT_EQ(tool::find_xml_error(text_of(plots / file)), "");
  }
}

TEST(BenchOdometry, RandomRobots_AreCountedByFault) {
  const test::ProgramRun outcome("cornerd-bench", run_cornerd_bench,
                                 {"--maps", CORNERD_SOURCE_DIR "/config/maps", "--odometry",
                                  "--robots", "2", "--seed", "5", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto robots = nlohmann::json::parse(outcome.out)["robots"];
  ASSERT_EQ(robots.size(), 2U);
  EXPECT_EQ(robots[0]["fault"], "none");
  EXPECT_GT(robots[0]["named"], 500);
}

}  // namespace
}  // namespace cornerd::bench
