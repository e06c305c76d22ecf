// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/scan.hpp"

namespace cornerd::core {

/// How fast a lidar turns, from two consecutive scans and no map: their ranges by bearing are
/// shifted against each other. Each is skewed by the motion in it, both alike at a steady rate, so
/// that the shift is the turn from one to the next. Allocates nothing.
class ScanRotation {
 public:
  void forget() { has_scan_ = false; }

  /// Adds a scan as it was measured. The mean rate since the one before, rad/s, counter-clockwise,
  /// to some 0.1 rad/s up to 4 rad/s; nullopt without a scan in the second before, or where the two
  /// do not look alike.
  std::optional<double> update(const Scan& turn);

 private:
  static constexpr std::size_t kBins = 360;
  using Ranges = std::array<float, kBins>;  ///< m, in a degree of bearing; 0: no return

  std::array<Ranges, 2> ranges_{};
  std::size_t last_ = 0;  ///< index of the last scan's
  TimeNs last_ns_ = 0;
  bool has_scan_ = false;
};

}  // namespace cornerd::core
