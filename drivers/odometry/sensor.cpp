// SPDX-License-Identifier: MIT
#include "drivers/odometry/sensor.hpp"

#include <cerrno>
#include <cstring>
#include <string>

#include "drivers/odometry/attribute_text.hpp"

namespace cornerd::drivers {

void Sensor::set_state(SensorState state, std::string_view detail) {
  status_.state = state;
  status_.detail.set(detail);
}

bool Sensor::open(const std::filesystem::path& file) {
  const int error = attribute_.open(file);
  if (error == 0) {
    set_state(SensorState::kRunning);
    return true;
  }
  set_state(error == ENOENT ? SensorState::kAbsent : SensorState::kUnreadable,
            file.string() + ": " + std::strerror(error));
  return false;
}

void Sensor::close(SensorState state, std::string_view detail) {
  attribute_.close();
  set_state(state, detail);
}

std::optional<std::int64_t> Sensor::read_raw() {
  const Attribute::Reading reading = attribute_.read();
  if (reading.error != 0) {
    fail(reading.error);
    return std::nullopt;
  }
  const auto value = parse_integer(reading.text);
  if (!value) {
    ++garbage_;
    set_state(SensorState::kGarbage, "what it says is no number");
    return std::nullopt;
  }
  if (status_.state != SensorState::kFrozen) set_state(SensorState::kRunning);
  return value;
}

void Sensor::set_frozen(bool frozen) {
  if (status_.state == SensorState::kRunning && frozen) {
    set_state(SensorState::kFrozen, "it says the same while the others say that the robot moves");
  } else if (status_.state == SensorState::kFrozen && !frozen) {
    set_state(SensorState::kRunning);
  }
}

void Sensor::fail(int error) {
  ++failed_reads_;
  // A device that is gone does not come back on this descriptor; a bus may.
  if (error == ENODEV) return close(SensorState::kAbsent, "it was taken away");
  set_state(SensorState::kUnreadable, std::strerror(error));
}

}  // namespace cornerd::drivers
