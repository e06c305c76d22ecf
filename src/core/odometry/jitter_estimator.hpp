// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace cornerd::core {

/// Learns how late or early the times of readings are. A reading that comes late counts the gyro's
/// rate for too long, and the next one for as much too short: what the gyro says beyond the wheels
/// is modelled from slip, and from a gyro that lies, by its changing sides with every reading.
class JitterEstimator {
 public:
  /// `surprise_rad`: the gyro's turn beyond the wheels' in a step; `other_rad2`: its variance but
  /// for jitter.
  void add(double surprise_rad, double rate_rad_s, double other_rad2) {
    const double modelled_rad2 = std::abs(rate_rad_s * rate_before_rad_s_);
    const double expected_rad2 = variance_s2_ * modelled_rad2 + other_rad2;
    if (modelled_rad2 > 0 && expected_rad2 > 0) {
      const double most_rad2 = kOutlier * expected_rad2;
      const double sides_rad2 =
          std::clamp(-surprise_rad * surprise_before_rad_, -most_rad2, most_rad2);
      const double share =
          modelled_rad2 * kMattering_s2 / (modelled_rad2 * kMattering_s2 + expected_rad2);
      weight_ = std::min(weight_ + share * share, kMemory);
      variance_s2_ += share * share / weight_ * (sides_rad2 / modelled_rad2 - variance_s2_);
      variance_s2_ = std::clamp(variance_s2_, 0.0, kMost_s2);
    }
    surprise_before_rad_ = surprise_rad;
    rate_before_rad_s_ = rate_rad_s;
  }

  /// Of the time of a reading.
  double variance_s2() const { return variance_s2_; }

 private:
  static constexpr double kMemory = 150;
  static constexpr double kOutlier = 9;
  /// What is worth looking for, and what is no jitter any more.
  static constexpr double kMattering_s2 = 0.001 * 0.001;
  static constexpr double kMost_s2 = 0.01 * 0.01;

  double variance_s2_ = 0;
  double weight_ = 2;  ///< of the guess that there is none
  double surprise_before_rad_ = 0;
  double rate_before_rad_s_ = 0;
};

}  // namespace cornerd::core
