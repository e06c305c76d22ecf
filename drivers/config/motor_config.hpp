// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace cornerd::rplidar {

enum class MotorKind : std::uint8_t {
  kDtr,   ///< the DTR line, of the A1's USB adapter
  kGpio,  ///< MOTOCTL on a GPIO line
  kPwm,   ///< MOTOCTL on a PWM channel
  kNone,  ///< not controlled by the daemon
};

struct MotorConfig {
  MotorKind kind = MotorKind::kDtr;
  std::filesystem::path path{};  ///< sysfs folder of the GPIO line or PWM channel
  double duty = 1.0;             ///< of a PWM channel, 0..1
  double period_s = 4e-5;        ///< of a PWM channel
};

}  // namespace cornerd::rplidar
