// SPDX-License-Identifier: MIT
#include "drivers/odometry/encoder.hpp"

#include <utility>

#include "core/odometry/wrapping_counter.hpp"
#include "drivers/odometry/attribute_text.hpp"
#include "drivers/odometry/device_search.hpp"

namespace cornerd::drivers {
namespace {

constexpr std::string_view kHowToSetUp = "; the udev rule of cornerd sets it up";

/// The functions of the counter subsystem that tell forward from backward.
bool tells_direction(std::string_view function) {
  return function.starts_with("quadrature") || function == "pulse-direction";
}

}  // namespace

Encoder::Encoder(const std::filesystem::path& sysfs, EncoderConfig config)
    : config_(std::move(config)), devices_(sysfs / "bus/counter/devices") {
  set_state(SensorState::kAbsent);
}

void Encoder::look() {
  if (is_open() && !is_current()) close(SensorState::kAbsent, "it was taken away");
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
  // Not every counter has all three: what is not there cannot be wrong.
  const auto disable = [this](const std::string& why) {
    close(SensorState::kDisabled, why + std::string(kHowToSetUp));
    return false;
  };
  if (read_attribute(folder_ / "enable") == "0") return disable("\"enable\" is 0");
  const auto function = read_attribute(folder_ / "function");
  if (function && !tells_direction(*function)) {
    return disable("\"function\" is \"" + *function + "\", which tells no direction");
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
  // From 0, so that a first count that is garbage is a way as any other.
  const std::int64_t last = last_.value_or(0);
  const std::int64_t way = core::count_difference(last, *count, last_ ? ceiling_ : 0);
  if (last_ && way != 0 && (way > 0) != (*count > last)) ++wraps_;
  last_ = count;
  // Unsigned: a counter without a ceiling may tell any way.
  const auto total = static_cast<std::uint64_t>(total_);
  const auto step = static_cast<std::uint64_t>(way);
  total_ = static_cast<std::int64_t>(config_.reversed ? total - step : total + step);
  return total_;
}

}  // namespace cornerd::drivers
