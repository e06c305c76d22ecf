// SPDX-License-Identifier: MIT
// Any text is what was learnt of a lidar, which comes back from what it is written as, or a
// SettingsError of one line.
#include "settings/learned_lidar.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::settings;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  try {
    const LearnedLidar lidar = parse_learned_lidar(input, "l.json");
    if (lidar.learned.scans == 0 || !(lidar.learned.sigma.range_scale > 0)) std::abort();
    const LearnedLidar again = parse_learned_lidar(text_of(lidar), "l.json");
    if (again.learned.bias != lidar.learned.bias || again.serial != lidar.serial) std::abort();
  } catch (const SettingsError& error) {
    if (std::strchr(error.what(), '\n') != nullptr) std::abort();
  }
  return 0;
}
