// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "replay/emulator/firmware.hpp"

namespace cornerd::replay {

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
