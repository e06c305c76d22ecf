// SPDX-License-Identifier: MIT
#include "drivers/odometry/freeze_watch.hpp"

#include <cmath>

namespace cornerd::drivers {
namespace {

/// A robot may turn around a wheel that stands, but hardly more than twice.
constexpr double kCircles = 2;
/// No gyro says the same while the robot turns this far, even evenly: its noise is more than its
/// smallest step.
constexpr double kTurn_rad = 1;

}  // namespace

void FreezeWatch::add(const core::OdometryReading& reading) {
  const auto rolled_m = [&](const auto& from, const auto& to) {
    if (!from || !to) return 0.0;
    return (static_cast<double>(*to) - static_cast<double>(*from)) * geometry_.metres_per_count();
  };
  const double left_m = rolled_m(last_.left, reading.left);
  const double right_m = rolled_m(last_.right, reading.right);
  left_still_m_ = left_m != 0 || !reading.left ? 0 : left_still_m_ + std::abs(right_m);
  right_still_m_ = right_m != 0 || !reading.right ? 0 : right_still_m_ + std::abs(left_m);
  const bool same_rate = reading.gyro_rad_s && reading.gyro_rad_s == last_.gyro_rad_s;
  rate_still_rad_ = same_rate ? rate_still_rad_ + (right_m - left_m) / geometry_.track_m : 0;
  last_ = reading;
}

bool FreezeWatch::is_frozen(double other_wheel_m) const {
  return other_wheel_m > kCircles * core::kTwoPi * geometry_.track_m;
}

bool FreezeWatch::gyro_is_frozen() const { return std::abs(rate_still_rad_) > kTurn_rad; }

}  // namespace cornerd::drivers
