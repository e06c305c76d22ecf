// SPDX-License-Identifier: MIT
// Robots without faults: calibrating their odometry must not report any.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/temporary_folder.hpp"
#include "tests/unit/tool/command_run.hpp"

namespace cornerd::tool {
namespace {

using Words = std::vector<std::string>;

struct RightRobot {
  const char* name;
  Words config;  ///< of simulation and calibration
  Words drive;
};

void PrintTo(const RightRobot& robot, std::ostream* out) { *out << robot.name; }

class CalibratedRobot : public testing::TestWithParam<RightRobot> {};

TEST_P(CalibratedRobot, CorrectRobot_NoFaultReported) {
  const test::TemporaryFolder folder;
  const std::string map = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
  const std::string recording = folder / "drive.ndjson";
  Words simulate = {"simulate", "--map", map, "--odometry", "--scans", "300", "-o", recording};
  Words calibrate = {"calibrate", "odometry", recording, "--map", map};
  for (Words* words : {&simulate, &calibrate}) {
    words->insert(words->end(), GetParam().config.begin(), GetParam().config.end());
  }
  simulate.insert(simulate.end(), GetParam().drive.begin(), GetParam().drive.end());
  const CommandRun simulated(simulate);
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const CommandRun run(calibrate);
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

/// The exploration of the flat by a robot that is some per cent off.
Words exploring(const Words& more) {
  Words words = {"--scenario", "exploration",    "--loop",      "--drive-speed",
                 "0.4",        "--acceleration", "1",           "--rotation-acceleration",
                 "6",          "--wheel-errors", "0.015,0.025", "--gyro-error",
                 "0.02",       "--gyro-bias",    "0.01"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}
const Words kPioneer = {"--config", CORNERD_SOURCE_DIR "/config/robots/pioneer-p3dx.json"};

INSTANTIATE_TEST_SUITE_P(
    Robots, CalibratedRobot,
    testing::Values(
        RightRobot{"ContestRobot", {}, exploring({})},
        RightRobot{"Pioneer", kPioneer, exploring({})},
        RightRobot{"PioneerThatSlips", kPioneer, exploring({"--slips", "0.3"})},
        RightRobot{"Slips", {}, exploring({"--wheel-noise", "0.002", "--slips", "0.3"})},
        RightRobot{"SlipsWithoutGyro", {}, exploring({"--slips", "1", "--no-gyro"})},
        RightRobot{"Noisy", {}, exploring({"--wheel-noise", "0.01", "--gyro-noise", "0.002"})},
        RightRobot{"Coarse", {"--set", "/odometry/counts_per_turn=40"}, exploring({})},
        RightRobot{"SeldomRead", {}, exploring({"--odometry-rate", "10"})},
        RightRobot{"Circuit",
                   {},
                   {"--scenario", "circuit-1", "--drive-speed", "0.4", "--gyro-bias", "0.01"}}),
    [](const auto& robot) { return std::string(robot.param.name); });

}  // namespace
}  // namespace cornerd::tool
