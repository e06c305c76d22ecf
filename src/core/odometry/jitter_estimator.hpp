// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace cornerd::core {

/// Estimates the jitter of the readings' times. A late reading counts the gyro's rate for too long,
/// and the next reading for as much too short: jitter is what changes sides from one innovation to
/// the next (their covariance is negative). Slips and wrong gyros do not.
class JitterEstimator {
 public:
  /// `innovation_rad`: the wheels' rotation less the gyro's in a scan; `other_rad2`: its variance
  /// without jitter.
  void add(double innovation_rad, double rate_rad_s, double other_rad2) {
    const double per_s2 = std::abs(rate_rad_s * rate_before_rad_s_);
    const double expected_rad2 = variance_s2_ * per_s2 + other_rad2;
    if (per_s2 > 0 && expected_rad2 > 0) {
      const double most_rad2 = kOutlier * expected_rad2;
      const double sides_rad2 =
          std::clamp(-innovation_rad * innovation_before_rad_, -most_rad2, most_rad2);
      const double share = per_s2 * kObservable_s2 / (per_s2 * kObservable_s2 + expected_rad2);
      weight_ = std::min(weight_ + share * share, kMemory);
      variance_s2_ += share * share / weight_ * (sides_rad2 / per_s2 - variance_s2_);
      variance_s2_ = std::clamp(variance_s2_, 0.0, kMost_s2);
    }
    innovation_before_rad_ = innovation_rad;
    rate_before_rad_s_ = rate_rad_s;
  }

  /// Of the time of a reading.
  double variance_s2() const { return variance_s2_; }

 private:
  static constexpr double kMemory = 150;  ///< innovations, of those that show jitter well
  static constexpr double kOutlier = 9;   ///< squared, three sigma
  /// Jitter of 1 ms is worth estimating; above 10 ms the times are wrong in another way.
  static constexpr double kObservable_s2 = 0.001 * 0.001;
  static constexpr double kMost_s2 = 0.01 * 0.01;

  double variance_s2_ = 0;
  double weight_ = 2;  ///< of the prior, no jitter
  double innovation_before_rad_ = 0;
  double rate_before_rad_s_ = 0;
};

}  // namespace cornerd::core
