// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace cornerd::daemon {

/// Percentiles of the newest latencies, by the nearest rank.
class LatencyWindow {
 public:
  /// Some 20 to 40 seconds of an A1's turns.
  static constexpr std::size_t kSize = 200;

  void add(double latency_s);
  bool empty() const { return count_ == 0; }
  /// `share`: 0.5 is the median. 0 where there is none.
  double percentile(double share) const;

 private:
  std::array<double, kSize> latencies_s_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
};

}  // namespace cornerd::daemon
