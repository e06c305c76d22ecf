// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "drivers/lidar_driver.hpp"

namespace cornerd::drivers {

/// A counter of the stream as STATUS calls it.
struct CounterName {
  std::string_view name;
  std::uint64_t StreamCounters::*member;
};

inline constexpr std::array kCounterNames = {
    CounterName{"bytes", &StreamCounters::bytes},
    CounterName{"used_bytes", &StreamCounters::used_bytes},
    CounterName{"samples", &StreamCounters::samples},
    CounterName{"turns", &StreamCounters::scans},
    CounterName{"skipped_bytes", &StreamCounters::skipped_bytes},
    CounterName{"bad_checksums", &StreamCounters::bad_checksums},
    CounterName{"lost_capsules", &StreamCounters::lost_capsules},
    CounterName{"bad_nodes", &StreamCounters::bad_nodes},
    CounterName{"resyncs", &StreamCounters::resyncs},
    CounterName{"unpaired_capsules", &StreamCounters::unpaired_capsules},
    CounterName{"false_turn_marks", &StreamCounters::false_scan_starts},
    CounterName{"clock_resets", &StreamCounters::clock_resets},
    CounterName{"untimed_samples", &StreamCounters::untimed_samples},
};

static_assert(sizeof(StreamCounters) == kCounterNames.size() * sizeof(std::uint64_t),
              "every counter has a name");

}  // namespace cornerd::drivers
