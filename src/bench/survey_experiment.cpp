// SPDX-License-Identifier: MIT
#include "bench/survey_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/statistics.hpp"
#include "core/localizer.hpp"
#include "replay/simulator/scenarios.hpp"

namespace cornerd::bench {

SimulatedDrive survey_drive(std::shared_ptr<const core::WallMap> map, std::size_t turns,
                            std::uint64_t seed, bool has_odometry) {
  replay::DriveConfig drive;
  drive.speed_m_s = 0.4;
  drive.acceleration_m_s2 = 1;
  drive.yaw_acceleration_rad_s2 = 6;
  drive.loop = true;
  SimulatedDriveConfig config;
  config.turns = turns;
  config.simulator.seed = seed;
  config.has_odometry = has_odometry;
  config.robot.left_scale = 0.015;
  config.robot.right_scale = 0.025;
  config.robot.gyro_scale = 0.02;
  config.robot.gyro_bias_rad_s = 0.01;
  const replay::Scenario* exploration = replay::find_scenario("exploration");
  return simulate_drive(std::move(map), replay::drive_path(exploration->path, drive), config);
}

LocalizationScore localize_drive(std::shared_ptr<const core::WallMap> map,
                                 const SimulatedDrive& drive, const core::Pose2& T_true_map) {
  core::Localizer localizer(std::move(map), {});
  LocalizationScore score;
  std::vector<double> errors_m;
  core::Scan turn;
  for (std::size_t i = 0; i < drive.drive.size(); ++i) {
    drive.drive.load(i, turn);
    const core::PoseEstimate& pose = localizer.step(turn).pose;
    ++score.turns;
    if (pose.state == core::PoseState::kLost || pose.state == core::PoseState::kAmbiguous) continue;
    ++score.named;
    const core::Pose2 off = drive.T_map_base[i].inverse() * (T_true_map * pose.T_map_base);
    const double error_m = off.translation().norm();
    if (error_m > 0.1 || std::abs(off.theta_rad) > core::radians(5)) ++score.wrong;
    errors_m.push_back(error_m);
    score.mean_error_m += error_m;
  }
  if (errors_m.empty()) return score;
  score.mean_error_m /= static_cast<double>(errors_m.size());
  std::sort(errors_m.begin(), errors_m.end());
  score.error_95_m = errors_m[errors_m.size() * 95 / 100];
  return score;
}

}  // namespace cornerd::bench
