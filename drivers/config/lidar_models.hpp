// SPDX-License-Identifier: MIT
// The table of lidars. A driver uses its first row's noise where the config has none, and tries the
// baud rates of its rows in their order; the emulator imitates each row.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/geometry/angle.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::drivers {

enum class DriverKind : std::uint8_t {
  kRplidar,
  kLd,
  kYdlidar,
  kReplay,  ///< a recording instead of a device
};

struct LidarModel {
  std::string_view name;  ///< of `cornerctl emulate --model`
  DriverKind driver = DriverKind::kRplidar;
  std::uint32_t baud = 115200;
  double samples_hz = 0;
  double rate_hz = 0;  ///< revolutions per second
  double min_range_m = 0;
  double max_range_m = 0;
  double noise_floor_m = 0;  ///< as core::SensorNoise
  double noise_share = 0;
  double noise_bearing_rad = 0;

  core::SensorNoise noise() const {
    return {.floor_m = noise_floor_m, .share = noise_share, .bearing_rad = noise_bearing_rad};
  }
};

/// Rates and ranges from the data sheets, noise as drivers/README.md says. All see 360 degrees.
inline constexpr std::array kLidarModels = {
    LidarModel{"a1", DriverKind::kRplidar, 115'200, 3'937, 7.3, 0.15, 12, 0.0015, 0.005,
               core::radians(0.05)},
    LidarModel{"ld06", DriverKind::kLd, 230'400, 4'500, 10, 0.02, 12, 0.0065, 0.001,
               core::radians(0.28)},
    LidarModel{"ld19", DriverKind::kLd, 230'400, 4'500, 10, 0.02, 12, 0.0065, 0.001,
               core::radians(0.28)},
    LidarModel{"stl19p", DriverKind::kLd, 230'400, 5'000, 10, 0.03, 12, 0.0065, 0.001,
               core::radians(0.28)},
    LidarModel{"stl27l", DriverKind::kLd, 921'600, 21'600, 10, 0.03, 25, 0.0065, 0.001,
               core::radians(0.28)},
    LidarModel{"x4", DriverKind::kYdlidar, 128'000, 5'000, 7, 0.12, 10, 0.0015, 0.01,
               core::radians(0.1)},
    LidarModel{"x2", DriverKind::kYdlidar, 115'200, 3'000, 6, 0.1, 8, 0.0015, 0.01,
               core::radians(0.1)},
};

/// Null if there is none.
constexpr const LidarModel* find_lidar_model(std::string_view name) {
  for (const LidarModel& model : kLidarModels) {
    if (model.name == name) return &model;
  }
  return nullptr;
}

/// The first row of a driver; null for kReplay.
constexpr const LidarModel* first_lidar_model(DriverKind driver) {
  for (const LidarModel& model : kLidarModels) {
    if (model.driver == driver) return &model;
  }
  return nullptr;
}

}  // namespace cornerd::drivers
