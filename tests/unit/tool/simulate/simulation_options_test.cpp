// SPDX-License-Identifier: MIT
// What simulate and emulate have in common, as their users meet it.
#include "tool/simulate/simulation_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SimulationOptionsTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  CommandRun simulate(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"simulate", "--map", map_,     "-o",       path("x.bin"),
                                      "--scans",  "2",     "--pose", "0.3,0.5,1"};
    words.insert(words.end(), more.begin(), more.end());
    return CommandRun(words);
  }

  const std::string map_ = CORNERD_SOURCE_DIR "/config/maps/krpai-2019-a.json";
  test::TemporaryFolder folder_;
};

TEST_F(SimulationOptionsTest, InvalidNumber_IsWrongUsage) {
  for (const char* option :
       {"--sigma-floor", "--sigma-share", "--bearing-noise", "--missing", "--missing-run",
        "--outliers", "--beam", "--backward", "--motor", "--drive-speed", "--rotation-speed",
        "--map-error", "--end-error", "--clutter", "--fov"}) {
    for (const char* value : {"nan", "inf", "-inf", "-1", "much", ""}) {
      const CommandRun run = simulate({std::string(option) + "=" + value});
      EXPECT_EQ(run.exit_code, kExitUsage) << option << ' ' << value;
      EXPECT_NE(run.err, "");
      EXPECT_FALSE(std::filesystem::exists(path("x.bin")));
    }
  }
  for (const char* word :
       {"--map-error=0.6", "--end-error=0.6", "--clutter=0.7", "--fov=19", "--fov=361"}) {
    EXPECT_EQ(simulate({word}).exit_code, kExitUsage) << word;
  }
  for (const char* option : {"--scans", "--scans-each", "--seed"}) {
    for (const char* value : {"nan", "inf", "1e99"}) {
      EXPECT_EQ(simulate({option, value}).exit_code, kExitUsage) << option << ' ' << value;
    }
  }
  EXPECT_EQ(CommandRun({"emulate", "--map", map_, "--spin-up", "nan"}).exit_code, kExitUsage);
  EXPECT_EQ(CommandRun({"emulate", "--map", map_, "--places", "-1"}).exit_code, kExitUsage);
}

TEST_F(SimulationOptionsTest, UnknownOption_IsNamedAlsoWhereARequiredOneIsMissing) {
  const CommandRun misspelt({"simulate", "--map", map_, "--ouput", "a.bin"});
  EXPECT_EQ(misspelt.exit_code, kExitUsage);
  EXPECT_THAT(misspelt.err, testing::HasSubstr("--ouput"));
  EXPECT_THAT(CommandRun({"simulate", "--map", map_}).err,
              testing::HasSubstr("--output is required"));
  EXPECT_EQ(CommandRun({"emulate", "--map", map_, "--covered", "3,9"}).exit_code, kExitUsage);
}

TEST_F(SimulationOptionsTest, TruthOverRecording_IsWrongUsage) {
  for (const std::string& same : {path("x.bin"), path("./x.bin"), path("a/../x.bin")}) {
    const CommandRun run = simulate({"--truth", same});
    EXPECT_EQ(run.exit_code, kExitUsage) << same;
    EXPECT_THAT(run.err, HasSubstr("named for two outputs"));
    EXPECT_FALSE(std::filesystem::exists(path("x.bin")));
  }
  EXPECT_EQ(simulate({"--truth", path("truth")}).exit_code, kExitDone);
}

TEST_F(SimulationOptionsTest, PoseOutsideBuilding_IsWarnedAboutAndSimulated) {
  EXPECT_THAT(simulate({}).err, Not(HasSubstr("warning")));
  const std::vector<std::string> words = {"simulate",       "--map",   map_, "-o",
                                          path("x.ndjson"), "--scans", "1"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return CommandRun(more);
  };
  const CommandRun outside = with({"--pose", "7.5,1,0"});
  EXPECT_EQ(outside.exit_code, kExitDone);
  EXPECT_THAT(outside.err, HasSubstr("warning: 7.5,1 is outside the walls"));
  EXPECT_THAT(with({"--pose", "0,1,0"}).err, HasSubstr("warning: 0,1 is inside a wall"));
  EXPECT_THAT(with({"--path", "0.3,0.5 9,9"}).err,
              AllOf(HasSubstr("warning: 9,9"), HasSubstr("through a wall")));
}

TEST_F(SimulationOptionsTest, PathWithoutScans_IsDrivenOnce) {
  // 3 m at 0.5 m/s and 7.3 Hz: 44 scans.
  const CommandRun run({"simulate", "--map", CORNERD_SOURCE_DIR "/config/maps/flat-7.json",
                        "--path", "1,4 4,4", "--drive-speed", "0.5", "-o", path("path.bin")});
  EXPECT_EQ(run.exit_code, kExitDone);
  EXPECT_THAT(run.err, HasSubstr(": 44 scans in "));
}

