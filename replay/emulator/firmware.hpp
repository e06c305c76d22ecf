// SPDX-License-Identifier: MIT
// What A1s of different firmwares can do, and what they say about themselves.
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

struct Firmware {
  std::string_view version;
  std::uint8_t major = 1;
  std::uint8_t minor = 0;
  std::uint8_t hardware = 0;
  std::uint8_t model = 0;
  std::uint16_t standard_us = 0;  ///< sample periods, as GET_SAMPLERATE tells them
  std::uint16_t express_us = 0;
  /// By id, as GET_LIDAR_CONF tells them; empty: the firmware does not know that request.
  std::span<const FirmwareScanMode> modes;
  std::uint16_t typical_mode = 0;
  std::string_view banner;  ///< printed after a reset
};

/// "1.29", "1.24" or "1.17"; nullptr for any other.
const Firmware* find_firmware(std::string_view version);

/// The mode of a SCAN request.
FirmwareScanMode standard_mode(const Firmware& firmware);

/// The mode that an EXPRESS_SCAN request asks for. Id 0 is the old express mode whatever the table
/// says; the others are rows of the table.
std::optional<FirmwareScanMode> express_mode(const Firmware& firmware, std::uint8_t id);

/// What a device tells of the rotation that it would like.
struct RotationTarget {
  std::uint16_t rpm = 600;
  std::uint16_t pwm = 660;
};

/// The answer to a GET_LIDAR_CONF request: the type of the entry, echoed, and its value.
/// `request`: the payload: type, 4 bytes, and for entries of a scan mode its id, 2 bytes.
/// `target`: nullopt: that entry is not answered. Empty where the device would not answer.
std::vector<std::uint8_t> configuration_value(const Firmware& firmware,
                                              const std::optional<RotationTarget>& target,
                                              std::span<const std::uint8_t> request);

}  // namespace cornerd::replay
