// SPDX-License-Identifier: MIT
#include "bench/simulated_drive.hpp"

#include <optional>
#include <utility>

#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {

SimulatedDrive simulate_drive(std::shared_ptr<const core::WallMap> map,
                              const replay::Motion& motion, const SimulatedDriveConfig& config) {
  replay::Simulator simulator(std::make_unique<replay::MapScene>(std::move(map), motion),
                              config.simulator);
  std::optional<replay::SimulatedOdometry> odometry;
  if (config.has_odometry) odometry.emplace(motion, config.robot, config.simulator.seed + 1);

  SimulatedDrive simulated;
  core::ScanAssembler assembler;
  core::Scan scan;
  while (simulated.drive.size() < config.scans) {
    for (const replay::SimulatedSample& sample : simulator.next().samples) {
      while (odometry && odometry->next_ns() <= sample.t_ns) {
        simulated.drive.add(odometry->next().arrived(sample.t_ns));
      }
      if (assembler.add(replay::to_sample(sample), scan)) simulated.drive.add(scan);
    }
  }
  for (std::size_t i = 0; i < simulated.drive.size(); ++i) {
    simulated.T_map_base.push_back(
        motion(simulated.drive.middle_ns(i), static_cast<std::int64_t>(i)));
  }
  return simulated;
}

replay::DriveConfig gentle_drive(double speed_m_s) {
  replay::DriveConfig drive;
  drive.speed_m_s = speed_m_s;
  drive.acceleration_m_s2 = 1;
  drive.yaw_acceleration_rad_s2 = 6;
  drive.loop = true;
  return drive;
}

void localize_drive(
    core::Localizer& localizer, const SimulatedDrive& drive,
    const std::function<void(const core::PoseEstimate&, const core::Pose2& truth)>& visit) {
  core::Scan scan;
  std::span<const survey::RecordedDrive::Reading> readings = drive.drive.readings();
  for (std::size_t i = 0; i < drive.drive.size(); ++i) {
    for (; !readings.empty() && readings.front().scan <= i; readings = readings.subspan(1)) {
      localizer.add(readings.front().reading);
    }
    drive.drive.load(i, scan);
    visit(localizer.step(scan).pose, drive.T_map_base[i]);
  }
}

replay::RobotModel miscalibrated_robot() {
  replay::RobotModel robot;
  robot.left_scale = 0.015;
  robot.right_scale = 0.025;
  robot.gyro_scale = 0.02;
  robot.gyro_bias_rad_s = 0.01;
  return robot;
}

}  // namespace cornerd::bench
