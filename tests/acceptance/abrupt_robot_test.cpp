// SPDX-License-Identifier: MIT
// A robot that starts and turns abruptly without odometry: motion-distorted scans must have a
// consistent covariance.
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

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

TEST(AbruptRobot, LidarAlone_CovarianceIsConsistent) {
  const test::TemporaryFolder folder;
  const std::string map = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
  const std::string recording = folder / "drive.ndjson";
  const std::string truth_file = folder / "truth.ndjson";
  const tool::CommandRun simulated({"simulate",    "--map",
                                    map,           "--scenario",
                                    "exploration", "--loop",
                                    "--real",      "--seed",
                                    "1",           "--scans",
                                    "900",         "--range-scale",
                                    "1.01",        "--range-offset",
                                    "0.005",       "--drive-speed",
                                    "0.4",         "--rotation-speed",
                                    "2",           "-o",
                                    recording,     "--truth",
                                    truth_file});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const tool::Truth truth = tool::Truth::load(truth_file);
  const tool::CommandRun replayed({"replay", recording, "--map", map, "--classes", "POSE"});
  ASSERT_EQ(replayed.exit_code, 0) << replayed.err;

  std::map<std::string, double> nees_sum;
  std::map<std::string, int> count;
  std::istringstream lines(replayed.out);
  for (std::string line; std::getline(lines, line);) {
    const json pose = json::parse(line);
    const auto T_map_base = truth.at(core::from_seconds(pose["t"]));
    if (!pose.contains("x") || !T_map_base) continue;
    EXPECT_LT((core::Vec2(pose["x"], pose["y"]) - T_map_base->translation()).norm(), 0.1) << line;
    ++count[pose["state"]];
    nees_sum[pose["state"]] += nees_of(pose, *T_map_base);
  }
  ASSERT_GE(count["tracking"], 10);
  ASSERT_GE(count["fix"], 700);
  EXPECT_LT(nees_sum["tracking"] / count["tracking"], 6);
  EXPECT_LT(nees_sum["fix"] / count["fix"], 3.4);
  RecordProperty("nees_tracking", std::to_string(nees_sum["tracking"] / count["tracking"]));
  RecordProperty("nees_fix", std::to_string(nees_sum["fix"] / count["fix"]));
}

}  // namespace
}  // namespace cornerd
