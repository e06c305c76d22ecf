// SPDX-License-Identifier: MIT
#include "bench/corridor_experiment.hpp"

#include <algorithm>

#include "bench/simulated_drive.hpp"

namespace cornerd::bench {
namespace {

constexpr double kDriven_m_s = 0.5;
/// How near the drive comes to the corridor's ends.
constexpr double kEnd_m = 1;

}  // namespace

PoseScore drive_along(const std::shared_ptr<const core::WallMap>& corridor, CorridorRobot robot,
                      std::size_t scans, std::uint64_t seed) {
  const bool has_odometry = robot != CorridorRobot::kLidarAlone;
  SimulatedDriveConfig config;
  config.has_odometry = has_odometry;
  config.robot = miscalibrated_robot();
  config.robot.has_gyro = robot == CorridorRobot::kWheelsAndGyro;
  config.simulator.seed = seed;
  config.scans = scans;
  double length_m = 0;
  double width_m = 1e3;
  for (const core::Wall& wall : corridor->plan().walls) {
    length_m = std::max(length_m, wall.to.x());
    if (wall.from.x() == 0 && wall.to.x() == 0) width_m = (wall.to - wall.from).norm();
  }
  const replay::Motion motion = replay::drive_path(
      {{kEnd_m, width_m / 2}, {length_m - kEnd_m, width_m / 2}}, gentle_drive(kDriven_m_s));
  const SimulatedDrive drive = simulate_drive(corridor, motion, config);

  core::LocalizerConfig localizer_config;
  localizer_config.odometry.enabled = has_odometry;
  localizer_config.odometry.geometry = config.robot.geometry;
  core::Localizer localizer(corridor, localizer_config);
  PoseScore score;
  localize_drive(localizer, drive,
                 [&](const core::PoseEstimate& pose, const core::Pose2& T_map_base) {
                   score.add(pose, T_map_base);
                 });
  return score;
}

}  // namespace cornerd::bench
