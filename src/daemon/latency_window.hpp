// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cornerd::daemon {

/// Nearest-rank percentiles of the newest latencies.
class LatencyWindow {
 public:
  /// 20 to 40 seconds of an A1's scans.
  static constexpr std::size_t kSize = 200;

  void add(double latency_s) {
    latencies_s_[next_] = latency_s;
    next_ = (next_ + 1) % kSize;
    count_ = std::min(count_ + 1, kSize);
  }

  bool empty() const { return count_ == 0; }

  /// Seconds; 0 if empty. `share`: 0.5 gives the median.
  double percentile(double share) const {
    if (empty()) return 0;
    auto sorted = latencies_s_;
    const double rank = std::ceil(share * static_cast<double>(count_));
    const auto index = std::clamp<std::size_t>(static_cast<std::size_t>(rank), 1, count_) - 1;
    const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(sorted.begin(), nth, sorted.begin() + static_cast<std::ptrdiff_t>(count_));
    return *nth;
  }

 private:
  std::array<double, kSize> latencies_s_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
};

}  // namespace cornerd::daemon
