// SPDX-License-Identifier: MIT
// Any bytes are a message of the daemon or an error; a place among them is finite.
#include "message/told_line.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::message;
  const ToldLine told = parse_told_line({reinterpret_cast<const char*>(data), size});
  if (const auto* pose = std::get_if<ToldPose>(&told)) {
    if (pose->T_map_base && !std::isfinite(pose->T_map_base->x_m + pose->T_map_base->theta_rad)) {
      std::abort();
    }
    if (pose->covariance && !pose->covariance->allFinite()) std::abort();
  } else if (const auto* status = std::get_if<ToldStatus>(&told)) {
    for (const auto& [name, value] : status->counters) {
      if (status->counter(name) != value) std::abort();
    }
  }
  return 0;
}
