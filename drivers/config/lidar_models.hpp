// SPDX-License-Identifier: MIT
// The table of lidars. Where the config has no noise, that of a driver's first row holds until the
// device has said which row it is. A driver tries the baud rates of its rows in their order; the
// emulator imitates each row.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

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
  std::uint8_t device_id = 0;  ///< an RPLidar's answer to GET_INFO

  core::SensorNoise noise() const {
    return {.floor_m = noise_floor_m, .share = noise_share, .bearing_rad = noise_bearing_rad};
  }
  bool has_noise_of(const LidarModel& other) const {
    return noise_floor_m == other.noise_floor_m && noise_share == other.noise_share &&
           noise_bearing_rad == other.noise_bearing_rad;
  }
};

/// Rates and ranges from the data sheets, noise as drivers/README.md says. All see 360 degrees.
inline constexpr std::array kLidarModels = {
    LidarModel{"a1", DriverKind::kRplidar, 115'200, 3'937, 7.3, 0.15, 12, 0.0015, 0.005,
               core::radians(0.05), 0x18},
    LidarModel{"a2m8", DriverKind::kRplidar, 115'200, 3'968, 10, 0.15, 12, 0.0015, 0.005,
               core::radians(0.05), 0x28},
    LidarModel{"a2m12", DriverKind::kRplidar, 256'000, 7'937, 10, 0.2, 12, 0.0015, 0.005,
               core::radians(0.05), 0x2C},
    LidarModel{"a3", DriverKind::kRplidar, 256'000, 7'937, 10, 0.2, 25, 0.0015, 0.005,
               core::radians(0.05), 0x31},
    LidarModel{"c1", DriverKind::kRplidar, 460'800, 5'000, 10, 0.05, 12, 0.0065, 0.001,
               core::radians(0.28), 0x41},
    LidarModel{"s1", DriverKind::kRplidar, 256'000, 9'259, 10, 0.1, 40, 0.0065, 0.001,
               core::radians(0.15), 0x61},
    LidarModel{"s2", DriverKind::kRplidar, 1'000'000, 32'000, 10, 0.05, 30, 0.0065, 0.001,
               core::radians(0.1), 0x71},
    LidarModel{"s3", DriverKind::kRplidar, 1'000'000, 32'000, 10, 0.05, 40, 0.0065, 0.001,
               core::radians(0.1), 0x81},
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

/// The row of an RPLidar by its answer to GET_INFO; of another version of its series that one's;
/// null if there is none.
constexpr const LidarModel* find_rplidar(std::uint8_t device_id) {
  const LidarModel* same_series = nullptr;
  for (const LidarModel& model : kLidarModels) {
    if (model.driver != DriverKind::kRplidar) continue;
    if (model.device_id == device_id) return &model;
    if (model.device_id >> 4 == device_id >> 4) same_series = &model;
  }
  return same_series;
}

/// The first row of a driver; null for kReplay.
constexpr const LidarModel* first_lidar_model(DriverKind driver) {
  for (const LidarModel& model : kLidarModels) {
    if (model.driver == driver) return &model;
  }
  return nullptr;
}

/// The baud rates that a driver tries, without repetition.
inline std::vector<std::uint32_t> baud_rates_of(DriverKind driver) {
  std::vector<std::uint32_t> rates;
  for (const LidarModel& model : kLidarModels) {
    if (model.driver != driver) continue;
    if (std::find(rates.begin(), rates.end(), model.baud) == rates.end()) {
      rates.push_back(model.baud);
    }
  }
  return rates;
}

}  // namespace cornerd::drivers
