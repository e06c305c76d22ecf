// SPDX-License-Identifier: MIT
// Simulated drives with wheels and a gyro, from the recording to the pose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <utility>

#include <nlohmann/json.hpp>

#include "odometry_command.hpp"

namespace cornerd::tool {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++found;
  }
  return found;
}

TEST_F(OdometryCommandTest, CoveredLidar_IsDeadReckoned) {
  ASSERT_EQ(simulate({"--covered", "15,17"}).exit_code, 0);
  const CommandRun without = replay({});
  EXPECT_EQ(count(without.out, "\"state\":\"predicted\""), 0U);
  EXPECT_EQ(count(without.out, "\"odometry\""), 0U);
  const CommandRun with = replay({"--set", "/odometry/source=socket"});
  EXPECT_NEAR(static_cast<double>(count(with.out, "\"state\":\"predicted\"")), 15, 2);
  EXPECT_EQ(count(with.out, "\"state\":\"lost\""), 0U);
  EXPECT_NE(with.err.find("wrong            0"), std::string::npos) << with.err;
  EXPECT_NE(with.out.find("\"odometry\":{\"state\":\"running\""), std::string::npos);
}

TEST_F(OdometryCommandTest, StatusAlone_ShowsCalibration) {
  ASSERT_EQ(simulate({"--wheel-errors", "0.015,0.025"}).exit_code, 0);
  const std::vector<std::string> words = {"replay", recording_, "--set", "/odometry/source=socket",
                                          "--classes"};
  const auto odometry_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    const std::string out = CommandRun(all).out;
    const std::size_t last = out.rfind("{\"class\":\"STATUS\"");
    return last == std::string::npos ? json() : json::parse(out.substr(last))["odometry"];
  };
  const json alone = odometry_of({"STATUS", "--map", map_});
  EXPECT_NEAR(alone["left_scale"].get<double>(), 0.015, 0.004);
  EXPECT_EQ(alone, odometry_of({"POSE,STATUS", "--map", map_}));
  EXPECT_FALSE(alone.contains("hint"));
  EXPECT_THAT(odometry_of({"STATUS"})["hint"].get<std::string>(), HasSubstr("--map"));
}

TEST_F(OdometryCommandTest, LinesWithoutOneWheel_GiveHint) {
  ASSERT_EQ(simulate({}).exit_code, 0);
  const std::string wrong = folder_ / "wrong.ndjson";
  rewrite(wrong, [](json& line) { line.erase("left"); });
  const CommandRun run({"replay", wrong, "--map", map_, "--set", "/odometry/source=socket"});
  EXPECT_THAT(run.out,
              HasSubstr(R"("odometry":{"state":"absent","hint":"ODOMETRY lines lack left: )"));
}

TEST_F(OdometryCommandTest, Faults_AreNamedAsByTheDaemon) {
  ASSERT_EQ(simulate({}, "200").exit_code, 0);
  const auto last_status = [&](const std::string& file, const std::string& map) {
    const std::string out =
        CommandRun({"replay", file, "--map", map, "--set", "/odometry/source=socket"}).out;
    return json::parse(out.substr(out.rfind("{\"class\":\"STATUS\"")));
  };
  const std::string wrong = folder_ / "wrong.ndjson";
  rewrite(wrong, [](json& line) { line["left"] = "many"; });
  const json refused = last_status(wrong, map_);
  EXPECT_EQ(refused["faults"], json({"odometry-refused"}));
  EXPECT_THAT(refused["odometry"]["hint"].get<std::string>(), HasSubstr("\"left\""));

  const std::string mirrored = folder_ / "mirrored.json";
  json map = json::parse(std::ifstream(map_), nullptr, true, /*ignore_comments=*/true);
  for (json& wall : map["walls"]) {
    for (const char* end : {"from", "to"}) wall[end][0] = -wall[end][0].get<double>();
  }
  map.erase("rooms");
  std::ofstream(mirrored) << map;
  EXPECT_EQ(last_status(recording_, mirrored)["faults"][0], "map-mirrored");
  const CommandRun alone({"replay", recording_, "--map", mirrored, "--classes", "STATUS"});
  EXPECT_THAT(alone.out, HasSubstr("\"faults\":[\"map-mirrored\"]"));
}

TEST_F(OdometryCommandTest, OdometryFile_OverridesRecording) {
  ASSERT_EQ(simulate({"--covered", "15,17"}).exit_code, 0);
  const std::string same = replay({"--set", "/odometry/source=socket"}).out;
  // In a recording a reading stands where it arrived, in a file of its own by its time.
  EXPECT_EQ(count(replay({"--odometry", recording_}).out, "\"state\":\"predicted\""),
            count(same, "\"state\":\"predicted\""));
  const std::string nothing = (folder_.path() / "none.ndjson").string();
  std::ofstream(nothing) << "{\"t\":0,\"x\":0,\"y\":0,\"theta\":0}\n{\"class\":\"POSE\"}\n";
  EXPECT_EQ(replay({"--odometry", nothing}).exit_code, 1);
}

TEST_F(OdometryCommandTest, Readings_AreOrderedByTime) {
  ASSERT_EQ(simulate({"--no-gyro", "--odometry-rate", "100"}).exit_code, 0);
  std::ifstream stream(recording_);
  double last_s = -1;
  std::size_t readings = 0;
  for (std::string text; std::getline(stream, text);) {
    const json line = json::parse(text);
    EXPECT_GE(line["t"].get<double>(), last_s);
    last_s = line["t"];
    if (line["class"] != "ODOMETRY") continue;
    ++readings;
    EXPECT_FALSE(line.contains("gyro"));
  }
  EXPECT_NEAR(static_cast<double>(readings), 100 * last_s, 3);
}

TEST_F(OdometryCommandTest, CalibrateWithoutOdometry_Fails) {
  const CommandRun simulated({"simulate", "--map", map_, "--pose", "1.6,2,0", "-o", recording_});
  ASSERT_EQ(simulated.exit_code, 0);
  const CommandRun run({"calibrate", "odometry", recording_, "--map", map_});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no odometry"), std::string::npos);
}

TEST_F(OdometryCommandTest, WrongUsage_IsNamed) {
  EXPECT_EQ(simulate({"--wheel-errors", "1"}).exit_code, 2);
  EXPECT_EQ(simulate({"--wheel-errors", "0.9,0"}).exit_code, 2);
  EXPECT_EQ(simulate({"--wheel-errors", "nan,0"}).exit_code, 2);
  EXPECT_EQ(simulate({"--covered", "5,4"}).exit_code, 2);
  EXPECT_EQ(simulate({"--gyro-bias", "nan"}).exit_code, 2);
  EXPECT_EQ(simulate({"--path", "1,1 2,1"}).exit_code, 2);
  const std::string bytes = (folder_.path() / "x.bin").string();
  EXPECT_EQ(CommandRun({"simulate", "--map", map_, "--pose", "1,1,0", "--odometry", "-o", bytes})
                .exit_code,
            2);
  EXPECT_EQ(CommandRun({"simulate", "--map", map_, "--places", "3", "--odometry", "-o", recording_})
                .exit_code,
            2);
}

}  // namespace
}  // namespace cornerd::tool
