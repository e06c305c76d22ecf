// SPDX-License-Identifier: MIT
// Slotted discs on hobby robots' wheels give 8 to 100 counts a turn, 2 to 25 mm each: scans must be
// deskewed as well as without odometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/tool/command_run.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd {
namespace {

using nlohmann::json;

class CoarseCounts : public testing::TestWithParam<int> {};

TEST_P(CoarseCounts, WithoutGyro_HeadingsAreThoseOfTheLidar) {
  const test::TemporaryFolder folder;
  const std::string map = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
  const std::string recording = folder / "drive.ndjson";
  const std::string truth_file = folder / "truth.ndjson";
  std::vector<std::string> robot = {"--map", map};
  for (const std::string& setting :
       {"counts_per_turn=" + std::to_string(GetParam()), std::string("wheel_radius=0.0325"),
        std::string("track=0.13"), std::string("source=socket")}) {
    robot.insert(robot.end(), {"--set", "/odometry/" + setting});
  }
  std::vector<std::string> simulate = {
      "simulate", "--scenario", "circuit-1",  "--loop", "--drive-speed", "0.3",     "--scans",
      "300",      "--no-gyro",  "--odometry", "-o",     recording,       "--truth", truth_file};
  simulate.insert(simulate.end(), robot.begin(), robot.end());
  const tool::CommandRun simulated(simulate);
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  std::vector<std::string> replay = {"replay", recording, "--classes", "POSE"};
  replay.insert(replay.end(), robot.begin(), robot.end());
  const tool::CommandRun replayed(replay);
  ASSERT_EQ(replayed.exit_code, 0) << replayed.err;

  const tool::Truth truth = tool::Truth::load(truth_file);
  std::vector<double> errors_rad;
  std::istringstream lines(replayed.out);
  for (std::string line; std::getline(lines, line);) {
    const json pose = json::parse(line);
    const auto T_map_base = truth.at(core::from_seconds(pose["t"]));
    if (!pose.contains("x") || !T_map_base) continue;
    errors_rad.push_back(std::abs(core::angle_between(T_map_base->theta_rad, pose["theta"])));
  }
  ASSERT_GT(errors_rad.size(), 290U);
  std::sort(errors_rad.begin(), errors_rad.end());
  // Where the rotation begins within a scan; more would be wrong.
  EXPECT_LT(errors_rad.back(), core::radians(5));
  // Alone the lidar reaches 0.10 degrees.
  EXPECT_LT(errors_rad[errors_rad.size() * 19 / 20], core::radians(0.25));
}

INSTANTIATE_TEST_SUITE_P(CountsPerTurn, CoarseCounts, testing::Values(8, 20, 40, 100));

}  // namespace
}  // namespace cornerd
