// SPDX-License-Identifier: MIT
// Any text of a sysfs attribute is a finite number or none, and an integer round-trips.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "drivers/odometry/sysfs.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::drivers;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto integer = parse_integer(text);
  if (integer && parse_integer(std::to_string(*integer)) != integer) std::abort();
  const auto decimal = parse_decimal(text);
  if (decimal && !std::isfinite(*decimal)) std::abort();
  if (integer && decimal != static_cast<double>(*integer)) std::abort();
  return 0;
}
