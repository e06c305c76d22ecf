// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "drivers/config/kernel_odometry_config.hpp"
#include "drivers/odometry/sensor.hpp"

namespace cornerd::drivers {

/// A gyro by the kernel's industrial I/O subsystem.
class Gyro : public Sensor {
 public:
  /// `sysfs`: where that is mounted.
  Gyro(const std::filesystem::path& sysfs, GyroConfig config);

  /// See Encoder::look(). The scale is asked for again, as a range may be changed.
  void look();

  /// rad/s, counter-clockwise. Nullopt where there is none to be had: see status().
  std::optional<double> read();

 private:
  bool read_scale();
  /// Of this axis, or of all axes.
  std::optional<std::string> read_of_axis(const char* what) const;

  GyroConfig config_;
  std::filesystem::path devices_;
  std::filesystem::path folder_;
  double scale_rad_s_ = 0;
  double offset_ = 0;
};

}  // namespace cornerd::drivers
