// SPDX-License-Identifier: MIT
#include "daemon/latency_window.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::daemon {

void LatencyWindow::add(double latency_s) {
  latencies_s_[next_] = latency_s;
  next_ = (next_ + 1) % kSize;
  count_ = std::min(count_ + 1, kSize);
}

double LatencyWindow::percentile(double share) const {
  if (empty()) return 0;
  auto sorted = latencies_s_;
  const double rank = std::ceil(share * static_cast<double>(count_));
  const std::size_t index = std::clamp<std::size_t>(static_cast<std::size_t>(rank), 1, count_) - 1;
  const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(sorted.begin(), nth, sorted.begin() + static_cast<std::ptrdiff_t>(count_));
  return *nth;
}

}  // namespace cornerd::daemon
