// SPDX-License-Identifier: MIT
// Encoders and gyro by the kernel's own drivers: drivers/odometry/README.md.
#pragma once

#include <filesystem>
#include <string>

#include "core/odometry/odometry_config.hpp"

namespace cornerd::drivers {

struct EncoderConfig {
  std::string counter;    ///< the device's name, e.g. "48300180.counter"
  int count = 0;          ///< index of the count within the device
  bool reversed = false;  ///< counts down when the robot rolls forward
};

struct GyroConfig {
  std::string device;     ///< its name or label: "mpu6050"; empty: there is none
  char axis = 'z';        ///< the one that looks up or down
  bool reversed = false;  ///< it looks down
};

struct KernelOdometryConfig {
  std::filesystem::path sysfs = "/sys";
  EncoderConfig left;
  EncoderConfig right;
  GyroConfig gyro;
  double rate_hz = 50;
  core::DriveGeometry geometry{};  ///< for StuckDetector
};

}  // namespace cornerd::drivers
