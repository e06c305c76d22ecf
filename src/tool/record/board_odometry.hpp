// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <thread>

#include "drivers/odometry/odometry_driver.hpp"
#include "settings/config.hpp"

namespace cornerd::tool {

/// Wheels and gyro of the board itself, read in a thread of its own while this lives.
class BoardOdometry {
 public:
  /// Called in that thread; the reading's time is UNIX time.
  using OnReading = std::function<void(const core::OdometryReading& reading)>;

  /// `config.source` must be kernel.
  BoardOdometry(const settings::OdometryConfig& config, OnReading on_reading);
  ~BoardOdometry();

  drivers::OdometryStatus status() { return driver_->status(); }

 private:
  class Sink;

  std::unique_ptr<drivers::OdometryDriver> driver_;
  std::unique_ptr<Sink> sink_;
  std::jthread thread_;  ///< last: it ends first
};

}  // namespace cornerd::tool
