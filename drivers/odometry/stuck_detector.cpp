// SPDX-License-Identifier: MIT
#include "drivers/odometry/stuck_detector.hpp"

#include <cmath>

namespace cornerd::drivers {
namespace {

/// A robot may pivot about one resting wheel, but hardly more than twice.
constexpr double kMaxCircles = 2;
/// A gyro's noise exceeds its resolution, so its reading changes within this rotation.
constexpr double kMaxRotation_rad = 1;

}  // namespace

void StuckDetector::add(const core::OdometryReading& reading) {
  const auto travelled_m = [&](const auto& from, const auto& to) {
    if (!from || !to) return 0.0;
    return (static_cast<double>(*to) - static_cast<double>(*from)) * geometry_.metres_per_count();
  };
  const double left_m = travelled_m(last_.left, reading.left);
  const double right_m = travelled_m(last_.right, reading.right);
  other_travel_left_m_ =
      left_m != 0 || !reading.left ? 0 : other_travel_left_m_ + std::abs(right_m);
  other_travel_right_m_ =
      right_m != 0 || !reading.right ? 0 : other_travel_right_m_ + std::abs(left_m);
  const bool same_rate = reading.gyro_rad_s && reading.gyro_rad_s == last_.gyro_rad_s;
  turned_rad_ = same_rate ? turned_rad_ + (right_m - left_m) / geometry_.track_m : 0;
  last_ = reading;
}

bool StuckDetector::is_stuck(double other_travel_m) const {
  return other_travel_m > kMaxCircles * core::kTwoPi * geometry_.track_m;
}

bool StuckDetector::gyro_is_stuck() const { return std::abs(turned_rad_) > kMaxRotation_rad; }

}  // namespace cornerd::drivers
