// SPDX-License-Identifier: MIT
// Any text gives a map description within its limits, or a GridError.
#include "gridmap/map_server_yaml.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "gridmap/image.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::gridmap;
  try {
    const MapServerYaml yaml = parse_map_server_yaml({reinterpret_cast<const char*>(data), size});
    if (yaml.image.empty() || !(yaml.resolution_m >= 1e-3 && yaml.resolution_m <= 10) ||
        !(yaml.free_threshold < yaml.occupied_threshold) ||
        !std::isfinite(yaml.T_map_picture.x_m + yaml.T_map_picture.theta_rad)) {
      std::abort();
    }
  } catch (const GridError& error) {
    if (*error.what() == '\0') std::abort();
  }
  return 0;
}
