// SPDX-License-Identifier: MIT
// What calibrate odometry makes of simulated drives.
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
using CalibrateOdometry = OdometryCommandTest;

TEST_F(CalibrateOdometry, GoodDrive_WritesConfigForReplay) {
  ASSERT_EQ(
      simulate({"--wheel-errors", "0.015,0.025", "--gyro-error", "0.02", "--gyro-bias", "0.01"},
               "300")
          .exit_code,
      0);
  const std::string output = (folder_.path() / "odometry.json").string();
  const CommandRun run({"calibrate", "odometry", recording_, "--map", map_, "-o", output});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("least squares"), std::string::npos);
  EXPECT_NE(run.out.find("weighted"), std::string::npos);
  std::ifstream stream(output);
  const json start = json::parse(stream)["advanced"]["odometry"]["initial"];
  EXPECT_NEAR(start["left_scale"].get<double>(), 0.015, 0.003);
  EXPECT_NEAR(start["right_scale"].get<double>(), 0.025, 0.003);
  EXPECT_NEAR(start["gyro_scale"].get<double>(), 0.02, 0.006);  // rotates in one direction only
  EXPECT_NEAR(start["gyro_bias"].get<double>(), 0.01, 0.001);

  const CommandRun by_truth({"calibrate", "odometry", recording_, "--truth", truth_, "-o", output});
  EXPECT_EQ(by_truth.exit_code, 0) << by_truth.err;
  EXPECT_EQ(CommandRun({"replay", recording_, "--config", output, "--map", map_}).exit_code, 0);
}

TEST_F(CalibrateOdometry, LateReadings_EstimatesDelay) {
  ASSERT_EQ(simulate({"--wheel-errors", "0.015,0.025", "--gyro-error", "0.02", "--acceleration",
                      "1", "--rotation-acceleration", "6"},
                     "300")
                .exit_code,
            0);
  const std::string late = folder_ / "late.ndjson";
  const std::string output = folder_ / "odometry.json";
  const auto calibrate = [&](double late_s) {
    std::filesystem::remove(output);
    rewrite(late, [&](json& line) { line["t"] = line["t"].get<double>() + late_s; });
    return CommandRun({"calibrate", "odometry", late, "--map", map_, "-o", output});
  };
  const auto start = [&] {
    return json::parse(std::ifstream(output))["advanced"]["odometry"]["initial"];
  };
  ASSERT_EQ(calibrate(0).exit_code, 0);
  EXPECT_FALSE(start().contains("delay"));
  for (const double late_s : {-0.1, 0.02}) {
    const CommandRun run = calibrate(late_s);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NEAR(start()["delay"].get<double>(), late_s, 0.003);
    EXPECT_NEAR(start()["gyro_scale"].get<double>(), 0.02, 0.003) << run.out;
    EXPECT_EQ(CommandRun({"replay", late, "--config", output, "--map", map_}).exit_code, 0);
  }
  const CommandRun beyond = calibrate(0.4);
  EXPECT_THAT(beyond.out, HasSubstr("The readings are 0.40 s late, more than"));
  EXPECT_FALSE(start().contains("delay"));
  EXPECT_NEAR(start()["gyro_scale"].get<double>(), 0.02, 0.003) << "of the right times";
  const CommandRun edge = calibrate(0.8);
  EXPECT_EQ(edge.exit_code, 1);
  EXPECT_THAT(edge.err, HasSubstr("0.6 s late or more, the limit of the search"));
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST_F(CalibrateOdometry, WrongGeometry_FailsWithRemedy) {
  ASSERT_EQ(simulate({"--wheel-errors", "0.015,0.025", "--gyro-bias", "0.01"}, "300").exit_code, 0);
  const std::string wrong = folder_ / "wrong.ndjson";
  const std::string output = folder_ / "odometry.json";
  const auto calibrate = [&](const std::function<void(json & line)>& change) {
    rewrite(wrong, change);
    const CommandRun run({"calibrate", "odometry", wrong, "--map", map_, "-o", output});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(output));
    return run.err;
  };
  const auto scale = [](json& line, int factor) {
    for (const char* wheel : {"left", "right"}) line[wheel] = line[wheel].get<int>() * factor;
  };
  EXPECT_THAT(calibrate([&](json& line) { scale(line, 4); }),
              HasSubstr("odometry.counts_per_turn to 5760"));
  EXPECT_THAT(calibrate([&](json& line) { scale(line, 2); }),
              HasSubstr("odometry.counts_per_turn to 2880"));
  // Faster than the limit of the wheels: the daemon rejects every reading.
  EXPECT_THAT(calibrate([&](json& line) { scale(line, 16); }),
              HasSubstr("odometry.counts_per_turn to 23040"));
  EXPECT_THAT(calibrate([&](json& line) { std::swap(line["left"], line["right"]); }),
              HasSubstr("left and right are exchanged: swap"));
  EXPECT_THAT(calibrate([&](json& line) { scale(line, -1); }), HasSubstr("both wheels count back"));
  EXPECT_THAT(calibrate([](json& line) { line["gyro"] = line["gyro"].get<double>() * 57.3; }),
              HasSubstr("degrees a second"));
  EXPECT_THAT(calibrate([](json& line) { line["gyro"] = line["gyro"].get<double>() + 0.6; }),
              HasSubstr("+0.61 rad/s while the robot stands"));
  EXPECT_THAT(calibrate([](json& line) { line.erase("right"); }),
              HasSubstr("none of its ODOMETRY lines has both left and right"));
}

}  // namespace
}  // namespace cornerd::tool
