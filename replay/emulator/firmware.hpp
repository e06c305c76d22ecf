// SPDX-License-Identifier: MIT
// Capabilities and answers of RPLidars by model and, of A1s, by firmware.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/rplidar/decoder.hpp"

namespace cornerd::replay {

struct FirmwareScanMode {
  std::string_view name;
  std::uint32_t period_q8_us = 0;
  std::uint32_t max_distance_q8_m = 0;
  std::uint8_t answer_type = 0;
  rplidar::WireFormat format = rplidar::WireFormat::kStandard;
};

/// What turns the motor, other than a line of the port.
enum class MotorRequests : std::uint8_t {
  kNone,
  kPwm,    ///< SET_MOTOR_PWM alone, by the accessory board of the USB cable
  kSpeed,  ///< a scan request, and HQ_MOTOR_SPEED
};

struct Firmware {
  std::string_view version;  ///< of an A1; else the model's name
  std::uint8_t major = 1;
  std::uint8_t minor = 0;
  std::uint8_t hardware = 0;
  std::uint8_t model = 0;
  std::uint16_t standard_us = 0;  ///< sample periods of GET_SAMPLERATE
  std::uint16_t express_us = 0;
  /// By id, for GET_LIDAR_CONF; empty: that request is not answered.
  std::span<const FirmwareScanMode> modes;
  std::uint16_t typical_mode = 0;
  std::string_view banner;  ///< printed after a reset; empty: nothing for 2 s
  MotorRequests motor = MotorRequests::kNone;
  std::uint16_t min_rpm = 0;  ///< 0: not answered
  std::uint16_t max_rpm = 0;

  bool measures_time_of_flight() const { return model >> 4 >= 4; }
};

/// "1.29", "1.24" or "1.17" of an A1, or the name of another model; nullptr for any other.
const Firmware* find_firmware(std::string_view version);

/// The mode of a SCAN request.
FirmwareScanMode standard_mode(const Firmware& firmware);

/// The mode of an EXPRESS_SCAN request. Id 0 is legacy express, which a lidar that measures time of
/// flight lacks; the others are rows of the table.
std::optional<FirmwareScanMode> express_mode(const Firmware& firmware, std::uint8_t id);

/// Value of GET_LIDAR_CONF type 0x01, desired rotation.
struct RotationTarget {
  std::uint16_t rpm = 600;
  std::uint16_t pwm = 660;
};

/// Answer to GET_LIDAR_CONF: the echoed type and its value; empty: no answer. `request`: type, 4
/// bytes, and for entries of a scan mode its id, 2 bytes. `target` nullopt: not answered.
std::vector<std::uint8_t> configuration_value(const Firmware& firmware,
                                              const std::optional<RotationTarget>& target,
                                              std::span<const std::uint8_t> request);

}  // namespace cornerd::replay
