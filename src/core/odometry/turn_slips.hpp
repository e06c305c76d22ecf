// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::core {

/// How much wheels that no gyro watches turn the robot by slipping: seldom, and by a lot. Learned
/// from what fixes show that no noise explains; before the first, what few robots do less of.
class TurnSlips {
 public:
  /// A fix's heading against the wheels', after `rolled_m`: squared surprise, and its variance but
  /// for slips.
  void add(double surprise_rad2, double known_rad2, double rolled_m) {
    const double slip_rad2 = surprise_rad2 > kUsual * known_rad2 ? surprise_rad2 - known_rad2 : 0;
    slips_rad2_ += std::min(slip_rad2, kMost_rad2);
    rolled_m_ += rolled_m;
    const double kept = std::min(1.0, kMemory_m / rolled_m_);
    slips_rad2_ *= kept;
    rolled_m_ *= kept;
  }

  /// Variance of the turn after a metre.
  double rad2_per_m() const { return slips_rad2_ / rolled_m_; }

 private:
  static constexpr double kUsual = 9;
  static constexpr double kMost_rad2 = 0.25;
  static constexpr double kMemory_m = 100;

  double slips_rad2_ = 0.0003;
  double rolled_m_ = 10;
};

}  // namespace cornerd::core
