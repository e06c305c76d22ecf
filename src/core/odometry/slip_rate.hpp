// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::core {

/// Variance of the rotation by slip, which no gyro shows, after a metre: mean square of what fixes
/// show beyond noise.
class SlipRate {
 public:
  /// Heading innovation squared after `rolled_m`, and its variance without slip. True where it is
  /// one.
  bool add(double innovation_rad2, double variance_rad2, double rolled_m) {
    const bool is_slip = innovation_rad2 > kGate * variance_rad2;
    slips_rad2_ += is_slip ? std::min(innovation_rad2 - variance_rad2, kMost_rad2) : 0;
    rolled_m_ += rolled_m;
    const double kept = std::min(1.0, kMemory_m / rolled_m_);
    slips_rad2_ *= kept;
    rolled_m_ *= kept;
    return is_slip;
  }
  double rad2_per_m() const { return slips_rad2_ / rolled_m_; }

 private:
  static constexpr double kGate = 9;  ///< three sigma
  static constexpr double kMost_rad2 = 0.25;
  static constexpr double kMemory_m = 100;
  /// Before the first fix: half a degree after 10 m.
  double slips_rad2_ = 0.0001;
  double rolled_m_ = 10;
};

}  // namespace cornerd::core
