// SPDX-License-Identifier: MIT
// The robot of the experiments on odometry and survey, and how it drives.
#pragma once

#include "replay/simulator/motion.hpp"
#include "replay/simulator/simulated_odometry.hpp"

namespace cornerd::bench {

/// No wheel slips by this robot's own doing: 1 m/s2 and 6 rad/s2 at the most, once around and
/// again.
replay::DriveConfig gentle_drive(double speed_m_s = 0.4);

/// Wheels 1.5 and 2.5 % larger than configured, the gyro 2 % and 0.01 rad/s off; no slips.
replay::RobotModel wrong_robot();

}  // namespace cornerd::bench
