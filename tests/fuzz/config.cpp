// SPDX-License-Identifier: MIT
// Any text and override give a config, or a SettingsError of one line.
#include "settings/config.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::settings;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  // The text after a zero byte is an override.
  const std::size_t zero = input.find('\0');
  std::vector<std::string> overrides;
  if (zero != std::string_view::npos) overrides.emplace_back(input.substr(zero + 1));
  try {
    const Config config = parse_config(input.substr(0, zero), "/etc/fuzz.json", overrides);
    if (!(config.lidar.max_range_m > config.lidar.min_range_m) || config.map.empty()) std::abort();
    const NoiseConfig& noise = config.lidar.noise;
    for (const double range_m : {0.1, 1.0, 20.0}) {
      if (!(noise.sensor.sigma_range_m(range_m) > 0)) std::abort();
      if (!std::isfinite(noise.wall.error_m(range_m, 1))) std::abort();
    }
  } catch (const SettingsError& error) {
    if (std::strchr(error.what(), '\n') != nullptr) std::abort();
  }
  return 0;
}
