// SPDX-License-Identifier: MIT
#include "bench/corridor_experiment.hpp"

#include <algorithm>
#include <span>

#include "bench/simulated_drive.hpp"
#include "core/localizer.hpp"

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
  core::Scan scan;
  std::span<const survey::RecordedDrive::Reading> readings = drive.drive.readings();
  for (std::size_t i = 0; i < drive.drive.size(); ++i) {
    for (; !readings.empty() && readings.front().scan <= i; readings = readings.subspan(1)) {
      localizer.add(readings.front().reading, readings.front().now_ns);
    }
    drive.drive.load(i, scan);
    score.add(localizer.step(scan).pose, drive.T_map_base[i]);
  }
  return score;
}

}  // namespace cornerd::bench
