// SPDX-License-Identifier: MIT
// Any text is a calibration, which is read back from what text_of() writes, or a SettingsError of
// one line.
#include "settings/lidar_calibration.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "settings/config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::settings;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  try {
    const LidarCalibration calibration = parse_lidar_calibration(input, "l.json");
    if (calibration.learned.scans == 0 || !(calibration.learned.sigma.range_scale > 0))
      std::abort();
    const LidarCalibration again = parse_lidar_calibration(text_of(calibration), "l.json");
    if (again.learned.bias != calibration.learned.bias || again.serial != calibration.serial)
      std::abort();
  } catch (const SettingsError& error) {
    if (std::strchr(error.what(), '\n') != nullptr) std::abort();
  }
  return 0;
}
