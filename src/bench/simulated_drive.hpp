// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/localizer.hpp"
#include "core/map/wall_map.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulated_odometry.hpp"
#include "replay/simulator/simulator.hpp"
#include "survey/recorded_drive.hpp"

namespace cornerd::bench {

/// A drive in memory, with the true pose in the middle of each scan.
struct SimulatedDrive {
  survey::RecordedDrive drive;
  std::vector<core::Pose2> T_map_base;
};

struct SimulatedDriveConfig {
  replay::SimulatorConfig simulator;
  replay::RobotModel robot;
  bool has_odometry = true;
  std::size_t scans = 100;
};

SimulatedDrive simulate_drive(std::shared_ptr<const core::WallMap> map,
                              const replay::Motion& motion, const SimulatedDriveConfig& config);

/// Localizes a drive: `visit` gets each scan's estimate and the true pose.
void localize_drive(
    core::Localizer& localizer, const SimulatedDrive& drive,
    const std::function<void(const core::PoseEstimate&, const core::Pose2& truth)>& visit);

/// A looped path at no more than 1 m/s2 and 6 rad/s2.
replay::DriveConfig gentle_drive(double speed_m_s = 0.4);

/// Wheels 1.5 and 2.5 % larger than configured, the gyro 2 % and 0.01 rad/s off; no slips.
replay::RobotModel miscalibrated_robot();

}  // namespace cornerd::bench
