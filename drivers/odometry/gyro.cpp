// SPDX-License-Identifier: MIT
#include "drivers/odometry/gyro.hpp"

#include <utility>

#include "drivers/odometry/attribute_text.hpp"
#include "drivers/odometry/device_search.hpp"

namespace cornerd::drivers {

Gyro::Gyro(const std::filesystem::path& sysfs, GyroConfig config)
    : config_(std::move(config)), devices_(sysfs / "bus/iio/devices") {
  set_state(config_.device.empty() ? SensorState::kNone : SensorState::kAbsent);
}

void Gyro::look() {
  if (config_.device.empty()) return;
  if (is_open() && !is_current()) close(SensorState::kAbsent, "it was taken away");
  if (!is_open()) {
    const FoundDevice device = find_device(devices_, config_.device);
    if (device.folder.empty()) return set_state(SensorState::kAbsent, device.problem);
    folder_ = device.folder;
  }
  if (!read_scale()) {
    return close(SensorState::kUnreadable, folder_.string() + " has no scale of a rate of turn");
  }
  if (!is_open()) open(folder_ / (std::string("in_anglvel_") + config_.axis + "_raw"));
}

std::optional<std::string> Gyro::read_of_axis(const char* what) const {
  auto text = read_attribute(folder_ / (std::string("in_anglvel_") + config_.axis + "_" + what));
  return text ? text : read_attribute(folder_ / (std::string("in_anglvel_") + what));
}

bool Gyro::read_scale() {
  const auto scale = read_of_axis("scale");
  const auto value = scale ? parse_decimal(*scale) : std::nullopt;
  if (!value || *value == 0) return false;
  scale_rad_s_ = config_.reversed ? -*value : *value;
  const auto offset = read_of_axis("offset");
  offset_ = offset ? parse_decimal(*offset).value_or(0) : 0;
  return true;
}

std::optional<double> Gyro::read() {
  if (!is_open()) return std::nullopt;
  const auto raw = read_raw();
  if (!raw) return std::nullopt;
  return (static_cast<double>(*raw) + offset_) * scale_rad_s_;
}

}  // namespace cornerd::drivers
