// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "drivers/config/motor_config.hpp"
#include "drivers/serial/byte_stream.hpp"

namespace cornerd::rplidar {

/// Switches the motor of the head. Does not throw.
class Motor {
 public:
  virtual ~Motor() = default;
  /// Both return false on failure, and set error().
  virtual bool start(drivers::ByteStream& port) = 0;
  virtual bool stop(drivers::ByteStream& port) = 0;
  /// Reason of the last failure, one line.
  virtual const std::string& error() const = 0;
};

std::unique_ptr<Motor> make_motor(const MotorConfig& config);

}  // namespace cornerd::rplidar
