// SPDX-License-Identifier: MIT
// A robot that starts and turns abruptly without odometry: motion-distorted scans must have a
// consistent covariance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/tool/command_run.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd {
namespace {

using nlohmann::json;

/// Normalized estimation error squared: 3 in the mean where the covariance is consistent.
double nees_of(const json& pose, const core::Pose2& truth) {
  const Eigen::Vector3d error(pose["x"].get<double>() - truth.x_m,
                              pose["y"].get<double>() - truth.y_m,
                              core::angle_between(truth.theta_rad, pose["theta"].get<double>()));
  const json& cov = pose["cov"];
  Eigen::Matrix3d covariance;
  covariance << cov["xx"], cov["xy"], cov["xt"], cov["xy"], cov["yy"], cov["yt"], cov["xt"],
      cov["yt"], cov["tt"];
  return error.dot(Eigen::LLT<Eigen::Matrix3d>(covariance).solve(error));
}

double sigma_m(const json& cov) {
  return std::sqrt(cov["xx"].get<double>() + cov["yy"].get<double>());
}

struct AbruptDrive {
  std::map<std::string, double> nees;  ///< mean, by state
  std::map<std::string, int> count;
  double mean_error_m = 0;
  double mean_error_rad = 0;
};

/// A drive in the flat without odometry, localized in sequence.
AbruptDrive drive(const std::vector<std::string>& more) {
  const test::TemporaryFolder folder;
  const std::string map = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
  const std::string recording = folder / "drive.ndjson";
  const std::string truth_file = folder / "truth.ndjson";
  std::vector<std::string> simulate = {"simulate", "--map",   map,        "--loop",  "-o",
                                       recording,  "--truth", truth_file, "--scans", "900"};
  simulate.insert(simulate.end(), more.begin(), more.end());
  const tool::CommandRun simulated(simulate);
  EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
  const tool::Truth truth = tool::Truth::load(truth_file);
  const tool::CommandRun replayed({"replay", recording, "--map", map, "--classes", "POSE"});
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;

  AbruptDrive driven;
  int poses = 0;
  std::istringstream lines(replayed.out);
  for (std::string line; std::getline(lines, line);) {
    const json pose = json::parse(line);
    const auto T_map_base = truth.at(core::from_seconds(pose["t"]));
    if (!pose.contains("x") || !T_map_base) continue;
    const double error_m = (core::Vec2(pose["x"], pose["y"]) - T_map_base->translation()).norm();
    EXPECT_LT(error_m, std::max(0.1, 2 * sigma_m(pose["cov"]))) << line;
    driven.mean_error_m += error_m;
    driven.mean_error_rad += std::abs(core::angle_between(T_map_base->theta_rad, pose["theta"]));
    ++poses;
    ++driven.count[pose["state"]];
    driven.nees[pose["state"]] += nees_of(pose, *T_map_base);
  }
  driven.mean_error_m /= poses;
  driven.mean_error_rad /= poses;
  for (auto& [state, nees] : driven.nees) nees /= driven.count[state];
  return driven;
}

TEST(AbruptRobot, LidarAlone_CovarianceIsConsistent) {
  AbruptDrive driven =
      drive({"--scenario", "exploration", "--real", "--seed", "1", "--range-scale", "1.01",
             "--range-offset", "0.005", "--drive-speed", "0.4", "--rotation-speed", "2"});
  ASSERT_GE(driven.count["tracking"], 1);
  ASSERT_GE(driven.count["fix"], 700);
  EXPECT_LT(driven.nees["tracking"], 6);
  EXPECT_LT(driven.nees["fix"], 3.4);
  RecordProperty("nees_tracking", std::to_string(driven.nees["tracking"]));
  RecordProperty("nees_fix", std::to_string(driven.nees["fix"]));
}

/// The yaw rate changes by 0.8 rad/s within a scan.
TEST(AbruptRobot, GentleStarts_AreDeskewed) {
  AbruptDrive driven =
      drive({"--scenario", "exploration", "--seed", "7", "--drive-speed", "0.25",
             "--rotation-speed", "3", "--acceleration", "1", "--rotation-acceleration", "6"});
  EXPECT_GE(driven.count["fix"], 890);
  EXPECT_LT(driven.mean_error_m, 0.8e-3);
  EXPECT_LT(driven.mean_error_rad, core::radians(0.05));
  EXPECT_LT(driven.nees["fix"], 4);
  EXPECT_GT(driven.nees["fix"], 1.5);
}

/// A robot that sets out again and again: scans in which it does not stand any more.
TEST(AbruptRobot, SettingOut_TeachesNoBias) {
  AbruptDrive driven = drive({"--path", "1.65,2.7 1.35,2.7 1.35,2.45 1.65,2.45", "--seed", "5",
                              "--drive-speed", "0.25", "--rotation-speed", "1.5", "--acceleration",
                              "1", "--rotation-acceleration", "6"});
  EXPECT_GE(driven.count["fix"], 890);
  EXPECT_LT(driven.mean_error_m, 1.2e-3);
  EXPECT_LT(driven.nees["fix"], 5);
}

}  // namespace
}  // namespace cornerd
