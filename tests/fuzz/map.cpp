// SPDX-License-Identifier: MIT
// Any text gives a floor plan, or a SettingsError of one line; a small plan makes a map or is
// refused.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "settings/map_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd;
  constexpr std::size_t kFewWalls = 30;
  try {
    auto plan =
        settings::parse_floor_plan({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    if (plan.walls.empty()) std::abort();
    if (plan.walls.size() <= kFewWalls) static_cast<void>(core::WallMap(std::move(plan)));
  } catch (const settings::SettingsError& error) {
    if (std::strchr(error.what(), '\n') != nullptr) std::abort();
  } catch (const std::invalid_argument&) {
    // WallMap refuses walls that make no map.
  }
  return 0;
}
