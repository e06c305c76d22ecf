// SPDX-License-Identifier: MIT
// Any text is what was learned of walls, which is read back from what text_of() writes, or a
// SettingsError of one line.
#include "settings/learned_walls.hpp"

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
    const LearnedWallsOfMap learned = parse_learned_walls(input, "w.json");
    const LearnedWallsOfMap again = parse_learned_walls(text_of(learned), "w.json");
    if (again.walls.covariance_m2 != learned.walls.covariance_m2) std::abort();
    if (again.changes.size() != learned.changes.size()) std::abort();
  } catch (const SettingsError& error) {
    if (std::strchr(error.what(), '\n') != nullptr) std::abort();
  }
  return 0;
}
