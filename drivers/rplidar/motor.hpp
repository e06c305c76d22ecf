// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "drivers/serial/byte_stream.hpp"

namespace cornerd::rplidar {

enum class MotorKind : std::uint8_t {
  kDtr,   ///< the DTR line of the A1's USB adapter
  kGpio,  ///< MOTOCTL on a GPIO line
  kPwm,   ///< MOTOCTL on a PWM channel
  kNone,  ///< not controlled by the daemon
};

struct MotorConfig {
  MotorKind kind = MotorKind::kDtr;
  std::filesystem::path path;  ///< sysfs folder of the GPIO line or PWM channel
  double duty = 1.0;           ///< of a PWM channel, 0..1
  double period_s = 4e-5;      ///< of a PWM channel
};

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
