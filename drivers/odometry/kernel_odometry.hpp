// SPDX-License-Identifier: MIT
#pragma once

#include "core/latest.hpp"
#include "drivers/clock.hpp"
#include "drivers/config/kernel_odometry_config.hpp"
#include "drivers/odometry/encoder.hpp"
#include "drivers/odometry/freeze_watch.hpp"
#include "drivers/odometry/gyro.hpp"
#include "drivers/odometry/odometry_driver.hpp"

namespace cornerd::drivers {

/// Wheels and gyro by the kernel's own drivers (README.md beside this file). It polls: the eQEP
/// driver of Debian 12's kernel has no events, and a gyro's buffer takes rights that its attributes
/// do not.
class KernelOdometry : public OdometryDriver {
 public:
  explicit KernelOdometry(const KernelOdometryConfig& config, Clock& clock = system_clock());

  void run(std::stop_token stop, OdometrySink& sink) override;
  OdometryStatus status() override { return latest_.read(); }

 private:
  void look();
  void poll(OdometrySink& sink);
  void publish();

  Clock& clock_;
  core::TimeNs period_ns_;
  Encoder left_;
  Encoder right_;
  Gyro gyro_;
  FreezeWatch freeze_;
  std::uint64_t readings_ = 0;
  std::uint64_t late_ = 0;
  core::Latest<OdometryStatus> latest_;
};

}  // namespace cornerd::drivers
