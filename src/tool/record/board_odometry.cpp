// SPDX-License-Identifier: MIT
#include "tool/record/board_odometry.hpp"

#include <utility>

#include "drivers/driver_clock.hpp"
#include "drivers/odometry/kernel_odometry.hpp"

namespace cornerd::tool {

namespace {

drivers::KernelOdometryConfig kernel_config(const settings::OdometryConfig& config) {
  drivers::KernelOdometryConfig kernel = config.kernel;
  kernel.geometry = config.core.geometry;
  return kernel;
}

}  // namespace

class BoardOdometry::Sink : public drivers::OdometrySink {
 public:
  explicit Sink(OnReading on_reading) : on_reading_(std::move(on_reading)) {}
  void on_reading(const core::OdometryReading& monotonic) override {
    core::OdometryReading reading = monotonic;
    reading.t_ns += drivers::system_clock().unix_offset_ns();
    on_reading_(reading);
  }

 private:
  OnReading on_reading_;
};

BoardOdometry::BoardOdometry(const settings::OdometryConfig& config, OnReading on_reading)
    : driver_(std::make_unique<drivers::KernelOdometry>(kernel_config(config))),
      sink_(std::make_unique<Sink>(std::move(on_reading))),
      thread_([this](const std::stop_token& stop) { driver_->run(stop, *sink_); }) {}

BoardOdometry::~BoardOdometry() = default;

}  // namespace cornerd::tool
