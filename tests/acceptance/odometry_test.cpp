// SPDX-License-Identifier: MIT
// 100 m through a flat of seven rooms with erroneous wheels and gyro, the lidar covered on the way:
// a recording of the port's bytes and ODOMETRY lines, and its replay.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
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

constexpr double kTaught_s = 30;
constexpr double kUncovered_s = 35;

/// Wheels 2 % off and 1 % apart, a gyro 2 % and 0.01 rad/s off.
struct BadRobot {
  std::uint64_t seed;
  double left_scale;
  double right_scale;
  double gyro_scale;
  double gyro_bias_rad_s;
};

void PrintTo(const BadRobot& robot, std::ostream* out) { *out << "seed " << robot.seed; }

class DriveOf100m : public testing::TestWithParam<BadRobot> {
 protected:
  void SetUp() override {
    const BadRobot& robot = GetParam();
    const std::string map = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
    const std::string recording = folder_ / "drive.ndjson";
    const std::string truth = folder_ / "truth.ndjson";
    const std::string wheels =
        std::to_string(robot.left_scale) + ',' + std::to_string(robot.right_scale);
    const tool::CommandRun simulated({"simulate",
                                      "--map",
                                      map,
                                      "--scenario",
                                      "exploration",
                                      "--loop",
                                      "--drive-speed",
                                      "0.4",
                                      "--acceleration",
                                      "1",
                                      "--rotation-acceleration",
                                      "6",
                                      "--odometry",
                                      "--wheel-errors=" + wheels,
                                      "--gyro-error=" + std::to_string(robot.gyro_scale),
                                      "--gyro-bias=" + std::to_string(robot.gyro_bias_rad_s),
                                      "--covered",
                                      "30,35",
                                      "--scans",
                                      "2600",
                                      "--seed",
                                      std::to_string(robot.seed),
                                      "-o",
                                      recording,
                                      "--truth",
                                      truth});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    truth_.emplace(tool::Truth::load(truth));
    const tool::CommandRun replayed(
        {"replay", recording, "--map", map, "--set", "/odometry/source=socket"});
    ASSERT_EQ(replayed.exit_code, 0) << replayed.err;
    std::istringstream lines(replayed.out);
    for (std::string line; std::getline(lines, line);) {
      json message = json::parse(line);
      (message["class"] == "POSE" ? poses_ : statuses_).push_back(std::move(message));
    }
    ASSERT_GT(poses_.size(), 2590U);
  }

  struct Error {
    double position_m;
    double heading_rad;
  };
  Error error_of(const json& pose) const {
    const auto truth = truth_->at(core::from_seconds(pose["t"]));
    if (!truth || !pose.contains("x")) return {HUGE_VAL, HUGE_VAL};
    return {(core::Vec2(pose["x"], pose["y"]) - truth->translation()).norm(),
            std::abs(core::angle_between(truth->theta_rad, pose["theta"]))};
  }
  /// Estimates after 30 s of driving.
  json estimates() const {
    const auto after = std::find_if(statuses_.begin(), statuses_.end(),
                                    [](const json& status) { return status["t"] > kTaught_s; });
    if (after == statuses_.end() || (*after)["t"] > kTaught_s + 1.5) return {};
    return (*after)["odometry"];
  }
  double distance_m() const {
    double distance_m = 0;
    const auto& points = truth_->points();
    for (std::size_t i = 1; i < points.size(); ++i) {
      distance_m +=
          (points[i].T_map_base.translation() - points[i - 1].T_map_base.translation()).norm();
    }
    return distance_m;
  }

  test::TemporaryFolder folder_;
  std::optional<tool::Truth> truth_;
  std::vector<json> poses_;
  std::vector<json> statuses_;
};

// One test, since each test would drive the 100 m again.
TEST_P(DriveOf100m, WheelAndGyroErrors_AreEstimatedAndBridgeFiveSeconds) {
  EXPECT_GE(distance_m(), 100);
  double sum_m = 0;
  std::size_t predicted = 0;
  Error last_blind{HUGE_VAL, HUGE_VAL};
  for (const json& pose : poses_) {
    const Error error = error_of(pose);
    sum_m += error.position_m;
    if (pose["t"] > kTaught_s && pose["t"] < kUncovered_s && pose["state"] == "predicted") {
      ++predicted;
      last_blind = error;
    } else {
      EXPECT_TRUE(pose["state"] == "fix" || pose["state"] == "tracking") << pose;
    }
  }
  const double mean_m = sum_m / static_cast<double>(poses_.size());
  EXPECT_LE(mean_m, 0.005);

  const json now = estimates();
  ASSERT_TRUE(now.is_object());
  EXPECT_NEAR(now["left_scale"], GetParam().left_scale, 0.003);
  EXPECT_NEAR(now["right_scale"], GetParam().right_scale, 0.003);
  EXPECT_NEAR(now["track_scale"], 0, 0.003);
  EXPECT_NEAR(now["gyro_scale"], GetParam().gyro_scale, 0.003);
  EXPECT_NEAR(now["gyro_bias"], GetParam().gyro_bias_rad_s, 0.001);

  EXPECT_GE(predicted, 34U);  // 7.3 scans a second
  EXPECT_LE(last_blind.position_m, 0.03);
  EXPECT_LE(last_blind.heading_rad, core::radians(1));
  RecordProperty("mean_mm", std::to_string(1e3 * mean_m));
  RecordProperty("blind_mm", std::to_string(1e3 * last_blind.position_m));
  RecordProperty("blind_degrees", std::to_string(core::degrees(last_blind.heading_rad)));
}

INSTANTIATE_TEST_SUITE_P(Robots, DriveOf100m,
                         testing::Values(BadRobot{1, 0.015, 0.025, 0.02, 0.01},
                                         BadRobot{2, 0.025, 0.015, -0.02, 0.01},
                                         BadRobot{3, -0.015, -0.025, 0.02, -0.01},
                                         BadRobot{4, -0.025, -0.015, -0.02, -0.01}));

}  // namespace
}  // namespace cornerd