TEST_F(SimulationOptionsTest, PlaceWithMapErrorAndClutter_IsTheSameForTheSeed) {
  const auto record = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "simulate", "--map",   CORNERD_SOURCE_DIR "/config/maps/flat-7.json", "--path", "1,4 4,4",
        "-o",       path(name)};
    words.insert(words.end(), more.begin(), more.end());
    const CommandRun run(words);
    EXPECT_EQ(run.exit_code, kExitDone) << run.err;
    std::ostringstream bytes;
    bytes << std::ifstream(path(name)).rdbuf();
    return std::pair(run.err, bytes.str());
  };
  const std::vector<std::string> all = {"--map-error", "0.03", "--clutter", "0.3", "--fov", "120"};
  const auto [text, bytes] = record("a.bin", all);
  EXPECT_THAT(text, HasSubstr("unmapped obstacles stop 3"));
  EXPECT_THAT(text, testing::ContainsRegex(", 3[0-9] % of them with a return"));
  EXPECT_EQ(record("b.bin", all).second, bytes);
  const std::string plain = record("c.bin", {}).second;
  for (const auto& one : {std::vector<std::string>{"--map-error", "0.03"},
                          {"--end-error", "0.03"},
                          {"--clutter", "0.3"},
                          {"--fov", "120"}}) {
    EXPECT_NE(record("d.bin", one).second, plain) << one[0];
  }
  EXPECT_EQ(
      record("e.bin", {"--map-error", "0", "--end-error", "0", "--clutter", "0", "--fov", "360"})
          .second,
      plain);
}

TEST_F(SimulationOptionsTest, ClutterWithoutRoom_FailsWithTheShareReached) {
  std::ofstream(path("cell.json")) << R"({"format": "cornerd-map", "version": 1, "thickness": 0.02,
    "walls": [{"from": [0, 0], "to": [0.5, 0]}, {"from": [0.5, 0], "to": [0.5, 0.5]},
              {"from": [0.5, 0.5], "to": [0, 0.5]}, {"from": [0, 0.5], "to": [0, 0]}]})";
  const CommandRun run({"simulate", "--map", path("cell.json"), "--pose", "0.25,0.25,0",
                        "--clutter", "0.6", "-o", path("x.bin")});
  EXPECT_EQ(run.exit_code, kExitFailed);
  EXPECT_THAT(run.err, HasSubstr("of the rays, not 60 %"));
  EXPECT_FALSE(std::filesystem::exists(path("x.bin")));
}

TEST_F(SimulationOptionsTest, ClutterInRecording_IsWrongUsage) {
  ASSERT_EQ(simulate({}).exit_code, kExitDone);
  const CommandRun run({"emulate", path("x.bin"), "--clutter", "0.2"});
  EXPECT_EQ(run.exit_code, kExitUsage);
  EXPECT_THAT(run.err, HasSubstr("--clutter: not available for a recording"));
}

TEST_F(SimulationOptionsTest, NoiseFile_IsUsedOrErrorIsNamed) {
  std::ofstream(path("noise.json")) << R"({"lidar": {"noise": {"floor": 0.02, "share": 0}}})";
  std::ofstream(path("wrong.json")) << R"({"lidar": {"noise": {"floor": "much"}}})";
  std::ofstream(path("other.json")) << R"({"lidar": {"device": "/dev/ttyS1"}})";
  EXPECT_EQ(simulate({"--noise", path("noise.json")}).exit_code, kExitDone);
  EXPECT_EQ(simulate({"--noise", path("absent.json")}).exit_code, kExitConfig);
  const CommandRun wrong = simulate({"--noise", path("wrong.json")});
  EXPECT_EQ(wrong.exit_code, kExitConfig);
  EXPECT_THAT(wrong.err, HasSubstr("wrong.json: /lidar/noise/floor: must be a number"));
  EXPECT_THAT(simulate({"--noise", path("other.json")}).err, HasSubstr("/lidar/noise: is missing"));
}

TEST_F(SimulationOptionsTest, RealModel_IsOverriddenByOtherOptions) {
  SensorOptions options;
  options.real = true;
  EXPECT_GT(options.model({}).missing, 0.3);
  EXPECT_GT(options.model({}).missing_run, 2);
  EXPECT_GT(options.model({}).beam_width_rad, 0);
  EXPECT_GT(options.model({}).backward, 0);
  options.missing = 0.1;
  options.bearing_deg = 0;
  EXPECT_EQ(options.model({}).missing, 0.1);
  EXPECT_EQ(options.model({}).noise.bearing_rad, 0);
  EXPECT_GT(options.model({}).missing_run, 2);
}

TEST_F(SimulationOptionsTest, CommandLine_OverridesSensorModel) {
  std::ofstream(path("noise.json"))
      << R"({"lidar": {"noise": {"floor": 0.02, "ranges": [{"range": 1, "sigma": 0.3}]}}})";
  SensorOptions options;
  settings::NoiseConfig configured;
  configured.sensor.floor_m = 0.01;
  EXPECT_EQ(options.model(configured).noise.floor_m, 0.01);
  options.noise = path("noise.json");
  EXPECT_NEAR(options.model(configured).noise.sigma_range_m(1), 0.3, 1e-6);
  options.share = 0.05;
  EXPECT_EQ(options.model(configured).noise.sigma_range_m(1), 0.05);
  EXPECT_EQ(options.model(configured).noise.sigma_range_m(0.1), 0.02);
  options.beam_deg = 180 / core::kPi;
  options.missing = 0.4;
  options.missing_run = 5;
  options.outliers = 0.1;
  options.backward = 0.02;
  const replay::SensorModel model = options.model(configured);
  EXPECT_NEAR(model.beam_width_rad, 1, 1e-12);
  EXPECT_EQ(model.missing, 0.4);
  EXPECT_EQ(model.missing_run, 5);
  EXPECT_EQ(model.outliers, 0.1);
  EXPECT_EQ(model.backward, 0.02);
}

}  // namespace
}  // namespace cornerd::tool
