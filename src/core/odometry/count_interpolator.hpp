// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace cornerd::core {

/// Where a wheel is within its count. A count tells that the wheel is somewhere within it; between
/// the times at which counts change it goes on at the speed that led from the last change to here
/// (set-membership estimation: the estimate never leaves the count). A coarse encoder counts 17 mm
/// at once; by its steps a scan would be deskewed wrongly (tests/unit/core/odometry/
/// count_interpolator_test.cpp).
class CountInterpolator {
 public:
  explicit CountInterpolator(double metres_per_count) : half_m_(metres_per_count / 2) {}

  /// Travel in an increment whose counts amount to `counted_m`.
  double travel_m(double counted_m, double duration_s) {
    since_change_s_ += duration_s;
    const double ahead_m = beyond_middle_m_ + speed_m_s_ * duration_s - counted_m;
    double within_m = std::clamp(ahead_m, -half_m_, half_m_);
    const double missed_m = within_m - ahead_m;
    if (counted_m != 0 || missed_m != 0) {
      missed_m2_ += kShare * (std::min(missed_m * missed_m, 16 * half_m_ * half_m_) - missed_m2_);
    }
    if (missed_m2_ > 4 * half_m_ * half_m_) {
      // A speed that is a count off tells nothing of where in it the wheel is.
      within_m = 0;
      if (since_change_s_ > 0) speed_m_s_ = counted_m / since_change_s_;
    } else if (since_change_s_ > 0) {
      speed_m_s_ += kGain * missed_m / since_change_s_;
    }
    if (counted_m != 0) since_change_s_ = 0;
    const double moved_m = counted_m + within_m - beyond_middle_m_;
    beyond_middle_m_ = within_m;
    return moved_m;
  }

 private:
  /// Of what a count tells of the speed. More, and it follows the rounding of counts.
  static constexpr double kGain = 0.2;
  /// Of one increment in the mean of what the speed misses counts by.
  static constexpr double kShare = 0.1;

  double half_m_;
  double beyond_middle_m_ = 0;  ///< of the count
  double speed_m_s_ = 0;
  double since_change_s_ = 0;
  double missed_m2_ = 0;  ///< mean square, each of at most two counts
};

}  // namespace cornerd::core
