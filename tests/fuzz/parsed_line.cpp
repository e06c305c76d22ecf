// SPDX-License-Identifier: MIT
// Any bytes give a parsed message or an error; every pose in a message is finite.
#include "message/parsed_line.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::message;
  const ParsedLine line = parse_line({reinterpret_cast<const char*>(data), size});
  if (const auto* pose = std::get_if<ParsedPose>(&line)) {
    if (pose->T_map_base && !std::isfinite(pose->T_map_base->x_m + pose->T_map_base->theta_rad)) {
      std::abort();
    }
    if (pose->covariance && !pose->covariance->allFinite()) std::abort();
  } else if (const auto* status = std::get_if<ParsedStatus>(&line)) {
    for (const auto& [name, value] : status->counters) {
      if (status->counter(name) != value) std::abort();
    }
  }
  return 0;
}
