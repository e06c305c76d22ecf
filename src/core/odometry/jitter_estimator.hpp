// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/geometry/squared.hpp"

namespace cornerd::core {

/// Estimates the jitter of the readings' times from the travel of the wheels. A reading that is
/// stamped late makes a wheel seem slow before it and fast after it: second differences of the
/// travel at speed v have a covariance of -4 v^2 sigma^2 with the next one, those of a speed that
/// changes a positive one, and counts, which are rounded, one like jitter.
class JitterEstimator {
 public:
  /// Travel of both wheels between two readings. `count_m2`: variance by rounding.
  void add(double left_m, double right_m, double dt_s, double count_m2) {
    if (!(dt_s > 0)) return;
    add(wheels_[0], left_m / dt_s, dt_s, count_m2);
    add(wheels_[1], right_m / dt_s, dt_s, count_m2);
    last_s_ = dt_s;
    travels_ = std::min<std::size_t>(travels_ + 1, 2);
  }
  /// The next travel does not follow the last one.
  void interrupt() { travels_ = 0; }

  /// Of a time between two readings, anywhere, by the jitter of both.
  double variance_between_s2() const { return 2 * variance_s2_ / 3; }

 private:
  struct Wheel {
    double speed_m_s = 0;
    double difference_m = 0;
  };

  void add(Wheel& last, double speed_m_s, double dt_s, double count_m2) {
    const Wheel now{speed_m_s, (speed_m_s - last.speed_m_s) * (dt_s + last_s_) / 2};
    const double speed2 = std::abs(speed_m_s * last.speed_m_s);
    if (travels_ == 2 && speed2 > 0) {
      const double expected_m2 = (variance_s2_ + kObservable_s2) * speed2 + count_m2;
      const double most_m2 = kOutlier * expected_m2;
      const double sides_m2 = -now.difference_m * last.difference_m / 4 - kRounding * count_m2;
      const double observed_s2 = std::clamp(sides_m2, -most_m2, most_m2) / speed2;
      const double share = speed2 * kObservable_s2 / (speed2 * kObservable_s2 + count_m2);
      weight_ = std::min(weight_ + squared(share), kMemory);
      variance_s2_ += squared(share) / weight_ * (observed_s2 - variance_s2_);
      variance_s2_ = std::clamp(variance_s2_, 0.0, kMost_s2);
    }
    last = now;
  }

  /// By half a count more at each reading the rounding alternates: three times that of a white one.
  static constexpr double kRounding = 3;
  static constexpr double kMemory = 1000;  ///< differences, of those that show jitter well
  static constexpr double kOutlier = 9;    ///< squared, three sigma
  /// Jitter of 1 ms is worth estimating; above 10 ms the times are wrong in another way.
  static constexpr double kObservable_s2 = 0.001 * 0.001;
  static constexpr double kMost_s2 = 0.01 * 0.01;

  std::array<Wheel, 2> wheels_;
  double last_s_ = 0;
  std::size_t travels_ = 0;  ///< that follow each other, of the last three
  double variance_s2_ = 0;   ///< of a reading's time
  double weight_ = 10;       ///< of the prior, no jitter
};

}  // namespace cornerd::core
