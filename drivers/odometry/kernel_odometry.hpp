// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/odometry/odometry_config.hpp"
#include "core/triple_buffer.hpp"
#include "drivers/config/kernel_odometry_config.hpp"
#include "drivers/driver_clock.hpp"
#include "drivers/odometry/kernel_sensors.hpp"
#include "drivers/odometry/odometry_driver.hpp"
#include "drivers/odometry/stuck_detector.hpp"

namespace cornerd::drivers {

/// Polls wheel encoders and a gyro through the kernel's drivers; see README.md beside this file. It
/// polls because Debian 12's eQEP driver has no events, and IIO buffers need more rights than
/// attributes.
class KernelOdometry : public OdometryDriver {
 public:
  explicit KernelOdometry(const KernelOdometryConfig& config, Clock& clock = system_clock());

  void run(std::stop_token stop, OdometrySink& sink) override;
  OdometryStatus status() override { return latest_.read(); }

 private:
  void refresh();
  void poll(OdometrySink& sink);
  void publish();

  Clock& clock_;
  core::TimeNs period_ns_;
  Encoder left_;
  Encoder right_;
  Gyro gyro_;
  StuckDetector stuck_;
  std::uint64_t readings_ = 0;
  std::uint64_t late_ = 0;
  core::TripleBuffer<OdometryStatus> latest_;
};

}  // namespace cornerd::drivers
