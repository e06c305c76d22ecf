// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/types.hpp"

namespace cornerd::core {

/// Histogram of a loop's delays: bins 1, 2, 5 from 0.1 ms to 1 s. Trivially copyable.
struct LatencyHistogram {
  /// Upper limits of all bins but the last one.
  static constexpr std::array<TimeNs, 13> kEdgesNs = {
      100'000,    200'000,    500'000,     1'000'000,   2'000'000,   5'000'000,    10'000'000,
      20'000'000, 50'000'000, 100'000'000, 200'000'000, 500'000'000, 1'000'000'000};

  std::array<std::uint32_t, kEdgesNs.size() + 1> counts{};
  TimeNs max_ns = 0;

  void add(TimeNs late_ns) {
    const auto edge = std::lower_bound(kEdgesNs.begin(), kEdgesNs.end(), late_ns);
    ++counts[static_cast<std::size_t>(edge - kEdgesNs.begin())];
    max_ns = std::max(max_ns, late_ns);
  }
};

}  // namespace cornerd::core
