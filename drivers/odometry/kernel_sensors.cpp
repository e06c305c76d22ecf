// SPDX-License-Identifier: MIT
#include "drivers/odometry/kernel_sensors.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "core/odometry/wrapping_counter.hpp"
#include "drivers/odometry/sysfs.hpp"

namespace cornerd::drivers {
namespace {

constexpr std::string_view kUnplugged = "the device was removed; check its cable and driver";
constexpr std::string_view kHowToSetUp = "; install cornerd's udev rule";

/// Functions of the counter subsystem that distinguish forward from backward.
bool has_direction(std::string_view function) {
  return function.starts_with("quadrature") || function == "pulse-direction";
}

}  // namespace

void KernelSensor::set_state(SensorState state, std::string_view detail) {
  status_.state = state;
  status_.detail.set(detail);
}

bool KernelSensor::open(const std::filesystem::path& file) {
  const int error = attribute_.open(file);
  if (error == 0) {
    set_state(SensorState::kRunning);
    return true;
  }
  set_state(error == ENOENT ? SensorState::kAbsent : SensorState::kUnreadable,
            file.string() + ": " + std::strerror(error));
  return false;
}

void KernelSensor::close(SensorState state, std::string_view detail) {
  attribute_.close();
  set_state(state, detail);
}

std::optional<std::int64_t> KernelSensor::read_raw() {
  const Attribute::Reading reading = attribute_.read();
  if (reading.error != 0) {
    fail(reading.error);
    return std::nullopt;
  }
  const auto value = parse_integer(reading.text);
  if (!value) {
    ++invalid_values_;
    set_state(SensorState::kInvalid, "the attribute holds no number; check the sensor's driver");
    return std::nullopt;
  }
  if (status_.state != SensorState::kStuck) set_state(SensorState::kRunning);
  return value;
}

void KernelSensor::set_stuck(bool stuck) {
  if (status_.state == SensorState::kRunning && stuck) {
    set_state(SensorState::kStuck,
              "the value stays the same although the robot moves; check the cable");
  } else if (status_.state == SensorState::kStuck && !stuck) {
    set_state(SensorState::kRunning);
  }
}

void KernelSensor::fail(int error) {
  ++failed_reads_;
  // A removed device never returns on this descriptor; a bus error may pass.
  if (error == ENODEV) return close(SensorState::kAbsent, kUnplugged);
  set_state(SensorState::kUnreadable, std::strerror(error));
}

Encoder::Encoder(const std::filesystem::path& sysfs, EncoderConfig config)
    : config_(std::move(config)), devices_(sysfs / "bus/counter/devices") {
  set_state(SensorState::kAbsent);
}

void Encoder::refresh() {
  if (is_open() && !is_current()) close(SensorState::kAbsent, kUnplugged);
  if (!is_open() && !find()) return;
  if (!check()) return;
  if (!is_open()) open(folder_ / "count");
}

bool Encoder::find() {
  const FoundDevice device = find_device(devices_, config_.counter);
  if (device.folder.empty()) {
    set_state(SensorState::kAbsent, device.problem);
    return false;
  }
  folder_ = device.folder / ("count" + std::to_string(config_.count));
  return true;
}

bool Encoder::check() {
  // Not every counter has all three attributes; a missing one is no fault.
  const auto disable = [this](const std::string& why) {
    close(SensorState::kDisabled, why + std::string(kHowToSetUp));
    return false;
  };
  if (read_attribute(folder_ / "enable") == "0") return disable("\"enable\" is 0");
  const auto function = read_attribute(folder_ / "function");
  if (function && !has_direction(*function)) {
    return disable("\"function\" is \"" + *function + "\", which has no direction");
  }
  const auto ceiling = read_attribute(folder_ / "ceiling");
  ceiling_ = ceiling ? parse_integer(*ceiling).value_or(0) : 0;
  if (ceiling && ceiling_ <= 0) return disable("\"ceiling\" is " + *ceiling);
  return true;
}

std::optional<std::int64_t> Encoder::read() {
  if (!is_open()) return std::nullopt;
  const auto count = read_raw();
  if (!count) return std::nullopt;
  const std::int64_t last = last_.value_or(0);
  // The first count is a difference to 0 like any other, so that total_ follows the device.
  const std::int64_t travel = core::count_difference(last, *count, last_ ? ceiling_ : 0);
  if (last_ && travel != 0 && (travel > 0) != (*count > last)) ++wraps_;
  last_ = count;
  // Unsigned: without a ceiling any difference may occur, and signed overflow is undefined.
  const auto total = static_cast<std::uint64_t>(total_);
  const auto step = static_cast<std::uint64_t>(travel);
  total_ = static_cast<std::int64_t>(config_.reversed ? total - step : total + step);
  return total_;
}

Gyro::Gyro(const std::filesystem::path& sysfs, GyroConfig config)
    : config_(std::move(config)), devices_(sysfs / "bus/iio/devices") {
  set_state(config_.device.empty() ? SensorState::kNone : SensorState::kAbsent);
}

void Gyro::refresh() {
  if (config_.device.empty()) return;
  if (is_open() && !is_current()) close(SensorState::kAbsent, kUnplugged);
  if (!is_open()) {
    const FoundDevice device = find_device(devices_, config_.device);
    if (device.folder.empty()) return set_state(SensorState::kAbsent, device.problem);
    folder_ = device.folder;
  }
  if (!read_scale()) {
    return close(SensorState::kUnreadable,
                 folder_.string() + ": no valid in_anglvel_scale; is it a gyro?");
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
