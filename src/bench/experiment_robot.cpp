// SPDX-License-Identifier: MIT
#include "bench/experiment_robot.hpp"

namespace cornerd::bench {

replay::DriveConfig gentle_drive(double speed_m_s) {
  replay::DriveConfig drive;
  drive.speed_m_s = speed_m_s;
  drive.acceleration_m_s2 = 1;
  drive.yaw_acceleration_rad_s2 = 6;
  drive.loop = true;
  return drive;
}

replay::RobotModel wrong_robot() {
  replay::RobotModel robot;
  robot.left_scale = 0.015;
  robot.right_scale = 0.025;
  robot.gyro_scale = 0.02;
  robot.gyro_bias_rad_s = 0.01;
  return robot;
}

}  // namespace cornerd::bench
